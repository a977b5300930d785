# Fails where LIBRARY has a variable that can be written, but for the counter by which graphs tell their refs apart.
execute_process(COMMAND ${OBJDUMP} -t ${LIBRARY} OUTPUT_VARIABLE symbols ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT symbols MATCHES "nextEpoch")
  message(FATAL_ERROR "${OBJDUMP} could not list the symbols of ${LIBRARY}")
endif()
# Constants that hold addresses lie in .data.rel.ro, read only once they are relocated. DW.ref: the compiler's, for exceptions.
string(REGEX MATCHALL "[^\n]* O \\.(data|bss|tdata|tbss)[^\n]*" found "${symbols}")
list(FILTER found EXCLUDE REGEX " O \\.data\\.rel\\.(ro|local\\.DW\\.ref)|nextEpochEvE5epoch$")
if(found)
  message(FATAL_ERROR "${LIBRARY} has global state: ${found}")
endif()
