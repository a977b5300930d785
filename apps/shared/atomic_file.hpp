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

/// True for "-", the standard streams, devices, pipes and sockets. They are written in place and never replaced.
bool isSpecialFile(const std::filesystem::path& file);
/// True where `file` names this process's standard output.
bool isStandardOutput(const std::filesystem::path& file);

/// Writes all of `bytes` to `file`. A regular file is written to a part file, synced and renamed, so that readers see
/// either the old content or the new; links are followed. A special file is written directly, a standard stream as by
/// writeStream(). Io, with the file and the reason.
Expected<void> writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes);
Expected<void> writeFile(const std::filesystem::path& file, std::string_view text);

/// Writes to standard output or standard error (STDOUT_FILENO, STDERR_FILENO). A stream that is closed, or whose reader
/// has exited, is not an error: the rest is not read. Io for anything else, such as a full disk.
Expected<void> writeStream(int stream, std::span<const std::byte> bytes);
Expected<void> writeStream(int stream, std::string_view text);

/// Opens /dev/null for each standard stream that was closed when the program started, so that no file or device opened
/// later gets its descriptor and receives messages. Reading and writing them still fails.
void reserveStandardStreams();

/// Writes all bytes to an open descriptor, in as many writes as it takes. Io; `name` is the descriptor's in the message.
Expected<void> writeAll(int descriptor, std::string_view name, std::span<const std::byte> bytes);
Expected<void> writeAll(int descriptor, std::string_view name, std::string_view text);

/// Checks whether writeFile() can succeed, without creating anything. BadInput, with the name of the `option`, for a folder
/// in place of the file, a file in place of a folder, missing permission, a closed stream.
Expected<void> checkFilePlace(std::string_view option, const std::filesystem::path& file);
/// The same for a folder that will be created where it is missing.
Expected<void> checkFolderPlace(std::string_view option, const std::filesystem::path& folder);

/// Creates the folder and its parents. BadInput, with the name of the `option`, where that fails.
Expected<void> makeFolder(std::string_view option, const std::filesystem::path& folder);

/// A file that is written next to its target and replaces it on commit(). Without commit() it is removed.
class PartFile {
 public:
  /// Creates an empty part file with the mode of the existing target; links are followed. Io, with `file`.
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
  /// Syncs the file and renames it to its target. Io.
  Expected<void> commit();

 private:
  PartFile(std::string name, std::filesystem::path target, std::filesystem::path path, Descriptor descriptor)
      : name_(std::move(name)), target_(std::move(target)), path_(std::move(path)), descriptor_(std::move(descriptor)) {}
  std::string name_;                     ///< of the target as given, for messages
  std::filesystem::path target_, path_;  ///< the target; the part file, empty after commit()
  Descriptor descriptor_;
};

/// True where `name` is that of a part file, left by a process that was killed; `target` is then the target's name.
bool isPartFile(std::string_view name, std::string_view& target);

}  // namespace rill::apps
