// From a declared frame to a plan: which passes run, where transients lie, what each pass waits for. Touches no GPU.
#include <algorithm>

#include "graph/graph_impl.hpp"

namespace rill {
namespace {

constexpr uint64_t kImageHeapBytes = 256ull << 20;  // an image that is larger has a heap as large as itself

}  // namespace

Expected<void> GraphImpl::checkImports() const {
  for (size_t i = 0; i < resources.size(); ++i) {
    const ResourceData& a = resources[i];
    if (!a.imported) continue;
    if (a.isImage ? !a.image : !a.buffer)
      return Error{ErrorKind::BadInput, "import " + quoted(a.name) + " has a null " + (a.isImage ? "VkImage" : "VkBuffer")};
    for (size_t k = 0; k < i; ++k) {
      const ResourceData& b = resources[k];
      if (!b.imported || a.isImage != b.isImage || i - a.level == k - b.level) continue;
      if (!a.isImage && a.version == 0 && b.version == 0) continue;  // a read, too, changes an image's layout
      const bool overlap =
          a.isImage ? a.image == b.image : a.buffer == b.buffer && a.offset < b.offset + b.size && b.offset < a.offset + a.size;
      if (overlap)
        return Error{ErrorKind::BadInput, "imports " + quoted(b.name) + " and " + quoted(a.name) + " overlap in one " +
                                              (a.isImage ? "VkImage" : "VkBuffer and one is written") + ": import the memory once"};
    }
  }
  return {};
}

Expected<void> GraphImpl::compile() {
  compiled = prepared = planWhole = false;
  if (error) return *error;
  if (auto ok = checkImports(); !ok) return ok;
  if (!reusePlan()) {
    before.valid = false;
    ++plansMade;
    cull();
    placeTransients();
    planBarriers();
  }
  makeReport();
  compiled = planWhole = true;
  return {};
}

// Backwards: declaration is in order of execution, so when a pass is reached it is known whether anyone wants what it writes.
void GraphImpl::cull() {
  for (ResourceData& resource : resources) resource.needed = resource.imported;
  for (size_t i = passes.size(); i-- > 0;) {
    PassData& pass = passes[i];
    const auto uses = std::span(accesses).subspan(pass.accesses.first, pass.accesses.count);
    pass.alive = pass.root;
    uint32_t unread = kNone;
    for (const Access& access : uses) {
      if (!access.write) continue;
      if (resources[access.resource].needed)
        pass.alive = true;
      else if (unread == kNone)
        unread = resources[access.resource].name;
    }
    pass.reason = {};
    if (!pass.alive) {
      pass.reason = unread == kNone ? std::string_view("it writes nothing") : names.unread(unread);
      continue;
    }
    for (uint32_t t = pass.targets.first; t < pass.targets.first + pass.targets.count; ++t)
      targets[t].store = resources[targets[t].resource].needed;
    for (const Access& access : uses) resources[access.resource].needed = !access.write || access.keep;
  }
}

void GraphImpl::placeTransients() {
  for (TransientPlan& plan : plans) {
    plan.placements.clear();
    plan.resources.clear();
  }
  for (ResourceData& resource : resources) {
    resource.placement = kNone;
    resource.usage = 0;
  }
  for (uint32_t i = 0; i < passes.size(); ++i) {
    if (!passes[i].alive) continue;
    const Range range = passes[i].accesses;
    for (uint32_t k = range.first; k < range.first + range.count; ++k) {
      ResourceData& resource = memoryOf(accesses[k].resource);
      resource.usage |= useRow(accesses[k].use).usage;
      draws |= isDrawing(accesses[k].use);
      if (resource.imported) continue;
      TransientPlan& plan = planOf(resource);
      if (resource.placement == kNone) {
        resource.placement = uint32_t(plan.placements.size());
        plan.placements.push_back({i, i, resource.size});
        plan.resources.push_back(accesses[k].resource - resources[accesses[k].resource].level);
      }
      plan.placements[resource.placement].last = i;
    }
  }
  uint64_t largest = 0;
  for (size_t k = 0; k < plans[1].placements.size(); ++k) {
    ResourceData& image = resources[plans[1].resources[k]];
    const ImageNeeds needs = images.needs({image.desc, image.usage});
    image.size = plans[1].placements[k].size = needs.size;
    plans[1].placements[k].alignment = needs.alignment;
    largest = std::max(largest, needs.size);
  }
  planner.plan(plans[0].placements, kMaxBufferBytes, plans[0].heapSizes);
  planner.plan(plans[1].placements, std::max(largest, kImageHeapBytes), plans[1].heapSizes);
  reportHeaps();
}

void GraphImpl::reportHeaps() {
  heapReports.clear();
  for (const TransientPlan& plan : plans) {
    const size_t first = heapReports.size();
    for (const uint64_t bytes : plan.heapSizes) heapReports.push_back({&plan == &plans[1], 0, bytes, 0});
    for (const Placement& place : plan.placements) {
      TransientHeap& heap = heapReports[first + place.heap];
      heap.separate = (heap.separate + place.alignment - 1) / place.alignment * place.alignment + place.size;
      ++heap.transients;
    }
  }
}

/// A resource's state after the barriers so far. It is brought up to date where it is looked at, not at each barrier: there may be
/// thousands of both.
HazardState& GraphImpl::stateNow(ResourceData& resource) {
  for (; resource.barriersSeen < barriersPassed.size(); ++resource.barriersSeen) {
    const PassedBarrier& barrier = barriersPassed[resource.barriersSeen];
    resource.state.passed(barrier.scope, barrier.seeing);
  }
  return resource.state;
}

/// The memory's last users, in this frame and the one before, are what a new transient waits for.
void GraphImpl::waitForMemory(uint32_t index, const HazardState& seam) {
  ResourceData& resource = resources[index];
  TransientPlan& plan = planOf(resource);
  const uint32_t placement = memoryOf(index).placement;
  const Placement& own = plan.placements[placement];
  resource.placed = true;
  resource.barriersSeen = static_cast<uint32_t>(barriersPassed.size());  // nothing has happened to it yet
  HazardState& state = resource.state;
  state.join(seam);
  for (const uint32_t tenant : plan.tenants) {
    if (tenant == placement || !sharesMemory(plan.placements[tenant], own)) continue;
    const uint32_t first = plan.resources[tenant];
    for (uint32_t l = 0; l < (resource.isImage ? resources[first].desc.levels : 1); ++l) state.join(stateNow(resources[first + l]));
  }
  // Whoever comes later waits for this one, and so for those that it covers: but levels of a pyramid wait one by one.
  const bool whole = !resource.isImage || resource.desc.levels == 1;
  std::erase_if(plan.tenants, [&](uint32_t tenant) { return tenant == placement || (whole && covers(own, plan.placements[tenant])); });
  plan.tenants.push_back(placement);
}

void GraphImpl::planBarriers() {
  causes.clear();
  transitions.clear();
  barriersPassed.clear();
  for (TransientPlan& plan : plans) plan.tenants.clear();
  for (ResourceData& resource : resources) {
    resource.state = resource.imported ? HazardState::after(useRow(resource.before)) : HazardState::nothing();
    resource.layout = useRow(resource.before).layout;
    resource.placed = resource.imported;
    resource.barriersSeen = 0;
  }
  // Other frames' use of the heaps: a state of its own, so that the frame's first barrier on them serves all transients.
  HazardState seam = HazardState::seam(draws);

  const auto apply = [&](const Scope& scope) {
    const uint32_t seeing = usesSeeing(scope);
    seam.passed(scope, seeing);
    barriersPassed.push_back({scope, seeing});
  };
  const auto wait = [&](PlannedBarrier& barrier, uint32_t index, const UseRow& row, bool keep) {
    ResourceData& resource = resources[index];
    if (resource.isImage && resource.layout != row.layout) {
      transitions.push_back({index, keep ? resource.layout : VK_IMAGE_LAYOUT_UNDEFINED, row.layout, {}});
      stateNow(resource).changeLayout(row, transitions.back().scope);
      resource.layout = row.layout;
      ++barrier.transitions.count;
      return;
    }
    const Hazard hazard = stateNow(resource).need(row, keep, barrier.scope);
    if (hazard != Hazard::None) causes.push_back({index, hazard, row.name}), ++barrier.causes.count;
  };
  const auto begin = [&](PlannedBarrier& barrier) { barrier = {{}, {uint32_t(causes.size()), 0}, {uint32_t(transitions.size()), 0}}; };

  for (uint32_t i = 0; i < passes.size(); ++i) {
    PassData& pass = passes[i];
    begin(pass.barrier);
    if (!pass.alive) continue;
    const auto uses = std::span(accesses).subspan(pass.accesses.first, pass.accesses.count);
    for (const Access& access : uses) {
      if (!resources[access.resource].placed) waitForMemory(access.resource, seam);
      wait(pass.barrier, access.resource, useRow(access.use), access.keep);
    }
    if (!pass.barrier.scope.empty()) apply(pass.barrier.scope);
    for (const Access& access : uses) stateNow(resources[access.resource]).used(access.use);
  }

  begin(finalBarrier);
  for (uint32_t i = 0; i < resources.size(); ++i)
    if (resources[i].imported && resources[i].after != Use::Nothing) wait(finalBarrier, i, useRow(resources[i].after), true);
  if (!readbacks.empty()) {
    finalBarrier.scope.sourceStage |= useRow(Use::CopyTarget).stage;
    finalBarrier.scope.sourceAccess |= useRow(Use::CopyTarget).write;
    finalBarrier.scope.targetStage |= useRow(Use::HostRead).stage;
    finalBarrier.scope.targetAccess |= useRow(Use::HostRead).read;
  }
}

void GraphImpl::makeReport() {
  reports.clear();
  rowOfName.assign(names.size(), kNone);
  const auto row = [&](uint32_t name) -> PassReport& {
    if (rowOfName[name] == kNone) {
      rowOfName[name] = uint32_t(reports.size());
      reports.push_back({names[name], 0, false, {}});
    }
    return reports[rowOfName[name]];
  };
  for (const PassData& pass : passes) {
    PassReport& report = row(pass.name);
    if (pass.alive) {
      ++report.runs;
      report.culled = false;
      report.reason = {};
    } else if (report.runs == 0) {
      report.culled = true;
      report.reason = pass.reason;
    }
  }
  for (const Skipped& skip : skips)
    if (PassReport& report = row(skip.name); report.runs == 0) report.reason = skip.reason;
}

}  // namespace rill
