# Installs the build, moves what was installed, and builds the hosts against it in a clean folder, from copies of their sources.
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
