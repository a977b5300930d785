#pragma once
#include <cstdint>
#include <filesystem>

#include "rill/expected.hpp"
#include "shared/folder_lock.hpp"

namespace rill::capture {

/// The folder that frames are written to, locked for this capture.
class OutputFolder {
 public:
  /// Creates and locks the folder. Removes part files of frames, and unless `keep` (for --resume) the frames of an earlier
  /// capture, frame_NNNNN with the extension of an image or an export. Other files stay.
  static Expected<OutputFolder> prepare(const std::filesystem::path& folder, bool keep = false);

  /// DIR/NAME
  std::filesystem::path file(const char* name) const { return folder_ / name; }

  /// DIR/frame_00042.EXTENSION
  std::filesystem::path frame(uint32_t number, const char* extension) const;

 private:
  OutputFolder(std::filesystem::path folder, apps::FolderLock lock) : folder_(std::move(folder)), lock_(std::move(lock)) {}
  std::filesystem::path folder_;
  apps::FolderLock lock_;
};

}  // namespace rill::capture
