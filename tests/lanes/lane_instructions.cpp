#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>

#include "lanes/subgroup.hpp"

namespace rill::lanes {

using spv::Op;

void Subgroup::phis(const Tangle& tangle) {
  const auto& block = program_.blocks.at(tangle.block);
  std::vector<Value> found;
  for (uint32_t lane = 0; lane < lanes_.size(); ++lane) {
    if (!(tangle.lanes >> lane & 1)) continue;
    Lane& own = lanes_[lane];
    found.clear();
    for (size_t k = 0; k < block.size() && block[k].op == Op::OpPhi; ++k)  // all are read before one is written
      for (size_t j = 0; j + 1 < block[k].operands.size(); j += 2)
        if (block[k].operands[j + 1] == own.cameFrom) found.push_back(own.values[block[k].operands[j]]);
    for (size_t k = 0; k < found.size(); ++k) own.values[block[k].result] = found[k];
  }
}

void Subgroup::execute(const Instruction& instruction, uint64_t lanes) {
  if (executeTogether(instruction, lanes)) return;
  for (uint32_t lane = 0; lane < lanes_.size(); ++lane)
    if (lanes >> lane & 1) executeLane(instruction, lane);
}

uint32_t Subgroup::input(spv::BuiltIn builtIn, uint32_t lane, uint32_t component) const {
  switch (builtIn) {
    case spv::BuiltIn::SubgroupLocalInvocationId:
      return lane;
    case spv::BuiltIn::SubgroupSize:
      return place_.size;
    case spv::BuiltIn::SubgroupId:
      return place_.subgroup;
    case spv::BuiltIn::WorkgroupId:
      return component == 0 ? place_.group : 0;
    case spv::BuiltIn::NumWorkgroups:
      return component == 0 ? place_.groups : 1;
    case spv::BuiltIn::LocalInvocationId:
      return component == 0 ? place_.subgroup * place_.size + lane : 0;
    default:
      throw std::runtime_error("unknown built-in " + std::to_string(static_cast<uint32_t>(builtIn)));
  }
}

Value Subgroup::pointer(const Instruction& instruction, const Lane& lane) const {
  const auto& operands = instruction.operands;
  Value out = lane.values[operands[0]];
  uint32_t type = program_.types.at(program_.typeOf[operands[0]]).element;
  for (size_t k = 1; k < operands.size(); ++k) {
    const Type& outer = program_.types.at(type);
    const uint32_t index = lane.values[operands[k]][0];
    if (outer.op == Op::OpTypeStruct) {
      out[1] += outer.offsets.at(index);
      type = outer.members[index];
    } else {
      out[1] += index * (outer.op == Op::OpTypeVector ? 4 : outer.stride);
      type = outer.element;
    }
  }
  return out;
}

uint32_t& Subgroup::word(const Value& pointer, Lane& lane, uint32_t component) {
  const Variable& variable = program_.variables.at(pointer[0]);
  if (variable.kind == Variable::Kind::Shared) throw std::runtime_error("access to a shared variable: subgroups run one by one");
  const size_t index = pointer[1] / 4 + component;
  std::vector<uint32_t>* words = &memory_.push;
  if (variable.kind == Variable::Kind::Buffer) words = &memory_.buffers[variable.binding];
  if (variable.kind == Variable::Kind::Local) {
    words = &lane.locals[pointer[0]];
    words->resize(std::max(words->size(), size_t(componentsOf(program_, variable.type))));
  }
  if (index >= words->size())
    throw std::runtime_error("binding " + std::to_string(variable.binding) + ": word " + std::to_string(index) + " of " +
                             std::to_string(words->size()));
  return (*words)[index];
}

void Subgroup::executeLane(const Instruction& instruction, uint32_t index) {
  Lane& lane = lanes_[index];
  const auto& operands = instruction.operands;
  const auto value = [&](size_t k) -> const Value& { return lane.values[operands[k]]; };
  const auto atomic = [&](auto&& change) {
    uint32_t& word = this->word(value(0), lane, 0);
    lane.values[instruction.result] = {word};
    word = change(word, value(3)[0]);
  };
  switch (instruction.op) {
    case Op::OpAccessChain:
      lane.values[instruction.result] = pointer(instruction, lane);
      return;
    case Op::OpLoad: {
      const Variable& variable = program_.variables.at(value(0)[0]);
      if (program_.types.at(instruction.type).op == Op::OpTypeStruct) throw std::runtime_error("a structure is loaded");
      Value out{};
      for (uint32_t k = 0; k < componentsOf(program_, instruction.type); ++k)
        out[k] = variable.kind == Variable::Kind::Input ? input(variable.builtIn, index, value(0)[1] / 4 + k) : word(value(0), lane, k);
      lane.values[instruction.result] = out;
      return;
    }
    case Op::OpStore:
      for (uint32_t k = 0; k < componentsOf(program_, program_.typeOf[operands[1]]); ++k) word(value(0), lane, k) = value(1)[k];
      return;
    case Op::OpAtomicLoad:
      lane.values[instruction.result] = {word(value(0), lane, 0)};
      return;
    case Op::OpAtomicIAdd:
      return atomic([](uint32_t a, uint32_t b) { return a + b; });
    case Op::OpAtomicUMin:
      return atomic([](uint32_t a, uint32_t b) { return std::min(a, b); });
    case Op::OpAtomicUMax:
      return atomic([](uint32_t a, uint32_t b) { return std::max(a, b); });
    default: {
      std::array<const Value*, 8> in{};
      size_t count = 0;
      // Of composites and shuffles the later operands are numbers, of functions the first is the set and the second a number.
      for (; count < operands.size() && count < in.size(); ++count)
        in[count] = operands[count] < program_.bound ? &lane.values[operands[count]] : nullptr;
      Value out{};
      if (!evaluate(program_, instruction, std::span(in.data(), count), out))
        throw std::runtime_error("unknown instruction " + std::to_string(static_cast<uint32_t>(instruction.op)));
      lane.values[instruction.result] = out;
    }
  }
}

bool Subgroup::executeTogether(const Instruction& instruction, uint64_t lanes) {
  const auto& operands = instruction.operands;
  const auto reduce = [&](auto&& combine) {
    Value sum{};
    bool first = true;
    for (uint32_t lane = 0; lane < lanes_.size(); ++lane) {
      if (!(lanes >> lane & 1)) continue;
      const Value& own = lanes_[lane].values[operands[operands.size() - 1]];
      for (size_t k = 0; k < own.size(); ++k) sum[k] = first ? own[k] : combine(sum[k], own[k]);
      first = false;
    }
    for (uint32_t lane = 0; lane < lanes_.size(); ++lane)
      if (lanes >> lane & 1) lanes_[lane].values[instruction.result] = sum;
  };
  const auto shuffle = [&](auto&& source) {
    std::vector<Value> found(lanes_.size());
    for (uint32_t lane = 0; lane < lanes_.size(); ++lane) {
      if (!(lanes >> lane & 1)) continue;
      const uint32_t from = source(lane, lanes_[lane].values[operands[2]][0]);
      const bool isThere = from < lanes_.size() && (lanes >> from & 1);
      if (isThere)
        found[lane] = lanes_[from].values[operands[1]];
      else
        ++strayShuffles_;
    }
    for (uint32_t lane = 0; lane < lanes_.size(); ++lane)
      if (lanes >> lane & 1) lanes_[lane].values[instruction.result] = found[lane];
  };
  const auto number = [](uint32_t bits) { return std::bit_cast<float>(bits); };
  switch (instruction.op) {
    case Op::OpGroupNonUniformElect:
      for (uint32_t lane = 0; lane < lanes_.size(); ++lane)
        if (lanes >> lane & 1) lanes_[lane].values[instruction.result] = {lane == static_cast<uint32_t>(std::countr_zero(lanes))};
      return true;
    case Op::OpGroupNonUniformAny:
      reduce([](uint32_t a, uint32_t b) { return a | b; });
      return true;
    case Op::OpGroupNonUniformIAdd:
      reduce([](uint32_t a, uint32_t b) { return a + b; });
      return true;
    case Op::OpGroupNonUniformFAdd:
      reduce([&](uint32_t a, uint32_t b) { return std::bit_cast<uint32_t>(number(a) + number(b)); });
      return true;
    case Op::OpGroupNonUniformFMax:
      reduce([&](uint32_t a, uint32_t b) { return number(a) < number(b) ? b : a; });
      return true;
    case Op::OpGroupNonUniformShuffle:
      shuffle([](uint32_t, uint32_t wanted) { return wanted; });
      return true;
    case Op::OpGroupNonUniformShuffleXor:
      shuffle([](uint32_t lane, uint32_t mask) { return lane ^ mask; });
      return true;
    default:
      return false;
  }
}

}  // namespace rill::lanes
