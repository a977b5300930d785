#include "lanes/subgroup.hpp"

#include <bit>
#include <stdexcept>
#include <utility>

namespace rill::lanes {

using spv::Op;

namespace {

uint64_t allOf(uint32_t size) { return size == 64 ? ~0ull : (1ull << size) - 1; }

template <class Each>
void forEach(uint64_t lanes, const Each& each) {
  for (; lanes; lanes &= lanes - 1) each(static_cast<uint32_t>(std::countr_zero(lanes)));
}

}  // namespace

Subgroup::Subgroup(const Program& program, Memory& memory, const Place& place, Rules rules, uint32_t seed)
    : program_(program), memory_(memory), place_(place), rules_(rules), random_(seed), lanes_(place.size) {
  for (Lane& lane : lanes_) {
    lane.values.resize(program.bound);
    for (const auto& [id, value] : program.constants) lane.values[id] = value;
    for (const auto& [id, variable] : program.variables) lane.values[id] = {id, 0};
  }
}

void Subgroup::run() {
  ready_ = {{allOf(place_.size), program_.entry}};
  while (!ready_.empty() && strayShuffles_ == 0) {
    std::swap(ready_[random_() % ready_.size()], ready_.back());
    const Tangle tangle = ready_.back();
    ready_.pop_back();
    runBlock(tangle);
  }
}

void Subgroup::runBlock(const Tangle& tangle) {
  phis(tangle);
  for (const Instruction& instruction : program_.blocks.at(tangle.block)) {
    switch (instruction.op) {
      case Op::OpPhi:
        break;
      case Op::OpSelectionMerge:
        open(tangle, instruction.operands[0], 0, false);
        break;
      case Op::OpLoopMerge:
        open(tangle, instruction.operands[0], instruction.operands[1], true);
        break;
      case Op::OpBranch:
      case Op::OpBranchConditional:
      case Op::OpSwitch:
        return branch(tangle, instruction);
      case Op::OpReturn:
        return forEach(tangle.lanes, [&](uint32_t lane) { leave(lane, 0); });
      default:
        execute(instruction, tangle.lanes);
        if (strayShuffles_ != 0) return;
    }
  }
  throw std::runtime_error("a block without an end");
}

void Subgroup::open(const Tangle& tangle, uint32_t merge, uint32_t continueTarget, bool isLoop) {
  const auto add = [&](uint32_t to, bool isGuaranteed, bool loop) {
    const auto construct = std::make_shared<Construct>(Construct{to, tangle.block, loop, isGuaranteed, tangle.lanes, 0});
    forEach(tangle.lanes, [&](uint32_t lane) { lanes_[lane].constructs.push_back(construct); });
  };
  const bool isUniform = tangle.lanes == allOf(place_.size);
  const auto& held = lanes_[static_cast<size_t>(std::countr_zero(tangle.lanes))].constructs;
  const bool isNextTurn = isLoop && !held.empty() && held.back()->isLoop && held.back()->header == tangle.block;
  if (!isNextTurn) add(merge, rules_ == Rules::Maximal || isUniform, isLoop);
  if (isLoop) add(continueTarget, rules_ == Rules::Maximal, false);
}

// Takes a lane out of all constructs but the outermost `kept`; those that waited for it go on.
void Subgroup::leave(uint32_t lane, size_t kept) {
  auto& held = lanes_[lane].constructs;
  while (held.size() > kept) {
    const std::shared_ptr<Construct> construct = held.back();
    held.pop_back();
    construct->inside &= ~(1ull << lane);
    if (construct->isGuaranteed && !construct->inside && construct->arrived) enter(std::exchange(construct->arrived, 0), construct->merge);
  }
}

void Subgroup::enter(uint64_t lanes, uint32_t block) {
  uint64_t going = lanes, again = 0;
  forEach(lanes, [&](uint32_t lane) {
    auto& held = lanes_[lane].constructs;
    size_t k = held.size();
    while (k > 0 && held[k - 1]->merge != block) --k;
    if (k == 0) return;
    const std::shared_ptr<Construct> construct = held[k - 1];
    going &= ~(1ull << lane);
    (construct->isGuaranteed ? construct->arrived : again) |= 1ull << lane;
    leave(lane, k - 1);  // the construct that it arrives at, too
  });
  if (going) ready_.push_back({going, block});
  if (again) enter(again, block);
}

void Subgroup::branch(const Tangle& tangle, const Instruction& instruction) {
  const auto& operands = instruction.operands;
  std::map<uint32_t, uint64_t> targets;
  forEach(tangle.lanes, [&](uint32_t lane) {
    uint32_t target = operands[0];
    if (instruction.op == Op::OpBranchConditional) target = operands[lanes_[lane].values[operands[0]][0] ? 1 : 2];
    if (instruction.op == Op::OpSwitch) {
      target = operands[1];
      for (size_t k = 2; k + 1 < operands.size(); k += 2)
        if (operands[k] == lanes_[lane].values[operands[0]][0]) target = operands[k + 1];
    }
    targets[target] |= 1ull << lane;
    lanes_[lane].cameFrom = tangle.block;
  });
  const bool isUniform = targets.size() == 1 && tangle.lanes == allOf(place_.size);
  for (const auto& [target, lanes] : targets) {
    if (rules_ == Rules::Maximal || isUniform) {
      enter(lanes, target);
      continue;
    }
    const uint64_t chosen = (static_cast<uint64_t>(random_()) << 32 | random_()) & lanes;
    if (chosen) enter(chosen, target);
    if (chosen != lanes) enter(lanes & ~chosen, target);
  }
}

}  // namespace rill::lanes
