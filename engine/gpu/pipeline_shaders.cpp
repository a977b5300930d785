// Shaders of pipelines: SPIR-V, what they declare, modules, constants.
#include <algorithm>

#include "gpu/device_impl.hpp"
#include "gpu/pipeline.hpp"
#include "gpu/shader_reload.hpp"
#include "gpu/vulkan_error.hpp"

namespace rill {

const EmbeddedShader* embeddedShader(const DeviceImpl& device, std::string_view name) {
  for (const auto& table : device.shaders.tables())
    if (const EmbeddedShader* shader = findShader(table, name)) return shader;
  return nullptr;
}

std::span<const uint32_t> embeddedSpirv(const DeviceImpl& device, std::string_view name) {
  if (device.reload)
    if (const auto words = device.reload->words(name); !words.empty()) return words;
  const EmbeddedShader* shader = embeddedShader(device, name);
  return shader ? shader->words : std::span<const uint32_t>();
}

Expected<Reflection> reflect(const DeviceImpl& device, std::initializer_list<std::string_view> shaders) {
  Reflection all;
  for (std::string_view name : shaders) {
    if (name.empty()) continue;
    const EmbeddedShader* shader = embeddedShader(device, name);
    if (!shader) return shaderError(name, "no SPIR-V given, and no embedded shader has this name");
    all.pushConstantBytes = std::max(all.pushConstantBytes, shader->pushConstantBytes);
    all.bindings.resize(std::max(all.bindings.size(), shader->bindings.size()));
    for (size_t k = 0; k < shader->bindings.size(); ++k) {
      const ShaderBinding& own = shader->bindings[k];
      ShaderBinding& merged = all.bindings[k];
      if (own.name.empty()) continue;
      if (!merged.name.empty() && (merged.name != own.name || merged.kind != own.kind))
        return shaderError(
            name, "binding " + std::to_string(k) + " is " + std::string(own.name) + "; another stage declares " + std::string(merged.name));
      merged = {own.name, own.kind, own.writes || merged.writes};
    }
  }
  for (size_t k = 0; k < all.bindings.size(); ++k) {
    if (all.bindings[k].name.empty())
      return shaderError(*shaders.begin(), "binding " + std::to_string(k) + " is not used; expected numbers without a gap");
    all.kinds.push_back(all.bindings[k].kind);
  }
  return all;
}

Error shaderError(std::string_view shader, std::string what) {
  return {ErrorKind::Shader, "shader '" + std::string(shader) + "': " + std::move(what)};
}

Expected<std::span<const uint32_t>> resolveSpirv(const DeviceImpl& device, std::string_view shader, std::span<const uint32_t> spirv) {
  if (spirv.empty()) {
    const auto words = embeddedSpirv(device, shader);
    if (words.empty()) return shaderError(shader, "no SPIR-V given, and no embedded shader has this name");
    return words;
  }
  constexpr uint32_t magic = 0x07230203, swapped = 0x03022307;
  constexpr size_t header = 5;  // words
  if (spirv[0] == swapped) return shaderError(shader, "the SPIR-V has the wrong byte order; expected that of this machine");
  if (spirv[0] != magic || spirv.size() < header)
    return shaderError(shader, "invalid SPIR-V; expected the magic number 0x07230203 and a header of five words");
  return spirv;
}

Error pipelineError(VkResult result, std::string_view shader) {
  Error error = vulkanError(result, "compiling the pipeline of shader '" + std::string(shader) + "'");
  if (error.kind == ErrorKind::Failed) error.kind = ErrorKind::Shader;
  return error;
}

Expected<ShaderModule> ShaderModule::make(DeviceImpl& device, std::string_view shader, std::span<const uint32_t> words) {
  VkShaderModuleCreateInfo create{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, words.size_bytes(), words.data()};
  VkShaderModule module = VK_NULL_HANDLE;
  if (VkResult r = device.vk.CreateShaderModule(device.handle, &create, device.callbacks, &module); r != VK_SUCCESS) {
    Error error = vulkanError(r, "creating the module of shader '" + std::string(shader) + "'");
    if (error.kind == ErrorKind::Failed) error.kind = ErrorKind::Shader;
    return error;
  }
  return ShaderModule(device, module);
}

ShaderModule::~ShaderModule() {
  if (handle_) device_.vk.DestroyShaderModule(device_.handle, handle_, device_.callbacks);
}

Constants::Constants(std::span<const uint32_t> values)
    : info_{uint32_t(values.size()), entries_.data(), values.size_bytes(), values.data()} {
  for (uint32_t i = 0; i < values.size(); ++i) entries_[i] = {i, i * 4, 4};
}

}  // namespace rill
