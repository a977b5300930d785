# GLSL -> SPIR-V (Vulkan 1.3), checked by spirv-val, embedded as arrays in the library.
#   rill_shader(fluid/density.comp)                                         becomes "fluid/density"
#   rill_shader(fluid/density.comp AS fluid/density_texel DEFINES LIST_TEXEL) becomes "fluid/density_texel"
#   rill_shader(gpu/add.comp ROOT ${CMAKE_CURRENT_SOURCE_DIR} GROUP tests)  belongs to a table of its own, not to the library's
# Every header under shaders/, and beside a shader, is a dependency of every shader: they are few, and a stale one is worse than a rebuild.
find_program(RILL_GLSLANG glslangValidator REQUIRED)
find_program(RILL_SPIRV_VAL spirv-val REQUIRED)
set(RILL_SHADER_ROOT ${PROJECT_SOURCE_DIR}/shaders)

function(rill_shader source)
  cmake_parse_arguments(ARG "" "AS;ROOT;GROUP" "DEFINES" ${ARGN})
  string(REGEX REPLACE "\\.[a-z]+$" "" name ${source})
  set(root ${RILL_SHADER_ROOT})
  if(ARG_ROOT)
    set(root ${ARG_ROOT})
  endif()
  set(group engine)
  if(ARG_GROUP)
    set(group ${ARG_GROUP})
  endif()
  if(ARG_AS)
    set(name ${ARG_AS})
  endif()
  string(REPLACE "/" "_" symbol ${name})
  set(spv ${PROJECT_BINARY_DIR}/shaders/${group}/${name}.spv)
  set(array ${PROJECT_BINARY_DIR}/shaders/${group}/${name}.inc)
  get_filename_component(folder ${spv} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  file(GLOB headers CONFIGURE_DEPENDS ${RILL_SHADER_ROOT}/*/*.h ${RILL_SHADER_ROOT}/*/*.glsl ${root}/*.h ${root}/*.glsl)
  set(defines ${ARG_DEFINES})
  list(TRANSFORM defines PREPEND -D)
  add_custom_command(
    OUTPUT ${spv} ${array}
    COMMAND ${RILL_GLSLANG} --quiet -V --target-env vulkan1.3 -I${RILL_SHADER_ROOT} ${defines} -o ${spv} ${root}/${source}
    COMMAND ${RILL_SPIRV_VAL} --target-env vulkan1.3 ${spv}
    COMMAND ${RILL_GLSLANG} --quiet -V --target-env vulkan1.3 -I${RILL_SHADER_ROOT} ${defines} --vn shader_${symbol} -o ${array} ${root}/${source}
    DEPENDS ${root}/${source} ${headers}
    COMMENT "Shader ${name}" VERBATIM)
  # Rules are known to their own folder alone; a target carries them to whoever embeds the shader.
  add_custom_target(shader_${group}_${symbol} DEPENDS ${spv} ${array})
  set_property(GLOBAL APPEND PROPERTY RILL_SHADER_NAMES_${group} ${name})
  set_property(GLOBAL APPEND PROPERTY RILL_SHADER_FILES_${group} ${array})
  list(JOIN ARG_DEFINES " " joined)
  set_property(GLOBAL APPEND PROPERTY RILL_SHADER_RECIPES_${group} "${source}|${joined}")
endfunction()

# Writes the table of a group's shaders declared so far to a C++ file and adds it to `target`, as rill::FUNCTION().
#   rill_embed_shaders(rill)    rill_embed_shaders(test_support GROUP tests FUNCTION testShaders)
function(rill_embed_shaders target)
  cmake_parse_arguments(ARG "" "GROUP;FUNCTION" "" ${ARGN})
  set(group engine)
  set(function embeddedShaders)
  if(ARG_GROUP)
    set(group ${ARG_GROUP})
    set(function ${ARG_FUNCTION})
  endif()
  get_property(names GLOBAL PROPERTY RILL_SHADER_NAMES_${group})
  get_property(files GLOBAL PROPERTY RILL_SHADER_FILES_${group})
  get_property(recipes GLOBAL PROPERTY RILL_SHADER_RECIPES_${group})
  set(includes "")
  set(rows "")
  foreach(name file recipe IN ZIP_LISTS names files recipes)
    string(REPLACE "/" "_" symbol ${name})
    string(REGEX REPLACE "\\|.*" "" source "${recipe}")
    string(REGEX REPLACE "^[^|]*\\|" "" defines "${recipe}")
    string(APPEND includes "#include \"${file}\"\n")
    string(APPEND rows "    {\"${name}\", \"${source}\", \"${defines}\", shader_${symbol}},\n")
  endforeach()
  list(LENGTH names count)
  set(table ${PROJECT_BINARY_DIR}/shaders/${group}_shaders.cpp)
  file(CONFIGURE OUTPUT ${table} CONTENT
"// Generated: SPIR-V, see cmake/shaders.cmake.
#include <array>
#include <cstdint>
#include \"gpu/shader_library.hpp\"
namespace {
@includes@}
namespace rill {
namespace {
constexpr std::array<EmbeddedShader, @count@> kShaders{{
@rows@}};
}
std::span<const EmbeddedShader> @function@() { return kShaders; }
}  // namespace rill
" @ONLY)
  set_source_files_properties(${table} PROPERTIES OBJECT_DEPENDS "${files}")
  target_sources(${target} PRIVATE ${table})
  list(TRANSFORM names REPLACE "/" "_" OUTPUT_VARIABLE rules)
  list(TRANSFORM rules PREPEND shader_${group}_)
  if(rules)
    add_dependencies(${target} ${rules})
  endif()
endfunction()
