#include "shared/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/words.hpp"

namespace rill::apps {

Expected<FolderLock> FolderLock::take(const std::filesystem::path& folder) {
  Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.get() < 0)
    return Error{ErrorKind::BadInput, "can't open the folder " + inQuotes(folder.string()) + ": " + std::generic_category().message(errno)};
  int result = 0;
  do result = ::flock(descriptor.get(), LOCK_EX | LOCK_NB);
  while (result != 0 && errno == EINTR);
  if (result != 0 && errno == EWOULDBLOCK)
    return Error{ErrorKind::BadInput,
                 "another capture is writing to " + inQuotes(folder.string()) + "; wait for it, or choose another folder with --out"};
  return FolderLock(std::move(descriptor));
}

}  // namespace rill::apps
