#pragma once
#include <filesystem>
#include <utility>

#include "rill/expected.hpp"
#include "shared/descriptor.hpp"

namespace rill::apps {

/// An exclusive lock on a folder, for the lifetime of the object. The lock is on the folder itself: it needs no lock file
/// and ends with the process.
class FolderLock {
 public:
  /// BadInput where another process holds it. A file system without locks is used without one.
  static Expected<FolderLock> take(const std::filesystem::path& folder);

 private:
  explicit FolderLock(Descriptor descriptor) : descriptor_(std::move(descriptor)) {}
  Descriptor descriptor_;
};

}  // namespace rill::apps
