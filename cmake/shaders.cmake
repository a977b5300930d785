# Compiles GLSL to SPIR-V (Vulkan 1.3), optimizes it with spirv-opt and validates it with spirv-val if they are installed, and embeds it
# as arrays in a library, with what spirv-cross reflects: bindings, specialization constants, push constants.
#   rill_shader(fluid/density.comp)                                           adds "fluid/density"
#   rill_shader(fluid/density.comp AS fluid/density_texel DEFINES LIST_TEXEL) adds "fluid/density_texel"
#   rill_shader(gpu/add.comp ROOT ${CMAKE_CURRENT_SOURCE_DIR} GROUP tests)    adds to the table of the group 'tests'
# Every shader depends on all headers under shaders/ and in its own folder: there are few, so exact dependencies are not worth tracking.
find_program(RILL_GLSLANG glslangValidator)
find_program(RILL_SPIRV_VAL spirv-val)
find_program(RILL_SPIRV_OPT spirv-opt)  # shortens start-up; see docs/notes/lavapipe.md
find_program(RILL_SPIRV_CROSS spirv-cross)
if(NOT RILL_GLSLANG)
  message(FATAL_ERROR "glslangValidator not found; install it (Debian: glslang-tools) or set RILL_GLSLANG to its path")
endif()
if(NOT RILL_SPIRV_CROSS)
  message(FATAL_ERROR "spirv-cross not found; install it (Debian: spirv-cross) or set RILL_SPIRV_CROSS to its path")
endif()
set(RILL_SHADER_ROOT ${PROJECT_SOURCE_DIR}/shaders)
set(RILL_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_shader.cmake)

# Adds a shader to a group for rill_embed_shaders().
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
  list(JOIN ARG_DEFINES " " defines)
  set_property(GLOBAL APPEND PROPERTY RILL_SHADERS_${group} "${name}|${root}|${source}|${defines}")
endfunction()

# Compiles all shaders of a group and adds their table to `target` as rill::FUNCTION().
#   rill_embed_shaders(rill)    rill_embed_shaders(test_support GROUP tests FUNCTION testShaders)
function(rill_embed_shaders target)
  cmake_parse_arguments(ARG "" "GROUP;FUNCTION" "" ${ARGN})
  set(group engine)
  set(function embeddedShaders)
  if(ARG_GROUP)
    set(group ${ARG_GROUP})
    set(function ${ARG_FUNCTION})
  endif()
  get_property(shaders GLOBAL PROPERTY RILL_SHADERS_${group})
  set(includes "")
  set(rows "")
  set(arrays "")
  foreach(shader IN LISTS shaders)
    string(REPLACE "|" ";" parts "${shader}")
    list(GET parts 0 name)
    list(GET parts 1 root)
    list(GET parts 2 source)
    list(GET parts 3 defines)
    string(REPLACE "/" "_" symbol ${name})
    set(spv ${PROJECT_BINARY_DIR}/shaders/${group}/${name}.spv)
    set(reflection ${PROJECT_BINARY_DIR}/shaders/${group}/${name}.json)
    set(used ${PROJECT_BINARY_DIR}/shaders/${group}/${name}.used.json)
    set(array ${PROJECT_BINARY_DIR}/shaders/${group}/${name}.inc)
    get_filename_component(folder ${spv} DIRECTORY)
    file(MAKE_DIRECTORY ${folder})
    file(GLOB headers CONFIGURE_DEPENDS ${RILL_SHADER_ROOT}/*/*.h ${RILL_SHADER_ROOT}/*/*.glsl ${root}/*.h ${root}/*.glsl)
    string(REPLACE " " ";" flags "${defines}")
    list(TRANSFORM flags PREPEND -D)
    set(optimize "")
    if(RILL_SPIRV_OPT AND NOT CMAKE_BUILD_TYPE STREQUAL "Debug")  # keep debug names
      set(optimize COMMAND ${RILL_SPIRV_OPT} --target-env=vulkan1.3 -O --strip-debug ${spv} -o ${spv})
    endif()
    set(check "")
    if(RILL_SPIRV_VAL)
      set(check COMMAND ${RILL_SPIRV_VAL} --target-env vulkan1.3 ${spv})
    endif()
    add_custom_command(
      OUTPUT ${spv} ${array}
      COMMAND ${RILL_GLSLANG} --quiet -V --target-env vulkan1.3 -I${RILL_SHADER_ROOT} ${flags} -o ${spv} ${root}/${source}
      COMMAND ${RILL_SPIRV_CROSS} ${spv} --reflect --output ${reflection}
      ${optimize}
      ${check}
      COMMAND ${RILL_SPIRV_CROSS} ${spv} --reflect --output ${used}
      COMMAND ${CMAKE_COMMAND} -DSPIRV=${spv} -DREFLECTION=${reflection} -DUSED=${used} -DNAME=shader_${symbol} -DOUT=${array} -P ${RILL_EMBED_SCRIPT}
      DEPENDS ${root}/${source} ${headers} ${RILL_EMBED_SCRIPT}
      COMMENT "Shader ${name}" VERBATIM)
    list(APPEND arrays ${array})
    string(APPEND includes "#include \"${array}\"\n")
    string(APPEND rows "    {\"${name}\", \"${source}\", \"${defines}\", shader_${symbol}, shader_${symbol}_bindings, shader_${symbol}_constants, shader_${symbol}_push},\n")
  endforeach()
  list(LENGTH shaders count)
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
  set_source_files_properties(${table} PROPERTIES OBJECT_DEPENDS "${arrays}")
  target_sources(${target} PRIVATE ${table} ${arrays})
endfunction()
