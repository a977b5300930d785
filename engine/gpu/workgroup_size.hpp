#pragma once
// The size of a compute shader's workgroups, read from its SPIR-V.
#include <cstdint>
#include <span>

namespace rill {

struct WorkgroupSize {
  uint32_t x = 1, y = 1, z = 1;
  uint64_t invocations() const { return uint64_t{x} * y * z; }
};

/// Whether a module has an entry point of a compute shader.
bool isCompute(std::span<const uint32_t> spirv);

/// The size with these specialization constants, by their ids from 0; others keep their defaults. 1 x 1 x 1 for words that give no size.
WorkgroupSize workgroupSize(std::span<const uint32_t> spirv, std::span<const uint32_t> constants = {});

}  // namespace rill
