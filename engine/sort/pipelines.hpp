#pragma once
// Creates the pipelines of a module and keeps the first error.
#include <array>
#include <cassert>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "gpu/resources.hpp"

namespace rill {

class ModulePipelines {
 public:
  ModulePipelines(Device& device, uint32_t pushConstantBytes) : device_(device), pushConstantBytes_(pushConstantBytes) {}

  /// For a shader whose bindings are all storage buffers. Null after an error; see result().
  const ComputePipeline* make(std::string_view shader, uint32_t bindings, std::initializer_list<uint32_t> constants = {}) {
    constexpr uint32_t kMaxBindings = 8;
    static constexpr std::array<BindingKind, kMaxBindings> kStorage{};
    static_assert(BindingKind{} == BindingKind::Storage);
    assert(bindings <= kMaxBindings);
    return make(shader, std::span(kStorage).first(bindings), constants);
  }

  /// For a shader that uses shaders/shared/arrays.glsl. `bindings` are those of the texel variant; without
  /// `texels` all of them are storage buffers.
  const ComputePipeline* makeReading(std::string shader, bool texels, std::initializer_list<BindingKind> bindings,
                                     std::initializer_list<uint32_t> constants = {}) {
    if (texels) return make(shader + "_texel", std::span(bindings.begin(), bindings.size()), constants);
    return make(shader, static_cast<uint32_t>(bindings.size()), constants);
  }

  Expected<void> result() const { return error_ ? Expected<void>(*error_) : Expected<void>(); }

 private:
  const ComputePipeline* make(std::string_view shader, std::span<const BindingKind> bindings, std::initializer_list<uint32_t> constants) {
    if (error_) return nullptr;
    auto made = computePipeline(device_, {.shader = shader,
                                          .bindings = bindings,
                                          .pushConstantBytes = pushConstantBytes_,
                                          .constants = {constants.begin(), constants.size()}});
    if (made) return *made;
    error_ = made.error();
    return nullptr;
  }

  Device& device_;
  uint32_t pushConstantBytes_;
  std::optional<Error> error_;
};

}  // namespace rill
