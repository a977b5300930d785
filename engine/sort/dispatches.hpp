#pragma once
// The sequence of dispatches of a module, recorded directly or with indirect arguments.
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "graph/shader_pass.hpp"
#include "rill/graph.hpp"

namespace rill {

/// Workgroups in x, y and z.
using GroupCount = std::array<uint32_t, 3>;

/// `groups` workgroups folded into x and y, neither above 65,535. 0 stays 0.
GroupCount foldGroups(uint64_t groups);

inline uint64_t divideUp(uint64_t a, uint64_t b) { return (a + b - 1) / b; }

/// The size in words of an array of `count` words that is accessed four words at a time.
constexpr uint64_t paddedWords(uint64_t count) { return (count + 3) / 4 * 4; }

/// `target`, or a new transient of `count` uints if `target` is empty.
BufferRef targetOr(Graph& graph, BufferRef target, std::string_view name, uint64_t count);

/// A dispatch that a gate starts.
struct GatedDispatch {
  GroupCount groups{};
  uint32_t keysPerGroup = 0;  ///< where the device knows how many keys there are, fewer groups do; 0: it takes them all
};

/// Indirect dispatch arguments for a module that the device enables or skips per frame. Dispatch k reads
/// byte (firstCommand + k) * sizeof(VkDispatchIndirectCommand) of `arguments`, which holds the module's
/// groups(), or zeros to skip it.
struct Gate {
  BufferRef arguments;
  uint32_t firstCommand = 0;
};

/// Assigns consecutive indirect commands to a module's dispatches while its passes are declared.
class Dispatches {
 public:
  explicit Dispatches(const Gate* gate, uint32_t first = 0) : gate_(gate ? *gate : Gate{}), next_(first) {}

  /// The size of the next dispatch.
  DispatchSize next(uint64_t groups) {
    if (gate_.arguments == BufferRef{}) return groups;
    return {gate_.arguments, (gate_.firstCommand + uint64_t{next_++}) * sizeof(VkDispatchIndirectCommand)};
  }

  /// The gate of a nested module with `count` commands.
  Gate inner(uint32_t count) {
    const Gate gate{gate_.arguments, gate_.firstCommand + next_};
    next_ += count;
    return gate;
  }

 private:
  Gate gate_;
  uint32_t next_;
};

}  // namespace rill
