# Fails if LIBRARY defines or imports a symbol named vk*.
execute_process(COMMAND ${NM} ${LIBRARY} OUTPUT_VARIABLE symbols ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT symbols MATCHES "rill")
  message(FATAL_ERROR "${NM} could not list the symbols of ${LIBRARY}")
endif()
string(REGEX MATCHALL "[^\n]* [A-Za-z] vk[A-Z][^\n]*" found "${symbols}")
if(found)
  message(FATAL_ERROR "${LIBRARY} has Vulkan symbols: ${found}")
endif()
