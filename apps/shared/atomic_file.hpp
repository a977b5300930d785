#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "rill/expected.hpp"
#include "shared/descriptor.hpp"

namespace rill::apps {

/// Whether `file` is written in place: "-" and the standard streams, devices, pipes, sockets. They are never replaced.
bool isSpecialFile(const std::filesystem::path& file);
/// Whether what is written to `file` goes to this program's standard output.
bool isStandardOutput(const std::filesystem::path& file);

/// Writes all of `bytes` to `file`. A regular file is written beside, synced and renamed, so that others see the old content or the new,
/// never a part; a link is followed, not replaced. A special file is written directly. Io, naming the file and the reason.
Expected<void> writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes);
Expected<void> writeFile(const std::filesystem::path& file, std::string_view text);

/// Writes to an open descriptor to the end, whatever the size of a single write. Io; `name` stands for it in the message.
Expected<void> writeAll(int descriptor, std::string_view name, std::span<const std::byte> bytes);
Expected<void> writeAll(int descriptor, std::string_view name, std::string_view text);

/// Whether writeFile() could succeed, as far as can be told without touching anything: BadInput, naming `option`, for a folder in the
/// file's place, a file in a folder's place, a place that may not be written to.
Expected<void> checkFilePlace(std::string_view option, const std::filesystem::path& file);
/// The same for a folder that will be made where it is missing.
Expected<void> checkFolderPlace(std::string_view option, const std::filesystem::path& folder);

/// Makes the folder and those above it. BadInput, naming `option`, where that fails.
Expected<void> makeFolder(std::string_view option, const std::filesystem::path& folder);

/// A file that is written beside the one it is meant for, and takes its place when it is whole. What is not committed is removed.
class PartFile {
 public:
  /// Empty, with the mode of the file that is there; a link is followed. Io, naming `file`.
  static Expected<PartFile> create(const std::filesystem::path& file);
  PartFile(PartFile&& other) noexcept
      : name_(std::move(other.name_)),
        target_(std::move(other.target_)),
        path_(std::exchange(other.path_, {})),
        descriptor_(std::move(other.descriptor_)) {}
  PartFile& operator=(PartFile&&) = delete;
  ~PartFile();

  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return descriptor_.get(); }
  /// Syncs and renames, once all is written. Io.
  Expected<void> commit();

 private:
  PartFile(std::string name, std::filesystem::path target, std::filesystem::path path, Descriptor descriptor)
      : name_(std::move(name)), target_(std::move(target)), path_(std::move(path)), descriptor_(std::move(descriptor)) {}
  std::string name_;                     ///< as given, for messages
  std::filesystem::path target_, path_;  ///< the file that it becomes; its own, empty once it is renamed
  Descriptor descriptor_;
};

/// Whether `name` is that of a part file of a program that was killed; `target` is then the file it was meant for.
bool isPartFile(std::string_view name, std::string_view& target);

}  // namespace rill::apps
