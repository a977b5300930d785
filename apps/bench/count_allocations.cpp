// In its own file: inlined next to malloc and free, operator new causes false mismatched-allocation warnings.
#include "bench/count_allocations.hpp"

#include <cstdlib>
#include <new>

namespace {
thread_local bool counting = false;
thread_local size_t allocations = 0;
}  // namespace

namespace rill::bench {
void startCounting() { counting = true, allocations = 0; }
size_t stopCounting() {
  counting = false;
  return allocations;
}
}  // namespace rill::bench

void* operator new(size_t size) {
  if (counting) ++allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
