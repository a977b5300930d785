#pragma once
#include <cstdio>
#include <cstdlib>

/// Aborts if a condition that every input must satisfy is false, in all build types; fuzzers report it as a crash.
#define RILL_REQUIRE(what)                                                                \
  do {                                                                                    \
    if (!(what)) {                                                                        \
      std::fprintf(stderr, "%s:%d: requirement failed: %s\n", __FILE__, __LINE__, #what); \
      std::abort();                                                                       \
    }                                                                                     \
  } while (false)
