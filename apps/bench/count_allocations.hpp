#pragma once
#include <cstddef>

namespace rill::bench {

/// Counts every operator new of this thread from here on.
void startCounting();
size_t stopCounting();

}  // namespace rill::bench
