#pragma once
// Makes the pipelines of a module, whose bindings are all storage buffers, and keeps the first error.
#include <array>
#include <cassert>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "gpu/resources.hpp"

namespace rill {

class StoragePipelines {
 public:
  StoragePipelines(Device& device, uint32_t pushConstantBytes) : device_(device), pushConstantBytes_(pushConstantBytes) {}

  /// Null after an error: result() tells which.
  const ComputePipeline* make(std::string_view shader, uint32_t bindings, std::initializer_list<uint32_t> constants = {}) {
    constexpr uint32_t kMost = 8;
    static constexpr std::array<BindingKind, kMost> kStorage{};
    static_assert(BindingKind{} == BindingKind::Storage);
    assert(bindings <= kMost);
    if (error_) return nullptr;
    auto made = computePipeline(device_, {.shader = shader,
                                          .bindings = std::span(kStorage).first(bindings),
                                          .pushConstantBytes = pushConstantBytes_,
                                          .constants = {constants.begin(), constants.size()}});
    if (made) return *made;
    error_ = made.error();
    return nullptr;
  }

  Expected<void> result() const { return error_ ? Expected<void>(*error_) : Expected<void>(); }

 private:
  Device& device_;
  uint32_t pushConstantBytes_;
  std::optional<Error> error_;
};

}  // namespace rill
