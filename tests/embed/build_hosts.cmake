# Installs the build, moves the installation, and builds copies of the hosts against it in a clean folder.
#   cmake -DBUILD=... -DSOURCE=... -DOUT=... -DGENERATOR=... -P build_hosts.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT code EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${out}")
  endif()
endfunction()

file(REMOVE_RECURSE ${OUT}/first ${OUT}/rill ${OUT}/embed ${OUT}/hosts)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${OUT}/first)
file(RENAME ${OUT}/first ${OUT}/rill)
file(COPY ${SOURCE}/apps/embed DESTINATION ${OUT})
file(COPY ${SOURCE}/tests/hosts DESTINATION ${OUT})
set(flags "-Wall -Wextra -Wpedantic -Wno-missing-field-initializers -Wno-maybe-uninitialized -Werror")  # the last: false alarms of GCC 12 about std::optional
set(common -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${OUT}/rill -DCMAKE_CXX_FLAGS=${flags} -DEMBED_DIR=${OUT}/embed)
foreach(project embed hosts)
  run(${CMAKE_COMMAND} -S ${OUT}/${project} -B ${OUT}/build-${project} ${common})
  run(${CMAKE_COMMAND} --build ${OUT}/build-${project} --parallel)
endforeach()

# The same without CMake.
find_program(PKG_CONFIG pkg-config REQUIRED)
file(GLOB_RECURSE modules ${OUT}/rill/*/rill_scene.pc)
get_filename_component(folder ${modules} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${folder})
execute_process(COMMAND ${PKG_CONFIG} --cflags --libs rill_scene COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE)
execute_process(COMMAND ${PKG_CONFIG} --variable=libdir rill COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE libraries OUTPUT_STRIP_TRAILING_WHITESPACE)
separate_arguments(flags)
run(${CXX} -std=c++20 -DSCENES="${OUT}/rill/share/rill/scenes" ${OUT}/hosts/scenes.cpp ${flags} -Wl,-rpath,${libraries} -o ${OUT}/build-hosts/scenes_pkgconfig)
