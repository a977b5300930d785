// The rewrites that change arithmetic: denormals, infinities, rounding.
#include <spirv/unified1/GLSL.std.450.h>

#include <map>

#include "spirv_changes.hpp"
#include "spirv_rewrites.hpp"

namespace rill::layer {
namespace {

using Kind = NumericType::Kind;
using spv::Op;

constexpr uint32_t kInfinityBits = 0x7f800000u;

bool isArithmetic(Op op) {
  switch (op) {
    case Op::OpFAdd:
    case Op::OpFSub:
    case Op::OpFMul:
    case Op::OpFDiv:
    case Op::OpFRem:
    case Op::OpFMod:
    case Op::OpVectorTimesScalar:
    case Op::OpMatrixTimesVector:
    case Op::OpVectorTimesMatrix:
    case Op::OpDot:
    case Op::OpExtInst:
    case Op::OpGroupNonUniformFAdd:
    case Op::OpConvertSToF:
    case Op::OpConvertUToF:
      return true;
    default:
      return false;
  }
}

uint32_t hashOf(std::span<const uint32_t> words) {
  uint32_t hash = 2166136261u;
  for (const uint32_t word : words) hash = (hash ^ word) * 16777619u;
  return hash;
}

/// Adds instructions that clear the field `size` of `bits` where it is below `least`; the result's id.
uint32_t withoutDenormals(SpirvModule& module, std::vector<Instruction>& out, uint32_t components, uint32_t bits, uint32_t size,
                          uint32_t least) {
  const uint32_t uints = module.type(Kind::Uint, components), bools = module.type(Kind::Bool, components);
  const auto constant = [&](uint32_t value) { return module.constant(Kind::Uint, value, components); };
  const uint32_t masked = module.newId(), small = module.newId(), none = module.newId(), kept = module.newId();
  out.push_back({Op::OpBitwiseAnd, {uints, masked, bits, constant(size)}});
  out.push_back({Op::OpULessThan, {bools, small, masked, constant(least)}});
  out.push_back({Op::OpBitwiseAnd, {uints, none, bits, constant(~size)}});
  out.push_back({Op::OpSelect, {uints, kept, small, none, bits}});
  return kept;
}

constexpr uint32_t kFloatSize = 0x7fffffffu, kLeastNormal = 0x00800000u, kLeastNormalHalf = 0x38800000u;  // the last: as a float

/// Halves packed into a word, and what such words hold.
std::vector<Instruction> flushHalves(SpirvModule& module, const Instruction& instruction) {
  const bool packs = instruction.operands[3] == GLSLstd450PackHalf2x16;
  return thenChanged(module, instruction, [&](std::vector<Instruction>& out, uint32_t from, uint32_t to) {
    const uint32_t type = instruction.operands[0];
    if (packs) {
      const uint32_t low = withoutDenormals(module, out, 1, from, 0x7fffu, 0x400u);
      const uint32_t both = withoutDenormals(module, out, 1, low, 0x7fff0000u, 0x04000000u);
      out.push_back({Op::OpCopyObject, {type, to, both}});
    } else {
      const uint32_t bits = module.newId();
      out.push_back({Op::OpBitcast, {module.type(Kind::Uint, 2), bits, from}});
      out.push_back({Op::OpBitcast, {type, to, withoutDenormals(module, out, 2, bits, kFloatSize, kLeastNormalHalf)}});
    }
  });
}

}  // namespace

std::vector<uint32_t> flushDenormals(std::span<const uint32_t> words) {
  SpirvModule module(words);
  module.rewriteFunctions([&](const Instruction& instruction) -> std::vector<Instruction> {
    if (instruction.op == Op::OpExtInst &&
        (instruction.operands[3] == GLSLstd450PackHalf2x16 || instruction.operands[3] == GLSLstd450UnpackHalf2x16))
      return flushHalves(module, instruction);
    const bool flushes = isArithmetic(instruction.op) || instruction.op == Op::OpImageFetch || instruction.op == Op::OpImageRead ||
                         instruction.op == Op::OpBitcast;
    const NumericType type = flushes ? module.typeOf(instruction.operands[0]) : NumericType{};
    // Bits of a float: those of the float that a load from memory, flushed, would have given.
    const bool takesBits = instruction.op == Op::OpBitcast && module.typeOfValue(instruction.operands[2]).kind == Kind::Float;
    if (type.kind != Kind::Float && !takesBits) return {instruction};
    const uint32_t uints = module.type(Kind::Uint, type.components);
    return thenChanged(module, instruction, [&](std::vector<Instruction>& out, uint32_t from, uint32_t to) {
      const uint32_t bits = module.newId();
      out.push_back({Op::OpBitcast, {uints, bits, from}});
      const uint32_t kept = withoutDenormals(module, out, type.components, bits, kFloatSize, kLeastNormal);
      out.push_back({Op::OpBitcast, {instruction.operands[0], to, kept}});
    });
  });
  return module.words();
}

namespace {

Op otherOrder(Op op) {
  switch (op) {
    case Op::OpFOrdEqual:
      return Op::OpFUnordEqual;
    case Op::OpFUnordEqual:
      return Op::OpFOrdEqual;
    case Op::OpFOrdNotEqual:
      return Op::OpFUnordNotEqual;
    case Op::OpFUnordNotEqual:
      return Op::OpFOrdNotEqual;
    case Op::OpFOrdLessThan:
      return Op::OpFUnordLessThan;
    case Op::OpFUnordLessThan:
      return Op::OpFOrdLessThan;
    case Op::OpFOrdGreaterThan:
      return Op::OpFUnordGreaterThan;
    case Op::OpFUnordGreaterThan:
      return Op::OpFOrdGreaterThan;
    case Op::OpFOrdLessThanEqual:
      return Op::OpFUnordLessThanEqual;
    case Op::OpFUnordLessThanEqual:
      return Op::OpFOrdLessThanEqual;
    case Op::OpFOrdGreaterThanEqual:
      return Op::OpFUnordGreaterThanEqual;
    case Op::OpFUnordGreaterThanEqual:
      return Op::OpFOrdGreaterThanEqual;
    default:
      return Op::OpNop;
  }
}

/// The outcome of comparing a finite number with +infinity; `swapped`: of comparing +infinity with it.
bool outcomeWithInfinity(Op op, bool swapped) {
  switch (op) {
    case Op::OpFOrdEqual:
    case Op::OpFUnordEqual:
      return false;
    case Op::OpFOrdNotEqual:
    case Op::OpFUnordNotEqual:
      return true;
    case Op::OpFOrdLessThan:
    case Op::OpFUnordLessThan:
    case Op::OpFOrdLessThanEqual:
    case Op::OpFUnordLessThanEqual:
      return !swapped;
    default:
      return swapped;
  }
}

}  // namespace

std::vector<uint32_t> assumeFinite(std::span<const uint32_t> words) {
  SpirvModule module(words);
  const auto is = [&](uint32_t id, uint32_t wanted) {
    uint32_t bits = 0;
    return module.typeOfValue(id).kind == Kind::Float && module.constantBits(id, bits) && (bits & 0x7fffffffu) == wanted;
  };
  std::map<uint32_t, uint32_t> castFrom;      // floats made of bits: the bits' ids
  const auto isInfinity = [&](uint32_t id) {  // positive
    uint32_t bits = 0;
    const bool isConstant = module.typeOfValue(id).kind == Kind::Float && module.constantBits(id, bits);
    return (isConstant || (castFrom.contains(id) && module.constantBits(castFrom[id], bits))) && bits == kInfinityBits;
  };
  module.rewriteFunctions([&](const Instruction& instruction) -> std::vector<Instruction> {
    const auto& operands = instruction.operands;
    const auto fixed = [&](bool outcome) -> std::vector<Instruction> {
      const uint32_t n = module.typeOf(operands[0]).components, zero = module.constant(Kind::Uint, 0, n);
      return {{outcome ? Op::OpIEqual : Op::OpINotEqual, {operands[0], operands[1], zero, zero}}};
    };
    if (instruction.op == Op::OpBitcast) castFrom[operands[1]] = operands[2];
    if (instruction.op == Op::OpIsNan || instruction.op == Op::OpIsInf) return fixed(false);
    if (const Op other = otherOrder(instruction.op); other != Op::OpNop) {
      if (isInfinity(operands[3])) return fixed(outcomeWithInfinity(instruction.op, false));
      if (isInfinity(operands[2])) return fixed(outcomeWithInfinity(instruction.op, true));
      return {{other, operands}};
    }
    if (instruction.op == Op::OpExtInst) {                   // NaN is what a minimum, maximum or clamp of it may give
      constexpr uint32_t kMin = 37, kMax = 40, kClamp = 43;  // of GLSL.std.450, for floats
      const uint32_t function = operands[3], type = operands[0];
      if (function != kMin && function != kMax && function != kClamp) return {instruction};
      const uint32_t bools = module.type(Kind::Bool, module.typeOf(type).components), x = operands[4];
      const uint32_t first = module.newId(), second = module.newId(), kept = module.newId();
      if (function == kClamp)
        return {{Op::OpFOrdLessThan, {bools, first, x, operands[5]}},
                {Op::OpSelect, {type, kept, first, operands[5], x}},
                {Op::OpFOrdGreaterThan, {bools, second, kept, operands[6]}},
                {Op::OpSelect, {type, operands[1], second, operands[6], kept}}};
      return {{function == kMin ? Op::OpFUnordLessThan : Op::OpFUnordGreaterThan, {bools, first, operands[5], x}},
              {Op::OpSelect, {type, kept, first, operands[5], x}},
              {Op::OpIsNan, {bools, second, x}},
              {Op::OpSelect, {type, operands[1], second, x, kept}}};
    }
    const bool cancels = instruction.op == Op::OpFSub && operands[2] == operands[3];
    const bool vanishes = instruction.op == Op::OpFMul && (is(operands[2], 0) || is(operands[3], 0));
    if (cancels || vanishes) {
      const uint32_t zero = module.constant(Kind::Float, 0, module.typeOf(operands[0]).components);
      return {{Op::OpCopyObject, {operands[0], operands[1], zero}}};
    }
    return {instruction};
  });
  return module.words();
}

std::vector<uint32_t> perturbRounding(std::span<const uint32_t> words, uint32_t seed) {
  SpirvModule module(words);
  // Variants of a shader that differ in how they read their arrays round alike, as they compute the same.
  std::vector<uint32_t> arithmetic;
  module.rewriteFunctions([&](const Instruction& instruction) -> std::vector<Instruction> {
    if (isArithmetic(instruction.op)) arithmetic.push_back(static_cast<uint32_t>(instruction.op));
    return {instruction};
  });
  uint32_t index = hashOf(arithmetic) + 0x9e3779b9u * seed;
  const auto isPowerOfTwo = [&](uint32_t id) {
    uint32_t bits = 0;
    return module.constantBits(id, bits) && (bits & 0x7fffffu) == 0;
  };
  module.rewriteFunctions([&](const Instruction& instruction) -> std::vector<Instruction> {
    switch (instruction.op) {
      case Op::OpFMul:
      case Op::OpVectorTimesScalar:
        if (isPowerOfTwo(instruction.operands[2]) || isPowerOfTwo(instruction.operands[3])) return {instruction};
        break;
      case Op::OpFDiv:
      case Op::OpDot:
        break;
      case Op::OpExtInst: {  // of GLSL.std.450: sines to square roots, length to normalize; not rounding, minimum, packing,
                             // nor Fma, which a driver may do as a product and a sum, both rounded right
        const uint32_t function = instruction.operands[3];
        if (!((function >= 13 && function <= 32) || (function >= 66 && function <= 69))) return {instruction};
        break;
      }
      default:
        return {instruction};
    }
    const NumericType type = module.typeOf(instruction.operands[0]);
    const uint32_t most = instruction.op == Op::OpFDiv ? 2 : 1;  // units: 2.5 are allowed a division, its own rounding among them
    const auto away = static_cast<int32_t>(mixed(++index) % (2 * most + 1)) - static_cast<int32_t>(most);
    if (type.kind != Kind::Float || away == 0 || module.isDecorated(instruction.operands[1], spv::Decoration::NoContraction))
      return {instruction};
    const uint32_t n = type.components, uints = module.type(Kind::Uint, n), bools = module.type(Kind::Bool, n);
    const uint32_t exponent = module.constant(Kind::Uint, 0x7f800000u, n), zero = module.constant(Kind::Uint, 0, n);
    const uint32_t units = module.constant(Kind::Uint, static_cast<uint32_t>(away), n);
    return thenChanged(module, instruction, [&](std::vector<Instruction>& out, uint32_t from, uint32_t to) {
      const uint32_t bits = module.newId(), masked = module.newId(), small = module.newId(), huge = module.newId(), exact = module.newId(),
                     moved = module.newId(), kept = module.newId();
      out.push_back({Op::OpBitcast, {uints, bits, from}});
      out.push_back({Op::OpBitwiseAnd, {uints, masked, bits, exponent}});
      out.push_back({Op::OpIEqual, {bools, small, masked, zero}});
      out.push_back({Op::OpIEqual, {bools, huge, masked, exponent}});
      out.push_back({Op::OpLogicalOr, {bools, exact, small, huge}});
      out.push_back({Op::OpIAdd, {uints, moved, bits, units}});
      out.push_back({Op::OpSelect, {uints, kept, exact, bits, moved}});
      out.push_back({Op::OpBitcast, {instruction.operands[0], to, kept}});
    });
  });
  return module.words();
}

}  // namespace rill::layer
