// Instructions without side effects, component by component.
#include <spirv/unified1/GLSL.std.450.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <stdexcept>
#include <string>

#include "lanes/spirv_program.hpp"

namespace rill::lanes {
namespace {

using spv::Op;

float f(uint32_t bits) { return std::bit_cast<float>(bits); }
uint32_t u(float value) { return std::bit_cast<uint32_t>(value); }
int32_t s(uint32_t bits) { return std::bit_cast<int32_t>(bits); }
uint32_t u(int32_t value) { return std::bit_cast<uint32_t>(value); }

uint32_t half(uint32_t bits) {  // to the nearest, ties to even
  const uint32_t sign = (bits >> 16) & 0x8000u, size = bits & 0x7fffffffu;
  if (size >= 0x47800000u) return sign | (size > 0x7f800000u ? 0x7e00u : 0x7c00u);
  if (size < 0x38800000u) return sign | static_cast<uint32_t>(std::nearbyint(std::ldexp(f(size), 24)));
  return sign | ((size - 0x38000000u + 0xfffu + ((size >> 13) & 1u)) >> 13);
}

/// Instructions that take their operands' components one by one.
using Component = uint32_t (*)(uint32_t, uint32_t);
const std::map<Op, Component> kComponents = {
    {Op::OpFAdd, [](uint32_t a, uint32_t b) { return u(f(a) + f(b)); }},
    {Op::OpFSub, [](uint32_t a, uint32_t b) { return u(f(a) - f(b)); }},
    {Op::OpFMul, [](uint32_t a, uint32_t b) { return u(f(a) * f(b)); }},
    {Op::OpFDiv, [](uint32_t a, uint32_t b) { return u(f(a) / f(b)); }},
    {Op::OpFNegate, [](uint32_t a, uint32_t) { return a ^ 0x80000000u; }},
    {Op::OpIAdd, [](uint32_t a, uint32_t b) { return a + b; }},
    {Op::OpISub, [](uint32_t a, uint32_t b) { return a - b; }},
    {Op::OpIMul, [](uint32_t a, uint32_t b) { return a * b; }},
    {Op::OpUDiv, [](uint32_t a, uint32_t b) { return b ? a / b : 0; }},
    {Op::OpUMod, [](uint32_t a, uint32_t b) { return b ? a % b : 0; }},
    {Op::OpSNegate, [](uint32_t a, uint32_t) { return 0u - a; }},
    {Op::OpBitwiseAnd, [](uint32_t a, uint32_t b) { return a & b; }},
    {Op::OpLogicalAnd, [](uint32_t a, uint32_t b) { return a & b; }},
    {Op::OpBitwiseOr, [](uint32_t a, uint32_t b) { return a | b; }},
    {Op::OpLogicalOr, [](uint32_t a, uint32_t b) { return a | b; }},
    {Op::OpBitwiseXor, [](uint32_t a, uint32_t b) { return a ^ b; }},
    {Op::OpLogicalNotEqual, [](uint32_t a, uint32_t b) { return a ^ b; }},
    {Op::OpLogicalEqual, [](uint32_t a, uint32_t b) { return uint32_t(a == b); }},
    {Op::OpNot, [](uint32_t a, uint32_t) { return ~a; }},
    {Op::OpLogicalNot, [](uint32_t a, uint32_t) { return a ^ 1u; }},
    {Op::OpShiftLeftLogical, [](uint32_t a, uint32_t b) { return b < 32 ? a << b : 0; }},
    {Op::OpShiftRightLogical, [](uint32_t a, uint32_t b) { return b < 32 ? a >> b : 0; }},
    {Op::OpShiftRightArithmetic, [](uint32_t a, uint32_t b) { return u(s(a) >> std::min(b, 31u)); }},
    {Op::OpIEqual, [](uint32_t a, uint32_t b) { return uint32_t(a == b); }},
    {Op::OpINotEqual, [](uint32_t a, uint32_t b) { return uint32_t(a != b); }},
    {Op::OpULessThan, [](uint32_t a, uint32_t b) { return uint32_t(a < b); }},
    {Op::OpULessThanEqual, [](uint32_t a, uint32_t b) { return uint32_t(a <= b); }},
    {Op::OpUGreaterThan, [](uint32_t a, uint32_t b) { return uint32_t(a > b); }},
    {Op::OpUGreaterThanEqual, [](uint32_t a, uint32_t b) { return uint32_t(a >= b); }},
    {Op::OpSLessThan, [](uint32_t a, uint32_t b) { return uint32_t(s(a) < s(b)); }},
    {Op::OpSLessThanEqual, [](uint32_t a, uint32_t b) { return uint32_t(s(a) <= s(b)); }},
    {Op::OpSGreaterThan, [](uint32_t a, uint32_t b) { return uint32_t(s(a) > s(b)); }},
    {Op::OpSGreaterThanEqual, [](uint32_t a, uint32_t b) { return uint32_t(s(a) >= s(b)); }},
    {Op::OpFOrdEqual, [](uint32_t a, uint32_t b) { return uint32_t(f(a) == f(b)); }},
    {Op::OpFUnordNotEqual, [](uint32_t a, uint32_t b) { return uint32_t(f(a) != f(b)); }},
    {Op::OpFOrdLessThan, [](uint32_t a, uint32_t b) { return uint32_t(f(a) < f(b)); }},
    {Op::OpFOrdLessThanEqual, [](uint32_t a, uint32_t b) { return uint32_t(f(a) <= f(b)); }},
    {Op::OpFOrdGreaterThan, [](uint32_t a, uint32_t b) { return uint32_t(f(a) > f(b)); }},
    {Op::OpFOrdGreaterThanEqual, [](uint32_t a, uint32_t b) { return uint32_t(f(a) >= f(b)); }},
    {Op::OpConvertFToU,
     [](uint32_t a, uint32_t) { return static_cast<uint32_t>(std::clamp(std::isnan(f(a)) ? 0.0 : double(f(a)), 0.0, 4294967295.0)); }},
    {Op::OpConvertFToS,
     [](uint32_t a, uint32_t) {
       return u(static_cast<int32_t>(std::clamp(std::isnan(f(a)) ? 0.0 : double(f(a)), -2147483648.0, 2147483647.0)));
     }},
    {Op::OpConvertUToF, [](uint32_t a, uint32_t) { return u(static_cast<float>(a)); }},
    {Op::OpConvertSToF, [](uint32_t a, uint32_t) { return u(static_cast<float>(s(a))); }},
    {Op::OpBitcast, [](uint32_t a, uint32_t) { return a; }},
    {Op::OpCopyObject, [](uint32_t a, uint32_t) { return a; }},
};

/// Functions of GLSL.std.450, likewise.
using Function = uint32_t (*)(uint32_t, uint32_t, uint32_t);
const std::map<uint32_t, Function> kFunctions = {
    {GLSLstd450Trunc, [](uint32_t a, uint32_t, uint32_t) { return u(std::trunc(f(a))); }},
    {GLSLstd450FAbs, [](uint32_t a, uint32_t, uint32_t) { return a & 0x7fffffffu; }},
    {GLSLstd450Floor, [](uint32_t a, uint32_t, uint32_t) { return u(std::floor(f(a))); }},
    {GLSLstd450Ceil, [](uint32_t a, uint32_t, uint32_t) { return u(std::ceil(f(a))); }},
    {GLSLstd450Fract, [](uint32_t a, uint32_t, uint32_t) { return u(f(a) - std::floor(f(a))); }},
    {GLSLstd450Pow, [](uint32_t a, uint32_t b, uint32_t) { return u(std::pow(f(a), f(b))); }},
    {GLSLstd450Sqrt, [](uint32_t a, uint32_t, uint32_t) { return u(std::sqrt(f(a))); }},
    {GLSLstd450FMin, [](uint32_t a, uint32_t b, uint32_t) { return f(b) < f(a) ? b : a; }},
    {GLSLstd450UMin, [](uint32_t a, uint32_t b, uint32_t) { return std::min(a, b); }},
    {GLSLstd450SMin, [](uint32_t a, uint32_t b, uint32_t) { return u(std::min(s(a), s(b))); }},
    {GLSLstd450FMax, [](uint32_t a, uint32_t b, uint32_t) { return f(a) < f(b) ? b : a; }},
    {GLSLstd450UMax, [](uint32_t a, uint32_t b, uint32_t) { return std::max(a, b); }},
    {GLSLstd450SMax, [](uint32_t a, uint32_t b, uint32_t) { return u(std::max(s(a), s(b))); }},
    {GLSLstd450FClamp, [](uint32_t a, uint32_t b, uint32_t c) { return f(a) < f(b) ? b : (f(a) > f(c) ? c : a); }},
    {GLSLstd450UClamp, [](uint32_t a, uint32_t b, uint32_t c) { return std::min(std::max(a, b), c); }},
    {GLSLstd450FMix, [](uint32_t a, uint32_t b, uint32_t c) { return u(f(a) * (1 - f(c)) + f(b) * f(c)); }},
    {GLSLstd450Fma, [](uint32_t a, uint32_t b, uint32_t c) { return u(f(a) * f(b) + f(c)); }},
    {GLSLstd450FindILsb, [](uint32_t a, uint32_t, uint32_t) { return a ? static_cast<uint32_t>(std::countr_zero(a)) : ~0u; }},
    {GLSLstd450FindUMsb, [](uint32_t a, uint32_t, uint32_t) { return a ? 31u - static_cast<uint32_t>(std::countl_zero(a)) : ~0u; }},
};

float dot(const Value& a, const Value& b, uint32_t components) {
  float sum = 0;
  for (uint32_t k = 0; k < components; ++k) sum += f(a[k]) * f(b[k]);
  return sum;
}

}  // namespace

bool evaluate(const Program& program, const Instruction& instruction, std::span<const Value* const> in, Value& out) {
  const Op op = instruction.op;
  const uint32_t n = componentsOf(program, instruction.type);
  const auto& operands = instruction.operands;
  const auto size = [&](size_t k) { return componentsOf(program, program.typeOf[operands[k]]); };
  const auto operand = [&](size_t k, uint32_t c) { return k < in.size() ? (*in[k])[c] : 0; };
  out = {};
  switch (op) {
    case Op::OpUndef:
      return true;
    case Op::OpCompositeConstruct: {
      uint32_t at = 0;
      for (size_t k = 0; k < in.size(); ++k)
        for (uint32_t c = 0; c < size(k) && at < n; ++c) out[at++] = (*in[k])[c];
      return true;
    }
    case Op::OpCompositeExtract:
      out[0] = (*in[0])[operands[1]];
      return true;
    case Op::OpCompositeInsert:
      out = *in[1];
      out[operands[2]] = (*in[0])[0];
      return true;
    case Op::OpVectorShuffle:
      for (uint32_t k = 0; k < n; ++k) {
        const uint32_t from = operands[2 + k];
        out[k] = from < size(0) ? (*in[0])[from] : (*in[1])[(from - size(0)) % 4];
      }
      return true;
    case Op::OpSelect:  // by one condition, or one a component
      for (uint32_t k = 0; k < n; ++k) out[k] = operand(0, size(0) == 1 ? 0 : k) ? operand(1, k) : operand(2, k);
      return true;
    case Op::OpVectorTimesScalar:
      for (uint32_t k = 0; k < n; ++k) out[k] = u(f((*in[0])[k]) * f((*in[1])[0]));
      return true;
    case Op::OpDot:
      out[0] = u(dot(*in[0], *in[1], size(0)));
      return true;
    case Op::OpAll:
      out[0] = 1;
      for (uint32_t k = 0; k < size(0); ++k) out[0] &= (*in[0])[k];
      return true;
    case Op::OpAny:
      for (uint32_t k = 0; k < size(0); ++k) out[0] |= (*in[0])[k];
      return true;
    case Op::OpExtInst: {
      const uint32_t number = operands[1];
      if (number == GLSLstd450PackHalf2x16) {
        out[0] = half(operand(2, 0)) | half(operand(2, 1)) << 16;
        return true;
      }
      if (number == GLSLstd450UnpackHalf2x16) {
        for (uint32_t k = 0; k < 2; ++k) out[k] = u(glm::unpackHalf1x16(static_cast<uint16_t>(operand(2, 0) >> (16 * k))));
        return true;
      }
      if (number == GLSLstd450Length) {
        out[0] = u(std::sqrt(dot(*in[2], *in[2], size(2))));
        return true;
      }
      const auto found = kFunctions.find(number);
      if (found == kFunctions.end()) throw std::runtime_error("unknown function " + std::to_string(number) + " of GLSL.std.450");
      for (uint32_t k = 0; k < n; ++k) out[k] = found->second(operand(2, k), operand(3, k), operand(4, k));
      return true;
    }
    default: {
      const auto found = kComponents.find(op);
      for (uint32_t k = 0; k < n && found != kComponents.end(); ++k) out[k] = found->second(operand(0, k), operand(1, k));
      return found != kComponents.end();
    }
  }
}

}  // namespace rill::lanes
