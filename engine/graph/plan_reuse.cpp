// A frame declared like the previous one reuses its plan.
#include <algorithm>
#include <functional>

#include "graph/graph_impl.hpp"

namespace rill {
namespace {

bool same(Range a, Range b) { return a.first == b.first && a.count == b.count; }

bool same(const PassData& a, const PassData& b) {
  return a.name == b.name && a.root == b.root && a.readback == b.readback && same(a.accesses, b.accesses) && same(a.targets, b.targets);
}

/// Ignores handles, which plans do not depend on, and image sizes, which are results of planning.
bool same(const ResourceData& a, const ResourceData& b) {
  return a.name == b.name && a.imported == b.imported && a.isImage == b.isImage && a.before == b.before && a.after == b.after &&
         a.level == b.level && (a.isImage ? a.desc == b.desc : a.size == b.size);
}

template <class T, class Equal>
bool equal(const std::vector<T>& a, const std::vector<T>& b, Equal&& equals) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), equals);
}

}  // namespace

void GraphImpl::keepPlan() {
  if (!compiled || !planComplete) return;
  std::swap(passes, previousPlan.passes);
  std::swap(resources, previousPlan.resources);
  std::swap(accesses, previousPlan.accesses);
  std::swap(targets, previousPlan.targets);
  previousPlan.valid = true;
  planComplete = false;
}

bool GraphImpl::reusePlan() {
  const auto sameTarget = [](const Target& a, const Target& b) { return a.resource == b.resource; };
  if (!previousPlan.valid || !equal(passes, previousPlan.passes, [](const auto& a, const auto& b) { return same(a, b); }) ||
      !equal(resources, previousPlan.resources, [](const auto& a, const auto& b) { return same(a, b); }) ||
      !equal(accesses, previousPlan.accesses, std::equal_to<>()) || !equal(targets, previousPlan.targets, sameTarget))
    return false;
  for (size_t i = 0; i < passes.size(); ++i) {
    passes[i].alive = previousPlan.passes[i].alive;
    passes[i].reason = previousPlan.passes[i].reason;
    passes[i].barrier = previousPlan.passes[i].barrier;
  }
  for (size_t i = 0; i < resources.size(); ++i) {
    resources[i].placement = previousPlan.resources[i].placement;
    resources[i].usage = previousPlan.resources[i].usage;
    resources[i].size = previousPlan.resources[i].size;
  }
  for (size_t i = 0; i < targets.size(); ++i) targets[i].store = previousPlan.targets[i].store;
  return true;
}

}  // namespace rill
