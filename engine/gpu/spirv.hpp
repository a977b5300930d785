#pragma once
// Numbers of the SPIR-V specification (1.6, section 3); the package of its headers is not needed for these alone.
#include <cstddef>
#include <cstdint>
#include <span>

namespace rill::spirv {

constexpr size_t kHeader = 5;  ///< words before the first instruction

enum Op : uint32_t {
  kOpExtension = 10,
  kOpEntryPoint = 15,
  kOpExecutionMode = 16,
  kOpCapability = 17,
  kOpConstant = 43,
  kOpConstantComposite = 44,
  kOpSpecConstant = 50,
  kOpSpecConstantComposite = 51,
  kOpFunction = 54,
  kOpDecorate = 71,
  kOpExecutionModeId = 331
};

/// Of the first word of an instruction.
constexpr uint32_t opcodeOf(uint32_t word) { return word & 0xFFFFu; }
constexpr uint32_t lengthOf(uint32_t word) { return word >> 16; }

/// Calls visit(opcode, words of the instruction) for what a module declares before its first function. Stops where a length is invalid.
template <class Visit>
void forEachDeclaration(std::span<const uint32_t> spirv, Visit&& visit) {
  for (size_t at = kHeader; at < spirv.size();) {
    const uint32_t length = lengthOf(spirv[at]), opcode = opcodeOf(spirv[at]);
    if (length == 0 || at + length > spirv.size() || opcode == kOpFunction) return;
    visit(opcode, spirv.subspan(at, length));
    at += length;
  }
}

}  // namespace rill::spirv
