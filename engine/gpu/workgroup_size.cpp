#include "gpu/workgroup_size.hpp"

#include <array>
#include <unordered_map>

#include "gpu/spirv.hpp"

namespace rill {
namespace {

using namespace spirv;

constexpr uint32_t kGlCompute = 5, kLocalSize = 17, kLocalSizeId = 38, kSpecId = 1, kBuiltIn = 11, kWorkgroupSize = 25;

}  // namespace

bool isCompute(std::span<const uint32_t> spirv) {
  bool found = false;
  forEachDeclaration(spirv, [&](uint32_t op, std::span<const uint32_t> words) {
    found |= op == kOpEntryPoint && words.size() > 1 && words[1] == kGlCompute;
  });
  return found;
}

WorkgroupSize workgroupSize(std::span<const uint32_t> spirv, std::span<const uint32_t> constants) {
  std::array<uint32_t, 3> size = {1, 1, 1}, ids{};
  std::unordered_map<uint32_t, uint32_t> values, specIds;
  uint32_t builtIn = 0;  // the constant that overrides the execution mode
  forEachDeclaration(spirv, [&](uint32_t op, std::span<const uint32_t> w) {
    if (op == kOpExecutionMode && w.size() >= 6 && w[2] == kLocalSize) size = {w[3], w[4], w[5]};
    if (op == kOpExecutionModeId && w.size() >= 6 && w[2] == kLocalSizeId) ids = {w[3], w[4], w[5]};
    if (op == kOpDecorate && w.size() >= 4 && w[2] == kSpecId) specIds[w[1]] = w[3];
    if (op == kOpDecorate && w.size() >= 4 && w[2] == kBuiltIn && w[3] == kWorkgroupSize) builtIn = w[1];
    if ((op == kOpConstant || op == kOpSpecConstant) && w.size() >= 4) {
      const auto spec = specIds.find(w[2]);
      values[w[2]] = spec != specIds.end() && spec->second < constants.size() ? constants[spec->second] : w[3];
    }
    if ((op == kOpConstantComposite || op == kOpSpecConstantComposite) && w.size() >= 6 && builtIn != 0 && w[2] == builtIn)
      ids = {w[3], w[4], w[5]};
  });
  for (size_t k = 0; k < ids.size(); ++k)
    if (ids[k] != 0) size[k] = values[ids[k]];
  return {size[0], size[1], size[2]};
}

}  // namespace rill
