#pragma once
// The sequence of dispatches of a module, recorded directly or with indirect arguments.
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "rill/graph.hpp"

namespace rill {

/// Workgroups in x, y and z.
using GroupCount = std::array<uint32_t, 3>;

/// `groups` workgroups folded into x and y, neither above 65,535. 0 stays 0.
GroupCount foldGroups(uint64_t groups);

inline uint64_t divideUp(uint64_t a, uint64_t b) { return (a + b - 1) / b; }

/// The size in words of an array of `count` words that is accessed four words at a time.
constexpr uint64_t paddedWords(uint64_t count) { return (count + 3) / 4 * 4; }

/// The use of an array read through shaders/shared/arrays.glsl.
constexpr Use readUse(bool texels) { return texels ? Use::ComputeTexel : Use::ComputeRead; }

/// `target`, or a new transient of `count` uints if `target` is empty.
BufferRef targetOr(Graph& graph, BufferRef target, std::string_view name, uint64_t count);

/// Indirect dispatch arguments for a module that the device enables or skips per frame. Dispatch k reads
/// byte (firstCommand + k) * sizeof(VkDispatchIndirectCommand) of `arguments`, which holds the module's
/// groups(), or zeros to skip it.
struct Gate {
  BufferRef arguments;
  uint32_t firstCommand = 0;
};

/// Records one dispatch, direct or indirect. Returned by the setup of a pass.
template <class Push>
struct Dispatch {
  Kernel kernel;
  uint64_t groups = 0;
  BufferRef arguments;  ///< empty: dispatches `groups` directly
  uint64_t offset = 0;
  Push push;

  void operator()(Commands& commands) const {
    if (arguments == BufferRef{})
      commands.dispatch(kernel, groups, push);
    else
      commands.dispatchIndirect(kernel, arguments, offset, push);
  }
};

/// Assigns consecutive indirect commands to a module's dispatches while its passes are declared.
class Dispatches {
 public:
  explicit Dispatches(const Gate* gate, uint32_t first = 0) : gate_(gate ? *gate : Gate{}), next_(first) {}

  /// The next dispatch that `pass` records.
  template <class Push>
  Dispatch<Push> next(Pass& pass, Kernel kernel, uint64_t groups, const Push& push) {
    if (gate_.arguments == BufferRef{}) return {kernel, groups, {}, 0, push};
    pass.read(gate_.arguments, Use::Indirect);
    return {kernel, groups, gate_.arguments, (gate_.firstCommand + uint64_t{next_++}) * sizeof(VkDispatchIndirectCommand), push};
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
