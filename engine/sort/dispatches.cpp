#include "sort/dispatches.hpp"

namespace rill {

GroupCount foldGroups(uint64_t groups) {
  constexpr uint64_t kMaxGroupsPerDimension = 65535;
  if (groups == 0) return {0, 0, 0};
  const uint64_t y = (groups + kMaxGroupsPerDimension - 1) / kMaxGroupsPerDimension;
  return {static_cast<uint32_t>((groups + y - 1) / y), static_cast<uint32_t>(y), 1};
}

BufferRef targetOr(Graph& graph, BufferRef target, std::string_view name, uint64_t count) {
  return target == BufferRef{} ? graph.create(name, {count * sizeof(uint32_t)}) : target;
}

}  // namespace rill
