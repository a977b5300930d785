#pragma once
// The version of Rill, by semantic versioning. Before 1.0 a minor version may change the API (breaking
// changes are listed in CHANGELOG.md), a patch does not. The ABI is not stable: recompile for each version.
//
//   #if RILL_VERSION_MAJOR == 0 && RILL_VERSION_MINOR < 1
//   #error "needs Rill 0.1"
//   #endif
//   if (rill::version() != std::string_view(RILL_VERSION)) return fail("shared library and headers differ in version");
#include "rill/export.hpp"

#define RILL_VERSION_MAJOR 0
#define RILL_VERSION_MINOR 1
#define RILL_VERSION_PATCH 0
#define RILL_VERSION "0.1.0"

namespace rill {

/// The version of the loaded library, "major.minor.patch"; RILL_VERSION is the version of the headers.
RILL_API const char* version();

}  // namespace rill
