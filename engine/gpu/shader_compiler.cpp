// Compiles GLSL to SPIR-V at run time, for ShaderReload; built only with the option RILL_SHADER_RELOAD.
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "gpu/shader_reload.hpp"

namespace rill {
namespace {

bool readFile(const std::filesystem::path& path, std::string& text) {
  std::ifstream in(path, std::ios::binary);
  text.assign(std::istreambuf_iterator<char>(in), {});
  return bool(in);
}

/// Resolves includes relative to the shader root, as in the build.
class Includer : public glslang::TShader::Includer {
 public:
  explicit Includer(const std::filesystem::path& folder) : folder_(folder) {}
  IncludeResult* includeLocal(const char* name, const char*, size_t) override {
    auto* text = new std::string;
    if (readFile(folder_ / name, *text)) return new IncludeResult(name, text->data(), text->size(), text);
    delete text;
    return nullptr;
  }
  IncludeResult* includeSystem(const char* name, const char* from, size_t depth) override { return includeLocal(name, from, depth); }
  void releaseInclude(IncludeResult* result) override {
    if (!result) return;
    delete static_cast<std::string*>(result->userData);
    delete result;
  }

 private:
  const std::filesystem::path& folder_;
};

/// Converts "TEXEL WIDTH=4" to #define lines.
std::string preamble(std::string_view defines) {
  std::string out = "#extension GL_GOOGLE_include_directive : require\n";
  while (!defines.empty()) {
    const size_t end = std::min(defines.find(' '), defines.size());
    std::string word(defines.substr(0, end));
    defines.remove_prefix(std::min(end + 1, defines.size()));
    if (word.empty()) continue;
    const size_t equals = word.find('=');
    if (equals == std::string::npos)
      word += " 1";
    else
      word[equals] = ' ';
    out += "#define " + word + "\n";
  }
  return out;
}

}  // namespace

Expected<std::vector<uint32_t>> compileShader(const std::filesystem::path& folder, std::string_view source, std::string_view defines) {
  static const bool initialized = glslang::InitializeProcess();
  if (!initialized) return Error{ErrorKind::Shader, "glslang initialization failed"};
  const std::string name(source), definitions = preamble(defines);
  std::string text;
  if (!readFile(folder / source, text)) return Error{ErrorKind::Shader, "cannot read " + (folder / source).string()};
  const EShLanguage stage = name.ends_with(".vert") ? EShLangVertex : name.ends_with(".frag") ? EShLangFragment : EShLangCompute;
  const char* string = text.c_str();
  const char* label = name.c_str();
  glslang::TShader shader(stage);
  shader.setStringsWithLengthsAndNames(&string, nullptr, &label, 1);
  shader.setPreamble(definitions.c_str());
  shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
  constexpr auto rules = EShMessages(EShMsgSpvRules | EShMsgVulkanRules);
  Includer includer(folder);
  if (!shader.parse(GetDefaultResources(), 100, false, rules, includer)) return Error{ErrorKind::Shader, shader.getInfoLog()};
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(rules)) return Error{ErrorKind::Shader, program.getInfoLog()};
  std::vector<uint32_t> words;
  glslang::GlslangToSpv(*program.getIntermediate(stage), words);
  return words;
}

}  // namespace rill
