// Compiles a declared frame into a plan: culling, placement of transients, barriers. Uses no device.
#include <algorithm>

#include "graph/graph_impl.hpp"

namespace rill {
namespace {

constexpr uint64_t kImageHeapBytes = 256ull << 20;  // a larger image raises the limit to its own size

}  // namespace

Expected<void> GraphImpl::checkImports() const {
  for (size_t i = 0; i < resources.size(); ++i) {
    const ResourceData& a = resources[i];
    if (!a.imported) continue;
    if (a.isImage ? !a.image : !a.buffer)
      return Error{ErrorKind::BadInput, "import " + quoted(a.name) + ": null handle, expected a " + (a.isImage ? "VkImage" : "VkBuffer")};
    for (size_t k = 0; k < i; ++k) {
      const ResourceData& b = resources[k];
      if (!b.imported || a.isImage != b.isImage || i - a.level == k - b.level) continue;
      if (!a.isImage && a.version == 0 && b.version == 0) continue;  // images overlap even when only read: reads change the layout
      const bool overlap =
          a.isImage ? a.image == b.image : a.buffer == b.buffer && a.offset < b.offset + b.size && b.offset < a.offset + a.size;
      if (overlap)
        return Error{ErrorKind::BadInput, "imports " + quoted(b.name) + " and " + quoted(a.name) + " overlap in the same " +
                                              (a.isImage ? "VkImage" : "VkBuffer and one is written") + "; import the memory once"};
    }
  }
  return {};
}

Expected<void> GraphImpl::compile() {
  compiled = prepared = planComplete = false;
  if (error) return *error;
  if (auto ok = checkImports(); !ok) return ok;
  if (!reusePlan()) {
    previousPlan.valid = false;
    ++plansMade;
    cull();
    placeTransients();
    planBarriers();
  }
  makeReport();
  compiled = planComplete = true;
  return {};
}

// In reverse execution order, so that all later readers of a pass's results are known when it is visited.
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
      usesGraphics |= isGraphicsUse(accesses[k].use);
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
    const ImageRequirements needs = images.requirements({image.desc, image.usage});
    image.size = plans[1].placements[k].size = needs.size;
    plans[1].placements[k].alignment = needs.alignment;
    largest = std::max(largest, needs.size);
  }
  uint64_t longest = 0;
  for (const Placement& buffer : plans[0].placements) longest = std::max(longest, buffer.size);
  planner.plan(plans[0].placements, std::max(longest, kSharedBufferBytes), plans[0].heapSizes);
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

/// A resource's state after all barriers so far. Barriers are applied lazily, when a resource is used:
/// there may be thousands of both.
HazardState& GraphImpl::currentState(ResourceData& resource) {
  for (; resource.barriersApplied < appliedBarriers.size(); ++resource.barriersApplied) {
    const AppliedBarrier& barrier = appliedBarriers[resource.barriersApplied];
    resource.state.applyBarrier(barrier.scope, barrier.visibleUses);
  }
  return resource.state;
}

/// A new transient waits for the last users of its memory, in this frame and the previous one.
void GraphImpl::waitForAliasedMemory(uint32_t index, const HazardState& previousFrame) {
  ResourceData& resource = resources[index];
  TransientPlan& plan = planOf(resource);
  const uint32_t placement = memoryOf(index).placement;
  const Placement& own = plan.placements[placement];
  resource.placed = true;
  resource.barriersApplied = static_cast<uint32_t>(appliedBarriers.size());  // earlier barriers do not concern it
  HazardState& state = resource.state;
  state.merge(previousFrame);
  for (const uint32_t candidate : plan.aliasCandidates) {
    if (candidate == placement || !sharesMemory(plan.placements[candidate], own)) continue;
    const uint32_t first = plan.resources[candidate];
    for (uint32_t l = 0; l < (resource.isImage ? resources[first].desc.levels : 1); ++l) state.merge(currentState(resources[first + l]));
  }
  // Later transients wait for this one, and thereby for those that it covers. Mip levels are tracked one by one.
  const bool whole = !resource.isImage || resource.desc.levels == 1;
  std::erase_if(plan.aliasCandidates,
                [&](uint32_t candidate) { return candidate == placement || (whole && covers(own, plan.placements[candidate])); });
  plan.aliasCandidates.push_back(placement);
}

void GraphImpl::planBarriers() {
  causes.clear();
  transitions.clear();
  appliedBarriers.clear();
  for (TransientPlan& plan : plans) plan.aliasCandidates.clear();
  for (ResourceData& resource : resources) {
    resource.state = resource.imported ? HazardState::after(useRow(resource.before)) : HazardState::untouched();
    resource.layout = useRow(resource.before).layout;
    resource.placed = resource.imported;
    resource.barriersApplied = 0;
  }
  // One shared state for the previous frame's use of the heaps, so that one barrier serves all transients.
  HazardState previousFrame = HazardState::previousFrame(usesGraphics);

  const auto apply = [&](const Scope& scope) {
    const uint32_t visibleUses = usesMadeVisible(scope);
    previousFrame.applyBarrier(scope, visibleUses);
    appliedBarriers.push_back({scope, visibleUses});
  };
  const auto wait = [&](PlannedBarrier& barrier, uint32_t index, const UseRow& row, bool keep) {
    ResourceData& resource = resources[index];
    if (resource.isImage && resource.layout != row.layout) {
      transitions.push_back({index, keep ? resource.layout : VK_IMAGE_LAYOUT_UNDEFINED, row.layout, {}});
      currentState(resource).changeLayout(row, transitions.back().scope);
      resource.layout = row.layout;
      ++barrier.transitions.count;
      return;
    }
    const Hazard hazard = currentState(resource).addDependency(row, keep, barrier.scope);
    if (hazard != Hazard::None) causes.push_back({index, hazard, row.name}), ++barrier.causes.count;
  };
  const auto begin = [&](PlannedBarrier& barrier) { barrier = {{}, {uint32_t(causes.size()), 0}, {uint32_t(transitions.size()), 0}}; };

  for (uint32_t i = 0; i < passes.size(); ++i) {
    PassData& pass = passes[i];
    begin(pass.barrier);
    if (!pass.alive) continue;
    const auto uses = std::span(accesses).subspan(pass.accesses.first, pass.accesses.count);
    for (const Access& access : uses) {
      if (!resources[access.resource].placed) waitForAliasedMemory(access.resource, previousFrame);
      wait(pass.barrier, access.resource, useRow(access.use), access.keep);
    }
    if (!pass.barrier.scope.empty()) apply(pass.barrier.scope);
    for (const Access& access : uses) currentState(resources[access.resource]).applyUse(access.use);
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
  rowByName.assign(names.size(), kNone);
  const auto row = [&](uint32_t name) -> PassReport& {
    if (rowByName[name] == kNone) {
      rowByName[name] = uint32_t(reports.size());
      reports.push_back({names[name], 0, false, {}});
    }
    return reports[rowByName[name]];
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
