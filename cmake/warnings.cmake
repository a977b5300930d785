# rill_warnings(target): compiler warnings, sanitizers and fuzzing options of Rill's targets.
function(rill_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-missing-field-initializers)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-array-bounds -Wno-stringop-overread)  # false positives of GCC 12 in std::string and std::vector
  endif()
  if(RILL_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(RILL_FUZZ)  # -O1: unoptimized builds are too slow for fuzzing
    target_compile_options(${target} PUBLIC -O1 -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
  if(RILL_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=address,undefined -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
endfunction()
