#include "rill/version.hpp"

#include <string_view>

namespace rill {

#define RILL_TEXT(x) #x
#define RILL_TEXT_OF(x) RILL_TEXT(x)
static_assert(std::string_view(RILL_VERSION) ==
              RILL_TEXT_OF(RILL_VERSION_MAJOR) "." RILL_TEXT_OF(RILL_VERSION_MINOR) "." RILL_TEXT_OF(RILL_VERSION_PATCH));

const char* version() { return RILL_VERSION; }

}  // namespace rill
