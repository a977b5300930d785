// A frame that is declared like the one before needs no new plan: what compile() found then is taken over.
#include <algorithm>
#include <functional>

#include "graph/graph_impl.hpp"

namespace rill {
namespace {

bool same(Range a, Range b) { return a.first == b.first && a.count == b.count; }

bool same(const PassData& a, const PassData& b) {
  return a.name == b.name && a.root == b.root && a.readback == b.readback && same(a.accesses, b.accesses) && same(a.targets, b.targets);
}

/// But for handles, which no plan depends on, and for what an image takes of memory, which is found.
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
  if (!compiled || !planWhole) return;
  std::swap(passes, before.passes);
  std::swap(resources, before.resources);
  std::swap(accesses, before.accesses);
  std::swap(targets, before.targets);
  before.valid = true;
  planWhole = false;
}

bool GraphImpl::reusePlan() {
  const auto sameTarget = [](const Target& a, const Target& b) { return a.resource == b.resource; };
  if (!before.valid || !equal(passes, before.passes, [](const auto& a, const auto& b) { return same(a, b); }) ||
      !equal(resources, before.resources, [](const auto& a, const auto& b) { return same(a, b); }) ||
      !equal(accesses, before.accesses, std::equal_to<>()) || !equal(targets, before.targets, sameTarget))
    return false;
  for (size_t i = 0; i < passes.size(); ++i) {
    passes[i].alive = before.passes[i].alive;
    passes[i].reason = before.passes[i].reason;
    passes[i].barrier = before.passes[i].barrier;
  }
  for (size_t i = 0; i < resources.size(); ++i) {
    resources[i].placement = before.resources[i].placement;
    resources[i].usage = before.resources[i].usage;
    resources[i].size = before.resources[i].size;
  }
  for (size_t i = 0; i < targets.size(); ++i) targets[i].store = before.targets[i].store;
  return true;
}

}  // namespace rill
