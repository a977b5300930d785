# GLSL -> SPIR-V (Vulkan 1.3), checked by spirv-val, embedded as arrays in the library.
#   rill_shader(fluid/density.comp)                                         becomes "fluid/density"
#   rill_shader(fluid/density.comp AS fluid/density_texel DEFINES LIST_TEXEL) becomes "fluid/density_texel"
# Every header under shaders/ is a dependency of every shader: they are few, and a stale one is worse than a rebuild.
find_program(RILL_GLSLANG glslangValidator REQUIRED)
find_program(RILL_SPIRV_VAL spirv-val REQUIRED)
set(RILL_SHADER_ROOT ${PROJECT_SOURCE_DIR}/shaders)
set_property(GLOBAL PROPERTY RILL_SHADER_NAMES "")
set_property(GLOBAL PROPERTY RILL_SHADER_FILES "")
set_property(GLOBAL PROPERTY RILL_SHADER_RECIPES "")

function(rill_shader source)
  cmake_parse_arguments(ARG "" "AS" "DEFINES" ${ARGN})
  string(REGEX REPLACE "\\.[a-z]+$" "" name ${source})
  if(ARG_AS)
    set(name ${ARG_AS})
  endif()
  string(REPLACE "/" "_" symbol ${name})
  set(spv ${PROJECT_BINARY_DIR}/shaders/${name}.spv)
  set(array ${PROJECT_BINARY_DIR}/shaders/${name}.inc)
  get_filename_component(folder ${spv} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  file(GLOB headers CONFIGURE_DEPENDS ${RILL_SHADER_ROOT}/*/*.h ${RILL_SHADER_ROOT}/*/*.glsl)
  set(defines ${ARG_DEFINES})
  list(TRANSFORM defines PREPEND -D)
  add_custom_command(
    OUTPUT ${spv} ${array}
    COMMAND ${RILL_GLSLANG} --quiet -V --target-env vulkan1.3 -I${RILL_SHADER_ROOT} ${defines} -o ${spv} ${RILL_SHADER_ROOT}/${source}
    COMMAND ${RILL_SPIRV_VAL} --target-env vulkan1.3 ${spv}
    COMMAND ${RILL_GLSLANG} --quiet -V --target-env vulkan1.3 -I${RILL_SHADER_ROOT} ${defines} --vn shader_${symbol} -o ${array} ${RILL_SHADER_ROOT}/${source}
    DEPENDS ${RILL_SHADER_ROOT}/${source} ${headers}
    COMMENT "Shader ${name}" VERBATIM)
  set_property(GLOBAL APPEND PROPERTY RILL_SHADER_NAMES ${name})
  set_property(GLOBAL APPEND PROPERTY RILL_SHADER_FILES ${array})
  list(JOIN ARG_DEFINES " " joined)
  set_property(GLOBAL APPEND PROPERTY RILL_SHADER_RECIPES "${source}|${joined}")
endfunction()

# Writes the table of all shaders declared so far to a C++ file and adds it to `target`.
function(rill_embed_shaders target)
  get_property(names GLOBAL PROPERTY RILL_SHADER_NAMES)
  get_property(files GLOBAL PROPERTY RILL_SHADER_FILES)
  get_property(recipes GLOBAL PROPERTY RILL_SHADER_RECIPES)
  set(includes "")
  set(rows "")
  foreach(name file recipe IN ZIP_LISTS names files recipes)
    string(REPLACE "/" "_" symbol ${name})
    string(REGEX REPLACE "\\|.*" "" source "${recipe}")
    string(REGEX REPLACE "^[^|]*\\|" "" defines "${recipe}")
    string(APPEND includes "#include \"${file}\"\n")
    string(APPEND rows "    {\"${name}\", \"${source}\", \"${defines}\", shader_${symbol}},\n")
  endforeach()
  set(table ${PROJECT_BINARY_DIR}/shaders/embedded_shaders.cpp)
  file(CONFIGURE OUTPUT ${table} CONTENT
"// Generated: SPIR-V of shaders/, see cmake/shaders.cmake.
#include <cstdint>
#include \"gpu/shader_library.hpp\"
namespace {
@includes@}
namespace rill {
namespace {
constexpr EmbeddedShader kShaders[] = {
@rows@};
}
std::span<const EmbeddedShader> embeddedShaders() { return kShaders; }
}  // namespace rill
" @ONLY)
  set_source_files_properties(${table} PROPERTIES OBJECT_DEPENDS "${files}")
  target_sources(${target} PRIVATE ${table})
  add_dependencies(${target} rill_shaders)
endfunction()
