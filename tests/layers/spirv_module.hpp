// A SPIR-V module as a list of instructions that can be changed: just what the rewrites need. SPIR-V 1.6, section 2.3: the physical layout.
#pragma once
#define SPV_ENABLE_UTILITY_CODE  // spv::HasResultAndType
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <spirv/unified1/spirv.hpp11>
#include <vector>

namespace rill::layer {

struct Instruction {
  spv::Op op = spv::Op::OpNop;
  std::vector<uint32_t> operands = {};  ///< all words but the first
};

/// A numeric type: scalars and vectors of 32 bits.
struct NumericType {
  enum class Kind { Float, Uint, Int, Bool, Other } kind = Kind::Other;
  uint32_t components = 1;
};

class SpirvModule {
 public:
  explicit SpirvModule(std::span<const uint32_t> words);
  std::vector<uint32_t> words() const;

  /// Replaces each instruction of the functions by those that `rewrite` returns.
  void rewriteFunctions(const std::function<std::vector<Instruction>(const Instruction&)>& rewrite);
  std::vector<Instruction>& functions() { return functions_; }
  /// The position of the result's id among the operands: 1 after a type, 0 without, -1 if there is no result.
  static int resultIndex(spv::Op op);

  uint32_t newId() { return bound_++; }
  NumericType typeOf(uint32_t typeId) const;
  /// The type of a value, OpTypeVoid's kind of nothing (Other) if it is not known.
  NumericType typeOfValue(uint32_t id) const;

  /// Ids of types and constants, which are added where the module lacks them.
  uint32_t type(NumericType::Kind kind, uint32_t components);
  uint32_t constant(NumericType::Kind kind, uint32_t bits, uint32_t components);
  /// The input variable with this built-in, which is added to the entry point if the module lacks it; it holds `components` uints.
  uint32_t builtIn(spv::BuiltIn builtIn, uint32_t components);
  /// The variable's id if the module has it, else 0.
  uint32_t findBuiltIn(spv::BuiltIn builtIn) const;
  void requireCapability(spv::Capability capability);

  /// The bits of a scalar float constant, also of a vector with equal components; false if the id is something else.
  bool constantBits(uint32_t id, uint32_t& bits) const;
  bool isDecorated(uint32_t id, spv::Decoration decoration) const;
  bool isCompute() const;
  uint32_t workgroupSize(uint32_t axis) const;

 private:
  uint32_t addGlobal(spv::Op op, std::vector<uint32_t> operands);

  std::vector<uint32_t> header_;
  uint32_t bound_ = 0;
  std::vector<Instruction> globals_, functions_;
  std::map<uint32_t, uint32_t> valueTypes_;  ///< of results, by id
};

}  // namespace rill::layer
