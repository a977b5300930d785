// From a declared frame to a plan: which passes run, where transients lie, what each pass waits for. Touches no GPU.
#include <algorithm>

#include "graph/graph_impl.hpp"

namespace rill {

Expected<void> GraphImpl::checkImports() const {
  for (size_t i = 0; i < resources.size(); ++i) {
    const ResourceData& a = resources[i];
    if (!a.imported) continue;
    if (!a.import.handle) return Error{ErrorKind::BadInput, "import " + quoted(a.name) + " has a null VkBuffer"};
    for (size_t k = 0; k < i; ++k) {
      const ResourceData& b = resources[k];
      if (!b.imported || a.import.handle != b.import.handle || (a.version == 0 && b.version == 0)) continue;
      if (a.import.offset < b.import.offset + b.size && b.import.offset < a.import.offset + a.size)
        return Error{ErrorKind::BadInput, "imports " + quoted(b.name) + " and " + quoted(a.name) +
                                              " overlap in one VkBuffer and one is written: import the memory once"};
    }
  }
  return {};
}

Expected<void> GraphImpl::compile() {
  compiled = prepared = false;
  if (error) return *error;
  if (auto ok = checkImports(); !ok) return ok;
  cull();
  placeTransients();
  planBarriers();
  makeReport();
  compiled = true;
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
    for (const Access& access : uses) resources[access.resource].needed = !access.write || access.keep;
  }
}

void GraphImpl::placeTransients() {
  placements.clear();
  placed.clear();
  for (ResourceData& resource : resources) resource.placement = kNone;
  for (uint32_t i = 0; i < passes.size(); ++i) {
    if (!passes[i].alive) continue;
    const Range range = passes[i].accesses;
    for (uint32_t k = range.first; k < range.first + range.count; ++k) {
      ResourceData& resource = resources[accesses[k].resource];
      if (resource.imported) continue;
      if (resource.placement == kNone) {
        resource.placement = uint32_t(placements.size());
        placements.push_back({i, i, resource.size, 0, 0});
        placed.push_back(accesses[k].resource);
      }
      placements[resource.placement].last = i;
    }
  }
  planner.plan(placements, kMaxBufferBytes, heapSizes);
}

void GraphImpl::planBarriers() {
  causes.clear();
  for (ResourceData& resource : resources)
    resource.state = resource.imported ? HazardState::after(resource.import.before) : HazardState::nothing();
  // Other frames' use of the heap: a state of its own, so that the frame's first barrier on the heap serves all transients.
  HazardState seam = HazardState::seam();

  const auto apply = [&](const Scope& scope) {
    const uint32_t seeing = usesSeeing(scope);
    seam.passed(scope, seeing);
    for (ResourceData& resource : resources) resource.state.passed(scope, seeing);
  };
  const auto wait = [&](PlannedBarrier& barrier, uint32_t resource, Use use, bool keep) {
    const Hazard hazard = resources[resource].state.need(use, keep, barrier.scope);
    if (hazard != Hazard::None) causes.push_back({resource, hazard, use}), ++barrier.causes.count;
  };
  const auto begin = [&](PlannedBarrier& barrier) {
    barrier.scope = {};
    barrier.causes = {uint32_t(causes.size()), 0};
  };

  for (uint32_t i = 0; i < passes.size(); ++i) {
    PassData& pass = passes[i];
    begin(pass.barrier);
    if (!pass.alive) continue;
    const auto uses = std::span(accesses).subspan(pass.accesses.first, pass.accesses.count);
    for (const Access& access : uses) {
      ResourceData& resource = resources[access.resource];
      if (!resource.imported && placements[resource.placement].first == i) {
        // The memory's earlier users, in this frame and the one before, are what a new transient waits for.
        resource.state.join(seam);
        for (size_t k = 0; k < placements.size(); ++k)
          if (placements[k].last < i && sharesMemory(placements[k], placements[resource.placement]))
            resource.state.join(resources[placed[k]].state);
      }
      wait(pass.barrier, access.resource, access.use, access.keep);
    }
    if (!pass.barrier.scope.empty()) apply(pass.barrier.scope);
    for (const Access& access : uses) resources[access.resource].state.used(access.use);
  }

  begin(finalBarrier);
  for (uint32_t i = 0; i < resources.size(); ++i)
    if (resources[i].imported && resources[i].import.after != Use::None) wait(finalBarrier, i, resources[i].import.after, true);
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
