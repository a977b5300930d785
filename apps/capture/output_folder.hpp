#pragma once
#include <cstdint>
#include <filesystem>

#include "rill/expected.hpp"
#include "shared/folder_lock.hpp"

namespace rill::capture {

/// The folder that frames go to, held for this capture alone.
class OutputFolder {
 public:
  /// Makes the folder, takes it, and removes the frames of an earlier capture, unless this one goes on from it (`keep`): frame_NNNNN.png
  /// and .ply, and in any case parts of such files. Nothing else is touched.
  static Expected<OutputFolder> prepare(const std::filesystem::path& folder, bool keep = false);

  /// DIR/frame_00042.EXTENSION
  std::filesystem::path frame(uint32_t number, const char* extension) const;

 private:
  OutputFolder(std::filesystem::path folder, apps::FolderLock lock) : folder_(std::move(folder)), lock_(std::move(lock)) {}
  std::filesystem::path folder_;
  apps::FolderLock lock_;
};

}  // namespace rill::capture
