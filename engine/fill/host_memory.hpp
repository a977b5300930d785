#pragma once
// How much memory a process may still take, for messages.
#include <algorithm>
#include <cstdint>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace rill {

/// Free physical memory, or the process's limit where that is lower, bytes. 0: unknown.
inline uint64_t availableHostBytes() {
  uint64_t bytes = 0;
#ifdef _SC_AVPHYS_PAGES
  const long pages = ::sysconf(_SC_AVPHYS_PAGES), size = ::sysconf(_SC_PAGESIZE);
  if (pages > 0 && size > 0) bytes = static_cast<uint64_t>(pages) * static_cast<uint64_t>(size);
#endif
#ifdef RLIMIT_AS
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    bytes = bytes == 0 ? static_cast<uint64_t>(limit.rlim_cur) : std::min(bytes, static_cast<uint64_t>(limit.rlim_cur));
#endif
  return bytes;
}

}  // namespace rill
