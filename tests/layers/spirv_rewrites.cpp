// The rewrites that change what lanes and workgroups do: shuffles, order, blocks of loops. spirv_float_rewrites.cpp: arithmetic.
#include "spirv_rewrites.hpp"

#include <map>

#include "spirv_changes.hpp"

namespace rill::layer {
namespace {

using Kind = NumericType::Kind;
using spv::Op;

constexpr uint32_t kQuietNan = 0x7fc00bad;

}  // namespace

std::vector<uint32_t> poisonShuffles(std::span<const uint32_t> words) {
  SpirvModule module(words);
  module.rewriteFunctions([&](const Instruction& instruction) -> std::vector<Instruction> {
    const bool byXor = instruction.op == Op::OpGroupNonUniformShuffleXor;
    if (!byXor && instruction.op != Op::OpGroupNonUniformShuffle) return {instruction};
    const NumericType type = module.typeOf(instruction.operands[0]);
    const uint32_t uints = module.type(Kind::Uint, 1), masks = module.type(Kind::Uint, 4), bools = module.type(Kind::Bool, 1);
    const uint32_t scope = instruction.operands[2], yes = module.newId(), zero = module.constant(Kind::Uint, 0, 1);
    const uint32_t lane = byXor ? module.builtIn(spv::BuiltIn::SubgroupLocalInvocationId, 1) : 0;
    module.requireCapability(spv::Capability::GroupNonUniformBallot);
    const uint32_t poison = module.constant(type.kind, type.kind == Kind::Float ? kQuietNan : 0xdeadbeefu, type.components);
    return thenChanged(module, instruction, [&](std::vector<Instruction>& out, uint32_t from, uint32_t to) {
      uint32_t source = instruction.operands[4];
      out.push_back({Op::OpIEqual, {bools, yes, zero, zero}});
      if (byXor) {
        const uint32_t own = module.newId(), other = module.newId();
        out.push_back({Op::OpLoad, {uints, own, lane}});
        out.push_back({Op::OpBitwiseXor, {uints, other, own, source}});
        source = other;
      }
      const uint32_t ballot = module.newId(), active = module.newId();
      out.push_back({Op::OpGroupNonUniformBallot, {masks, ballot, scope, yes}});
      out.push_back({Op::OpGroupNonUniformBallotBitExtract, {bools, active, scope, ballot, source}});
      uint32_t choice = active;
      if (type.components > 1) {
        choice = module.newId();
        std::vector<uint32_t> parts{module.type(Kind::Bool, type.components), choice};
        parts.insert(parts.end(), type.components, active);
        out.push_back({Op::OpCompositeConstruct, std::move(parts)});
      }
      out.push_back({Op::OpSelect, {instruction.operands[0], to, choice, from, poison}});
    });
  });
  return module.words();
}

std::vector<uint32_t> permuteWorkgroups(std::span<const uint32_t> words, uint32_t seed) {
  SpirvModule module(words);
  if (!module.isCompute()) return module.words();
  const uint32_t group = module.findBuiltIn(spv::BuiltIn::WorkgroupId), global = module.findBuiltIn(spv::BuiltIn::GlobalInvocationId);
  if (!group && !global) return module.words();
  const uint32_t counts = module.builtIn(spv::BuiltIn::NumWorkgroups, 3), groups = module.builtIn(spv::BuiltIn::WorkgroupId, 3);
  const uint32_t locals = module.builtIn(spv::BuiltIn::LocalInvocationId, 3);
  // A prime above all counts of groups has no factor in common with any, so that g * prime % n is a permutation; reduced modulo n first,
  // the product of two numbers below 65,536 fits into 32 bits.
  constexpr uint32_t kPrimes[] = {65537, 65539, 65543, 65551, 65557, 65563, 65579, 65581};
  const uint32_t prime = module.constant(Kind::Uint, kPrimes[seed % 8], 1), shift = module.constant(Kind::Uint, mixed(seed) % 65536, 1);
  const uint32_t uints = module.type(Kind::Uint, 1), vectors = module.type(Kind::Uint, 3);
  const uint32_t size = module.constant(Kind::Uint, module.workgroupSize(0), 1);
  std::map<uint32_t, uint32_t> chains;  // pointers to the first component of either variable
  module.rewriteFunctions([&](const Instruction& instruction) -> std::vector<Instruction> {
    const auto& operands = instruction.operands;
    const auto isEither = [&](uint32_t id) { return id != 0 && (id == group || id == global); };
    if ((instruction.op == Op::OpAccessChain || instruction.op == Op::OpInBoundsAccessChain) && isEither(operands[2])) {
      if (uint32_t axis = 1; module.constantBits(operands[3], axis) && axis == 0) chains[operands[1]] = operands[2];
      return {instruction};
    }
    if (instruction.op != Op::OpLoad) return {instruction};
    const bool whole = isEither(operands[2]);
    if (!whole && !chains.contains(operands[2])) return {instruction};
    std::vector<Instruction> out;
    const auto add = [&](Op op, uint32_t type, std::vector<uint32_t> rest) {
      const uint32_t id = module.newId();
      rest.insert(rest.begin(), {type, id});
      out.push_back({op, std::move(rest)});
      return id;
    };
    const auto first = [&](uint32_t variable) { return add(Op::OpCompositeExtract, uints, {add(Op::OpLoad, vectors, {variable}), 0}); };
    const uint32_t n = first(counts), g = first(groups);
    const uint32_t product = add(Op::OpIMul, uints, {g, add(Op::OpUMod, uints, {prime, n})});
    const uint32_t moved = add(Op::OpIAdd, uints, {add(Op::OpUMod, uints, {product, n}), shift});
    uint32_t place = add(Op::OpUMod, uints, {moved, n});
    if ((whole ? operands[2] : chains[operands[2]]) == global)
      place = add(Op::OpIAdd, uints, {add(Op::OpIMul, uints, {place, size}), first(locals)});
    if (whole)
      out.push_back({Op::OpCompositeInsert, {operands[0], operands[1], place, add(Op::OpLoad, vectors, {operands[2]}), 0}});
    else
      out.push_back({Op::OpCopyObject, {operands[0], operands[1], place}});
    return out;
  });
  return module.words();
}

std::vector<uint32_t> splitLoopHeaders(std::span<const uint32_t> words) {
  SpirvModule module(words);
  std::map<uint32_t, uint32_t> second;  // of each split block, by its label
  std::vector<Instruction> out;
  size_t label = 0, body = 0;  // where the block starts in `out`, and what follows its phis
  for (const Instruction& instruction : module.functions()) {
    if (instruction.op == Op::OpLabel) label = out.size();
    if (instruction.op == Op::OpLabel || instruction.op == Op::OpPhi) body = out.size() + 1;
    if (instruction.op != Op::OpLoopMerge) {
      out.push_back(instruction);
      continue;
    }
    const uint32_t next = second[out[label].operands[0]] = module.newId();
    out.insert(out.begin() + static_cast<std::ptrdiff_t>(body), {instruction, {Op::OpBranch, {next}}, {Op::OpLabel, {next}}});
  }
  for (Instruction& instruction : out) {
    auto& operands = instruction.operands;
    const auto moved = [&](uint32_t& block) { block = second.contains(block) ? second[block] : block; };
    for (size_t k = 3; instruction.op == Op::OpPhi && k < operands.size(); k += 2) moved(operands[k]);
    if (instruction.op == Op::OpLoopMerge && second.contains(operands[1])) moved(operands[1]);  // of a loop that is one block
  }
  module.functions() = std::move(out);
  return module.words();
}

}  // namespace rill::layer
