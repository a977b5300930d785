#pragma once
// Makes the pipelines of a module, whose bindings are storage buffers and arrays that are read, and keeps the first error.
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

  /// Of a shader whose bindings are all storage buffers. Null after an error: result() tells which.
  const ComputePipeline* make(std::string_view shader, uint32_t bindings, std::initializer_list<uint32_t> constants = {}) {
    constexpr uint32_t kMaxEntries = 8;
    static constexpr std::array<BindingKind, kMaxEntries> kStorage{};
    static_assert(BindingKind{} == BindingKind::Storage);
    assert(bindings <= kMaxEntries);
    return make(shader, std::span(kStorage).first(bindings), constants);
  }

  /// Of a shader that reads arrays (shaders/shared/arrays.glsl), with the bindings of its variant with texels; without them, all of those
  /// are storage buffers.
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
