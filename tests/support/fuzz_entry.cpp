// libFuzzer's entry for the target that RILL_FUZZ_TARGET names.
#include "fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) { return rill::test::RILL_FUZZ_TARGET(data, size); }
