#pragma once
// What the rewrites of spirv_rewrites.hpp share.
#include "spirv_module.hpp"

namespace rill::layer {

/// An instruction whose result, of the given id, `after` changes: it is computed under a new id first.
template <class After>
std::vector<Instruction> thenChanged(SpirvModule& module, const Instruction& instruction, const After& after) {
  std::vector<Instruction> out{instruction};
  const uint32_t result = instruction.operands[1];
  out[0].operands[1] = module.newId();
  after(out, out[0].operands[1], result);
  return out;
}

/// A hash.
inline uint32_t mixed(uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

}  // namespace rill::layer
