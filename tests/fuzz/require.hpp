#pragma once
#include <cstdio>
#include <cstdlib>

/// Ends the program where something that must hold of any input does not: a finding, in every build.
#define RILL_REQUIRE(what)                                                          \
  do {                                                                              \
    if (!(what)) {                                                                  \
      std::fprintf(stderr, "%s:%d: %s does not hold\n", __FILE__, __LINE__, #what); \
      std::abort();                                                                 \
    }                                                                               \
  } while (false)
