#pragma once
#include <cstddef>

namespace rill::bench {

/// Counts calls of operator new in this thread until stopCounting().
void startCounting();
size_t stopCounting();

}  // namespace rill::bench
