#pragma once
// Which Rill this is. Semantic versioning: before 1.0 a new minor version may change the interface (CHANGELOG.md says what breaks), a patch
// does not; the ABI is promised by neither, so a host is compiled anew with each.
//
//   #if RILL_VERSION_MAJOR == 0 && RILL_VERSION_MINOR < 1
//   #error "needs Rill 0.1"
//   #endif
//   if (rill::version() != std::string_view(RILL_VERSION)) return fail("the shared library is not the one of these headers");
#include "rill/export.hpp"

#define RILL_VERSION_MAJOR 0
#define RILL_VERSION_MINOR 1
#define RILL_VERSION_PATCH 0
#define RILL_VERSION "0.1.0"

namespace rill {

/// Version of the library that runs, "major.minor.patch"; RILL_VERSION is that of the headers.
RILL_API const char* version();

}  // namespace rill
