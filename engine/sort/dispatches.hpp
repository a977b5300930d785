#pragma once
// The dispatches of a module, one after another, recorded as they are or through arguments that the device decides on.
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

/// Words that an array of `count` needs which is loaded and stored four at a time.
constexpr uint64_t paddedWords(uint64_t count) { return (count + 3) / 4 * 4; }

/// How a pass uses an array that it reads: see shaders/shared/arrays.glsl.
constexpr Use readUse(bool texels) { return texels ? Use::ComputeTexel : Use::ComputeRead; }

/// `target`, or a transient of `count` uints where there is none.
BufferRef targetOr(Graph& graph, BufferRef target, std::string_view name, uint64_t count);

/// Dispatch arguments decided on the device, for a module that runs in some frames alone. The module's dispatch k is read at
/// byte (firstCommand + k) * sizeof(VkDispatchIndirectCommand) of `arguments`: whoever writes them puts the module's groups()
/// there, or zeros.
struct Gate {
  BufferRef arguments;
  uint32_t firstCommand = 0;
};

/// Records one dispatch, direct or through a gate: what the set-up of a pass returns.
template <class Push>
struct Dispatch {
  Kernel kernel;
  uint64_t groups = 0;
  BufferRef arguments;  ///< none: `groups` are dispatched
  uint64_t offset = 0;
  Push push;

  void operator()(Commands& commands) const {
    if (arguments == BufferRef{})
      commands.dispatch(kernel, groups, push);
    else
      commands.dispatchIndirect(kernel, arguments, offset, push);
  }
};

/// Counts a module's dispatches while its passes are declared, so that each finds its command behind the gate.
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

  /// The gate for a module within this one, which takes `count` commands.
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
