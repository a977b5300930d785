#pragma once
// Which of its bindings a compute shader reads and writes once its specialization constants have values: code that they switch off does not
// count. Reflected from the SPIR-V that the pipeline was made of.
#include <cstdint>
#include <span>
#include <vector>

#include "rill/expected.hpp"

namespace rill::bench {

struct BindingAccess {
  bool reads = false, writes = false;  ///< an atomic operation does both
  bool readsInLoop = false, writesInLoop = false;
  uint32_t readBytes = 0, writeBytes = 0;  ///< of the widest load and store; 0: none
};

struct ShaderAccesses {
  std::vector<BindingAccess> bindings;  ///< element k is binding k; those that are never used may be missing at the end
  uint32_t groupSize = 1;               ///< invocations a workgroup
};

/// `constants`: the value of each constant_id, from 0. Shader if the SPIR-V is invalid.
Expected<ShaderAccesses> shaderAccesses(std::span<const uint32_t> spirv, std::span<const uint32_t> constants);

}  // namespace rill::bench
