// A compute shader as SPIR-V, decoded for lanes that are run one instruction at a time (subgroup.hpp): one function, with all calls
// inlined, as spirv-opt leaves it.
#pragma once
#define SPV_ENABLE_UTILITY_CODE  // spv::HasResultAndType
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <spirv/unified1/spirv.hpp11>
#include <utility>
#include <vector>

namespace rill::lanes {

/// A scalar or vector, or a pointer: the variable's id and an offset in bytes.
using Value = std::array<uint32_t, 4>;

struct Type {
  spv::Op op = spv::Op::OpTypeVoid;
  uint32_t element = 0;           ///< the type's id, of vectors, arrays and pointers
  uint32_t components = 1;        ///< of vectors
  uint32_t stride = 0;            ///< bytes, of arrays
  std::vector<uint32_t> members;  ///< of structures: ids of types
  std::map<uint32_t, uint32_t> offsets;
};

struct Instruction {
  spv::Op op = spv::Op::OpNop;
  uint32_t type = 0, result = 0;  ///< ids; 0: none
  std::vector<uint32_t> operands;
};

struct Variable {
  enum class Kind { Buffer, Push, Shared, Input, Local } kind = Kind::Buffer;  ///< Local: a lane's own
  uint32_t binding = 0;                                                        ///< of buffers
  spv::BuiltIn builtIn = spv::BuiltIn::Max;                                    ///< of inputs
  uint32_t type = 0;                                                           ///< what it holds
};

/// A shader of one function: calls are inlined.
struct Program {
  /// Specialization constants by their constant_id. Throws std::runtime_error for what it cannot run.
  Program(std::span<const uint32_t> words, const std::map<uint32_t, uint32_t>& specialization);

  uint32_t bound = 0;
  std::map<uint32_t, Type> types;
  std::map<uint32_t, Value> constants;
  std::vector<uint32_t> typeOf;  ///< of constants and results, by their ids
  std::map<uint32_t, Variable> variables;
  std::map<uint32_t, std::vector<Instruction>> blocks;  ///< by their labels
  uint32_t entry = 0;                                   ///< the first block's label

 private:
  void decorate(const Instruction& instruction);
  void declare(const Instruction& instruction, const std::map<uint32_t, uint32_t>& specialization);
  std::optional<uint32_t> decoration(uint32_t id, spv::Decoration decoration) const;  ///< its operand
  std::map<std::pair<uint32_t, spv::Decoration>, uint32_t> decorations_;
  std::map<uint32_t, std::map<uint32_t, uint32_t>> offsets_;
};

/// The number of components of a scalar or vector.
uint32_t componentsOf(const Program& program, uint32_t type);

/// The result of an instruction without side effects, from its operands' values; false if there is no such instruction.
bool evaluate(const Program& program, const Instruction& instruction, std::span<const Value* const> operands, Value& result);

}  // namespace rill::lanes
