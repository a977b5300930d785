#include "rill/version.hpp"

namespace rill {

const char* version() { return RILL_VERSION; }

}  // namespace rill
