#include "spirv_module.hpp"

#include <algorithm>

namespace rill::layer {

using Kind = NumericType::Kind;

SpirvModule::SpirvModule(std::span<const uint32_t> words) : header_(words.begin(), words.begin() + 5), bound_(words[3]) {
  bool inFunctions = false;
  for (size_t at = 5; at < words.size();) {
    const uint32_t length = std::max(words[at] >> 16, 1u);
    Instruction instruction{static_cast<spv::Op>(words[at] & 0xffffu), {words.begin() + at + 1, words.begin() + at + length}};
    at += length;
    inFunctions = inFunctions || instruction.op == spv::Op::OpFunction;
    if (resultIndex(instruction.op) == 1) valueTypes_[instruction.operands[1]] = instruction.operands[0];
    (inFunctions ? functions_ : globals_).push_back(std::move(instruction));
  }
}

std::vector<uint32_t> SpirvModule::words() const {
  std::vector<uint32_t> out = header_;
  out[3] = bound_;
  for (const auto* part : {&globals_, &functions_})
    for (const Instruction& instruction : *part) {
      out.push_back(static_cast<uint32_t>(instruction.operands.size() + 1) << 16 | static_cast<uint32_t>(instruction.op));
      out.insert(out.end(), instruction.operands.begin(), instruction.operands.end());
    }
  return out;
}

void SpirvModule::rewriteFunctions(const std::function<std::vector<Instruction>(const Instruction&)>& rewrite) {
  std::vector<Instruction> out;
  for (const Instruction& instruction : functions_)
    for (Instruction& replacement : rewrite(instruction)) {
      if (resultIndex(replacement.op) == 1) valueTypes_[replacement.operands[1]] = replacement.operands[0];
      out.push_back(std::move(replacement));
    }
  functions_ = std::move(out);
}

int SpirvModule::resultIndex(spv::Op op) {
  bool hasResult = false, hasType = false;
  spv::HasResultAndType(op, &hasResult, &hasType);
  return hasResult ? (hasType ? 1 : 0) : -1;
}

NumericType SpirvModule::typeOf(uint32_t typeId) const {
  for (const Instruction& g : globals_) {
    if (g.operands.empty() || g.operands[0] != typeId) continue;
    switch (g.op) {
      case spv::Op::OpTypeFloat:
        return {g.operands[1] == 32 ? Kind::Float : Kind::Other, 1};
      case spv::Op::OpTypeInt:
        return {g.operands[1] != 32 ? Kind::Other : g.operands[2] ? Kind::Int : Kind::Uint, 1};
      case spv::Op::OpTypeBool:
        return {Kind::Bool, 1};
      case spv::Op::OpTypeVector:
        return {typeOf(g.operands[1]).kind, g.operands[2]};
      default:
        break;
    }
  }
  return {};
}

NumericType SpirvModule::typeOfValue(uint32_t id) const {
  const auto found = valueTypes_.find(id);
  return found == valueTypes_.end() ? NumericType{} : typeOf(found->second);
}

uint32_t SpirvModule::addGlobal(spv::Op op, std::vector<uint32_t> operands) {
  const uint32_t id = operands[resultIndex(op) == 1 ? 1 : 0];
  if (resultIndex(op) == 1) valueTypes_[id] = operands[0];
  globals_.push_back({op, std::move(operands)});
  return id;
}

uint32_t SpirvModule::type(Kind kind, uint32_t components) {
  const uint32_t element = components > 1 ? type(kind, 1) : 0;
  for (const Instruction& g : globals_) {
    if (g.op != spv::Op::OpTypeFloat && g.op != spv::Op::OpTypeInt && g.op != spv::Op::OpTypeBool && g.op != spv::Op::OpTypeVector)
      continue;
    const NumericType found = typeOf(g.operands[0]);
    if (found.kind == kind && found.components == components) return g.operands[0];
  }
  if (components > 1) return addGlobal(spv::Op::OpTypeVector, {newId(), element, components});
  switch (kind) {
    case Kind::Float:
      return addGlobal(spv::Op::OpTypeFloat, {newId(), 32});
    case Kind::Uint:
      return addGlobal(spv::Op::OpTypeInt, {newId(), 32, 0});
    case Kind::Int:
      return addGlobal(spv::Op::OpTypeInt, {newId(), 32, 1});
    default:
      return addGlobal(spv::Op::OpTypeBool, {newId()});
  }
}

uint32_t SpirvModule::constant(Kind kind, uint32_t bits, uint32_t components) {
  const uint32_t typeId = type(kind, components);
  if (components > 1) {
    const uint32_t element = constant(kind, bits, 1);
    std::vector<uint32_t> operands{typeId, newId()};
    operands.insert(operands.end(), components, element);
    return addGlobal(spv::Op::OpConstantComposite, std::move(operands));
  }
  for (const Instruction& g : globals_)
    if (g.op == spv::Op::OpConstant && g.operands[0] == typeId && g.operands[2] == bits) return g.operands[1];
  return addGlobal(spv::Op::OpConstant, {typeId, newId(), bits});
}

uint32_t SpirvModule::findBuiltIn(spv::BuiltIn builtIn) const {
  for (const Instruction& g : globals_)
    if (g.op == spv::Op::OpDecorate && g.operands[1] == static_cast<uint32_t>(spv::Decoration::BuiltIn) &&
        g.operands[2] == static_cast<uint32_t>(builtIn))
      for (const Instruction& variable : globals_)
        if (variable.op == spv::Op::OpVariable && variable.operands[1] == g.operands[0]) return g.operands[0];
  return 0;
}

uint32_t SpirvModule::builtIn(spv::BuiltIn builtIn, uint32_t components) {
  if (const uint32_t found = findBuiltIn(builtIn)) return found;
  const uint32_t held = type(Kind::Uint, components), pointer = newId(), variable = newId();
  const auto input = static_cast<uint32_t>(spv::StorageClass::Input);
  addGlobal(spv::Op::OpTypePointer, {pointer, input, held});
  addGlobal(spv::Op::OpVariable, {pointer, variable, input});
  const auto at = std::find_if(globals_.begin(), globals_.end(), [](const Instruction& g) { return g.op == spv::Op::OpDecorate; });
  globals_.insert(at, {spv::Op::OpDecorate, {variable, static_cast<uint32_t>(spv::Decoration::BuiltIn), static_cast<uint32_t>(builtIn)}});
  for (Instruction& g : globals_)
    if (g.op == spv::Op::OpEntryPoint) g.operands.push_back(variable);
  return variable;
}

void SpirvModule::requireCapability(spv::Capability capability) {
  for (const Instruction& g : globals_)
    if (g.op == spv::Op::OpCapability && g.operands[0] == static_cast<uint32_t>(capability)) return;
  globals_.insert(globals_.begin(), {spv::Op::OpCapability, {static_cast<uint32_t>(capability)}});
}

bool SpirvModule::constantBits(uint32_t id, uint32_t& bits) const {
  for (const Instruction& g : globals_) {
    if (g.operands.size() < 3 || g.operands[1] != id) continue;
    if (g.op == spv::Op::OpConstant) {
      bits = g.operands[2];
      return true;
    }
    if (g.op == spv::Op::OpConstantComposite)
      return std::all_of(g.operands.begin() + 2, g.operands.end(), [&](uint32_t element) { return element == g.operands[2]; }) &&
             constantBits(g.operands[2], bits);
  }
  return false;
}

bool SpirvModule::isDecorated(uint32_t id, spv::Decoration decoration) const {
  return std::any_of(globals_.begin(), globals_.end(), [&](const Instruction& g) {
    return g.op == spv::Op::OpDecorate && g.operands[0] == id && g.operands[1] == static_cast<uint32_t>(decoration);
  });
}

bool SpirvModule::isCompute() const {
  return std::any_of(globals_.begin(), globals_.end(), [](const Instruction& g) {
    return g.op == spv::Op::OpEntryPoint && g.operands[0] == static_cast<uint32_t>(spv::ExecutionModel::GLCompute);
  });
}

uint32_t SpirvModule::workgroupSize(uint32_t axis) const {
  for (const Instruction& g : globals_) {
    if (g.op == spv::Op::OpExecutionMode && g.operands[1] == static_cast<uint32_t>(spv::ExecutionMode::LocalSize))
      return g.operands[2 + axis];
    uint32_t size = 1;
    if (g.op == spv::Op::OpExecutionModeId && g.operands[1] == static_cast<uint32_t>(spv::ExecutionMode::LocalSizeId) &&
        constantBits(g.operands[2 + axis], size))
      return size;
  }
  return 1;
}

}  // namespace rill::layer
