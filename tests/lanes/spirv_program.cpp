#include "lanes/spirv_program.hpp"

#include <spirv-tools/optimizer.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace rill::lanes {

using spv::Op;

namespace {

Instruction decode(std::span<const uint32_t> words) {
  Instruction out{static_cast<Op>(words[0] & 0xffffu), 0, 0, {}};
  bool hasResult = false, hasType = false;
  spv::HasResultAndType(out.op, &hasResult, &hasType);
  size_t at = 1;
  if (hasType) out.type = words[at++];
  if (hasResult) out.result = words[at++];
  out.operands.assign(words.begin() + static_cast<std::ptrdiff_t>(at), words.end());
  return out;
}

// With calls inlined, as in release builds.
std::vector<uint32_t> optimized(std::span<const uint32_t> words) {
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_3);
  optimizer.RegisterPerformancePasses();
  std::vector<uint32_t> out;
  if (!optimizer.Run(words.data(), words.size(), &out)) throw std::runtime_error("the shader cannot be optimized");
  return out;
}

}  // namespace

Program::Program(std::span<const uint32_t> shader, const std::map<uint32_t, uint32_t>& specialization) {
  const std::vector<uint32_t> optimizedWords = optimized(shader);
  const std::span<const uint32_t> words(optimizedWords);
  bound = words[3];
  typeOf.resize(bound);
  std::vector<Instruction>* block = nullptr;
  for (size_t at = 5; at < words.size(); at += words[at] >> 16) {
    const Instruction instruction = decode(words.subspan(at, words[at] >> 16));
    if (instruction.result) typeOf[instruction.result] = instruction.type;
    if (instruction.op == Op::OpLabel) {
      if (!entry) entry = instruction.result;
      block = &blocks[instruction.result];
    } else if (instruction.op == Op::OpFunctionEnd) {
      block = nullptr;
    } else if (block && instruction.op != Op::OpVariable) {
      block->push_back(instruction);
    } else {
      decorate(instruction);
      declare(instruction, specialization);
    }
  }
}

void Program::decorate(const Instruction& instruction) {
  const auto& operands = instruction.operands;
  if (instruction.op == Op::OpMemberDecorate && operands[2] == static_cast<uint32_t>(spv::Decoration::Offset))
    offsets_[operands[0]][operands[1]] = operands[3];
  if (instruction.op != Op::OpDecorate) return;
  if (operands.size() > 2) decorations_[{operands[0], static_cast<spv::Decoration>(operands[1])}] = operands[2];
}

std::optional<uint32_t> Program::decoration(uint32_t id, spv::Decoration decoration) const {
  const auto found = decorations_.find({id, decoration});
  return found == decorations_.end() ? std::nullopt : std::optional(found->second);
}

void Program::declare(const Instruction& instruction, const std::map<uint32_t, uint32_t>& specialization) {
  const uint32_t id = instruction.result;
  const auto& operands = instruction.operands;
  const auto constant = [&](const Value& value) { constants[id] = value; };
  const auto specialized = [&](uint32_t otherwise) {
    const auto constantId = decoration(id, spv::Decoration::SpecId);
    const auto given = constantId ? specialization.find(*constantId) : specialization.end();
    return given == specialization.end() ? otherwise : given->second;
  };
  Type type{instruction.op, 0, 1, decoration(id, spv::Decoration::ArrayStride).value_or(0), {}, {}};
  switch (instruction.op) {
    case Op::OpTypeVoid:
    case Op::OpTypeBool:
    case Op::OpTypeFloat:
    case Op::OpTypeInt:
      types[id] = type;
      break;
    case Op::OpTypeVector:
      type.components = operands[1];
      [[fallthrough]];
    case Op::OpTypeArray:
    case Op::OpTypeRuntimeArray:
      type.element = operands[0];
      types[id] = type;
      break;
    case Op::OpTypePointer:
      type.element = operands[1];
      types[id] = type;
      break;
    case Op::OpTypeStruct:
      type.members = operands;
      type.offsets = offsets_[id];
      types[id] = type;
      break;
    case Op::OpConstantTrue:
      constant({1});
      break;
    case Op::OpConstantFalse:
    case Op::OpConstantNull:
    case Op::OpUndef:
      constant({});
      break;
    case Op::OpConstant:
      constant({operands[0]});
      break;
    case Op::OpSpecConstant:
      constant({specialized(operands[0])});
      break;
    case Op::OpSpecConstantTrue:
      constant({specialized(1)});
      break;
    case Op::OpSpecConstantFalse:
      constant({specialized(0)});
      break;
    case Op::OpConstantComposite:
    case Op::OpSpecConstantComposite: {
      Value value{};
      for (size_t k = 0; k < operands.size() && k < value.size(); ++k) value[k] = constants[operands[k]][0];
      constant(value);
      break;
    }
    case Op::OpSpecConstantOp: {
      const Instruction inner{static_cast<Op>(operands[0]), instruction.type, id, {operands.begin() + 1, operands.end()}};
      std::vector<const Value*> values;
      for (const uint32_t operand : inner.operands) values.push_back(&constants[operand]);
      Value value{};
      if (!evaluate(*this, inner, values, value))
        throw std::runtime_error("cannot evaluate OpSpecConstantOp of instruction " + std::to_string(operands[0]));
      constant(value);
      break;
    }
    case Op::OpVariable: {
      Variable variable{Variable::Kind::Local, 0, spv::BuiltIn::Max, types[instruction.type].element};
      if (const auto binding = decoration(id, spv::Decoration::Binding)) {
        variable.kind = Variable::Kind::Buffer;
        variable.binding = *binding;
      } else if (const auto builtIn = decoration(id, spv::Decoration::BuiltIn)) {
        variable.kind = Variable::Kind::Input;
        variable.builtIn = static_cast<spv::BuiltIn>(*builtIn);
      } else if (static_cast<spv::StorageClass>(operands[0]) == spv::StorageClass::PushConstant) {
        variable.kind = Variable::Kind::Push;
      } else if (static_cast<spv::StorageClass>(operands[0]) == spv::StorageClass::Workgroup) {
        variable.kind = Variable::Kind::Shared;
      }
      variables[id] = variable;
      break;
    }
    default:
      break;
  }
}

uint32_t componentsOf(const Program& program, uint32_t type) { return program.types.at(type).components; }

}  // namespace rill::lanes
