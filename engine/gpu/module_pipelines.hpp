#pragma once
// Creates the pipelines of a module and keeps the first error.
#include <initializer_list>
#include <optional>
#include <string_view>

#include "gpu/shader_constants.hpp"

namespace rill {

class ModulePipelines {
 public:
  explicit ModulePipelines(Device& device) : device_(device) {}

  /// Null after an error; see result(). `texels`: the variant that reads arrays through texel buffers, if the shader has one.
  const ComputePipeline* make(std::string_view shader, bool texels = false, std::initializer_list<NamedConstant> constants = {},
                              SubgroupNeed subgroups = {}) {
    if (error_) return nullptr;
    auto made = shaderPipeline(device_, texelVariant(device_, shader, texels), std::span(constants.begin(), constants.size()), subgroups);
    if (made) return *made;
    error_ = made.error();
    return nullptr;
  }

  Expected<void> result() const { return error_ ? Expected<void>(*error_) : Expected<void>(); }

 private:
  Device& device_;
  std::optional<Error> error_;
};

}  // namespace rill
