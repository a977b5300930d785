# Converts a SPIR-V file to a C++ array of 32-bit words.
#   cmake -DSPIRV=density.spv -DNAME=shader_density -DOUT=density.inc -P spirv_words.cmake
file(READ ${SPIRV} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
file(WRITE ${OUT} "constexpr uint32_t ${NAME}[] = {${words}};\n")
