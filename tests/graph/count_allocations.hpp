#pragma once
#include <cstddef>

namespace rill::test {

/// Counts every operator new of the program from here on.
void startCounting();
size_t stopCounting();

}  // namespace rill::test
