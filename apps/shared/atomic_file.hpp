#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "rill/expected.hpp"

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

/// Whether `name` is that of a part file that writeFile() left when it was killed; `target` is then the file it was meant for.
bool isPartFile(std::string_view name, std::string_view& target);

}  // namespace rill::apps
