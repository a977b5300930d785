// Runs a shader on the lanes of a subgroup, each with a program counter of its own. Lanes come together where the chosen rules guarantee it
// and nowhere else; of what is ready, chance decides what runs next. This is what no CPU driver does, and GPUs may.
#pragma once
#include <memory>
#include <random>

#include "lanes/spirv_program.hpp"

namespace rill::lanes {

enum class Rules {
  /// Lanes come together at the merge block of a construct that all lanes of the subgroup entered together, and nowhere else:
  /// SPV_KHR_subgroup_uniform_control_flow, and core SPIR-V where the workgroup is one subgroup. Lanes that took different paths scatter.
  SubgroupUniform,
  /// Lanes come together at the merge block and the continue target of a construct that they entered together:
  /// SPV_KHR_maximal_reconvergence.
  Maximal,
};

/// The memory that a dispatch sees.
struct Memory {
  std::map<uint32_t, std::vector<uint32_t>> buffers;  ///< words by binding
  std::vector<uint32_t> push;
};

struct Place {
  uint32_t size = 0;                 ///< lanes of the subgroup, at most 64
  uint32_t subgroup = 0, group = 0;  ///< of the workgroup; of a dispatch in one dimension
  uint32_t groups = 1;
};

class Subgroup {
 public:
  Subgroup(const Program& program, Memory& memory, const Place& place, Rules rules, uint32_t seed);
  /// Ends at the first stray shuffle. Throws std::runtime_error at an access out of bounds or an instruction that it does not know.
  void run();
  /// How many lanes read another by a shuffle that was not at the same instruction: what that gives is undefined.
  uint64_t strayShuffles() const { return strayShuffles_; }

 private:
  struct Construct {  // that lanes have entered: a selection, a loop, or one turn of a loop
    uint32_t merge = 0, header = 0;
    bool isLoop = false, isGuaranteed = false;
    uint64_t inside = 0, arrived = 0;  // a bit a lane
  };
  struct Lane {
    std::vector<Value> values;
    std::map<uint32_t, std::vector<uint32_t>> locals;
    uint32_t cameFrom = 0;
    std::vector<std::shared_ptr<Construct>> constructs;
  };
  struct Tangle {  // lanes at the same instruction
    uint64_t lanes = 0;
    uint32_t block = 0;
  };

  // Where lanes go (subgroup.cpp).
  void open(const Tangle& tangle, uint32_t merge, uint32_t continueTarget, bool isLoop);
  void leave(uint32_t lane, size_t kept);
  void enter(uint64_t lanes, uint32_t block);
  void branch(const Tangle& tangle, const Instruction& instruction);
  void runBlock(const Tangle& tangle);

  // What they do (lane_instructions.cpp).
  void phis(const Tangle& tangle);
  void execute(const Instruction& instruction, uint64_t lanes);
  void executeLane(const Instruction& instruction, uint32_t lane);
  bool executeTogether(const Instruction& instruction, uint64_t lanes);
  Value pointer(const Instruction& instruction, const Lane& lane) const;
  uint32_t& word(const Value& pointer, Lane& lane, uint32_t component);
  uint32_t input(spv::BuiltIn builtIn, uint32_t lane, uint32_t component) const;

  const Program& program_;
  Memory& memory_;
  Place place_;
  Rules rules_;
  std::mt19937 random_;
  std::vector<Lane> lanes_;
  std::vector<Tangle> ready_;
  uint64_t strayShuffles_ = 0;
};

}  // namespace rill::lanes
