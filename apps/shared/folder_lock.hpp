#pragma once
#include <filesystem>
#include <utility>

#include "rill/expected.hpp"
#include "shared/descriptor.hpp"

namespace rill::apps {

/// Holds a folder for one program at a time, as long as it lives. The lock is on the folder itself: nothing is left in it, and it ends with
/// the process.
class FolderLock {
 public:
  /// BadInput where another program holds it. A file system that knows no locks is used without one.
  static Expected<FolderLock> take(const std::filesystem::path& folder);

 private:
  explicit FolderLock(Descriptor descriptor) : descriptor_(std::move(descriptor)) {}
  Descriptor descriptor_;
};

}  // namespace rill::apps
