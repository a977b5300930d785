#pragma once
#include <filesystem>

#include "rill/expected.hpp"

namespace rill::apps {

/// Holds a folder for one program at a time, as long as it lives. The lock is on the folder itself: nothing is left in it, and it ends with
/// the process.
class FolderLock {
 public:
  /// BadInput where another program holds it. A file system that knows no locks is used without one.
  static Expected<FolderLock> take(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  FolderLock& operator=(FolderLock&& other) noexcept;

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace rill::apps
