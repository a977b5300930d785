#include "shared/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "core/words.hpp"

namespace rill::apps {
namespace fs = std::filesystem;
namespace {

std::string reason(int code) { return std::generic_category().message(code); }

Error ioError(std::string_view name, std::string_view what, int code) {
  return Error{ErrorKind::Io, "can't " + std::string(what) + " " + std::string(name) + ": " + reason(code)};
}

/// Writes all bytes; the value of errno where that fails, else 0.
int writeBytes(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written >= 0)
      bytes = bytes.subspan(static_cast<size_t>(written));
    else if (errno != EINTR)
      return errno;
  }
  return 0;
}

/// 1 or 2 for the names of a standard stream, else -1. They are written through the open descriptor: opening
/// /dev/stdout again would write at offset 0 of a redirected file, and fails for a socket.
int standardStream(const fs::path& file) {
  if (file == "-") return STDOUT_FILENO;  // "./-" is a file
  const std::string name = file.lexically_normal().string();
  if (name == "/dev/stdout" || name == "/dev/fd/1" || name == "/proc/self/fd/1") return STDOUT_FILENO;
  if (name == "/dev/stderr" || name == "/dev/fd/2" || name == "/proc/self/fd/2") return STDERR_FILENO;
  return -1;
}

bool isBelow(const fs::path& file, std::string_view root) { return file.string().starts_with(root); }

/// The file to replace: the end of a chain of links, whether it exists or not.
fs::path followLinks(fs::path file) {
  std::error_code ignored;
  for (int depth = 0; depth < 40 && fs::is_symlink(file, ignored); ++depth) {
    const fs::path target = fs::read_symlink(file, ignored);
    if (ignored) break;
    file = target.is_absolute() ? target : file.parent_path() / target;
  }
  return file;
}

fs::path folderOf(const fs::path& file) {
  const fs::path folder = file.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

/// The nearest existing folder above `path`, or the file that is there in place of one.
fs::path existingAncestor(fs::path path) {
  std::error_code ignored;
  while (!fs::exists(path, ignored)) {
    const fs::path parent = path.parent_path();
    if (parent.empty()) return ".";
    if (parent == path) break;
    path = parent;
  }
  return path;
}

}  // namespace

bool isStandardOutput(const fs::path& file) { return standardStream(file) == STDOUT_FILENO; }

bool isSpecialFile(const fs::path& file) {
  if (standardStream(file) >= 0 || isBelow(file, "/dev/") || isBelow(file, "/proc/")) return true;
  struct stat info {};
  return ::stat(file.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

Expected<void> writeAll(int descriptor, std::string_view name, std::span<const std::byte> bytes) {
  const int error = writeBytes(descriptor, bytes);
  return error == 0 ? Expected<void>() : ioError(name, "write", error);
}

Expected<void> writeAll(int descriptor, std::string_view name, std::string_view text) {
  return writeAll(descriptor, name, std::as_bytes(std::span(text.data(), text.size())));
}

Expected<PartFile> PartFile::create(const fs::path& file) {
  const fs::path target = followLinks(file);
  const fs::path part = folderOf(target) / ("." + target.filename().string() + "." + std::to_string(::getpid()) + ".part");
  int opened = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (opened < 0 && errno == EEXIST) {  // left by a killed process that had the same id
    ::unlink(part.c_str());
    opened = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  }
  if (opened < 0) return ioError(file.string(), "write", errno);
  struct stat before {};
  if (::stat(target.c_str(), &before) == 0 && ::fchmod(opened, before.st_mode & 07777) != 0) { /* keep the default mode */
  }
  return PartFile(file.string(), target, part, Descriptor(opened));
}

PartFile::~PartFile() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

Expected<void> PartFile::commit() {
  // A full disk may be reported only here. EINVAL: the file system does not support sync.
  if (::fsync(descriptor_.get()) != 0 && errno != EINVAL && errno != ENOSYS) return ioError(name_, "write", errno);
  if (descriptor_.close() != 0 && errno != EINTR) return ioError(name_, "write", errno);
  if (::rename(path_.c_str(), target_.c_str()) != 0) return ioError(name_, "write", errno);
  path_.clear();
  return {};
}

Expected<void> writeStream(int stream, std::span<const std::byte> bytes) {
  const int error = writeBytes(stream, bytes);
  if (error == 0 || error == EPIPE || error == EBADF) return {};
  return ioError(stream == STDOUT_FILENO ? "standard output" : "standard error", "write", error);
}

Expected<void> writeStream(int stream, std::string_view text) {
  return writeStream(stream, std::as_bytes(std::span(text.data(), text.size())));
}

void reserveStandardStreams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // Opened in the opposite mode, so that reading or writing still fails with EBADF.
    if (::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) return;
  }
}

Expected<void> writeFile(const fs::path& file, std::span<const std::byte> bytes) {
  const std::string name = file.string();
  if (const int stream = standardStream(file); stream >= 0) return writeStream(stream, bytes);
  if (!isSpecialFile(file)) {
    auto part = PartFile::create(file);
    if (!part) return part.error();
    if (auto written = writeAll(part->descriptor(), name, bytes); !written) return written;
    return part->commit();
  }
  Descriptor descriptor(::open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
  if (descriptor.get() < 0) return ioError(name, "open", errno);
  Expected<void> written = writeAll(descriptor.get(), name, bytes);
  if (descriptor.close() != 0 && written && errno != EINTR) written = ioError(name, "write", errno);
  return written;
}

Expected<void> writeFile(const fs::path& file, std::string_view text) {
  return writeFile(file, std::as_bytes(std::span(text.data(), text.size())));
}

Expected<void> checkFilePlace(std::string_view option, const fs::path& file) {
  const std::string prefix = std::string(option) + ": ";
  std::error_code ignored;
  if (file.empty()) return Error{ErrorKind::BadInput, prefix + "found an empty name, expected the name of a file"};
  if (const int stream = standardStream(file); stream >= 0) {
    const int mode = ::fcntl(stream, F_GETFL);
    if (mode >= 0 && (mode & O_ACCMODE) != O_RDONLY) return {};
    return Error{ErrorKind::BadInput, prefix + (stream == STDOUT_FILENO ? "standard output" : "standard error") +
                                          " is closed; expected one that can be written, or the name of a file"};
  }
  if (fs::is_directory(file, ignored) || !file.has_filename())
    return Error{ErrorKind::BadInput, prefix + inQuotes(file.string()) + " is a folder; expected the name of a file"};
  if (fs::exists(file, ignored)) {
    if (::access(file.c_str(), W_OK) != 0)
      return Error{ErrorKind::BadInput, prefix + "can't write " + inQuotes(file.string()) + ": " + reason(errno)};
    if (isSpecialFile(file)) return {};
  } else if (isSpecialFile(file)) {
    return Error{ErrorKind::BadInput, prefix + inQuotes(file.string()) + ": no such file"};
  }
  return checkFolderPlace(option, folderOf(followLinks(file)));
}

Expected<void> checkFolderPlace(std::string_view option, const fs::path& folder) {
  const std::string prefix = std::string(option) + ": ";
  std::error_code ignored;
  if (folder.empty()) return Error{ErrorKind::BadInput, prefix + "found an empty name, expected the name of a folder"};
  const fs::path nearest = existingAncestor(folder);
  if (!fs::is_directory(nearest, ignored))
    return Error{ErrorKind::BadInput, prefix + inQuotes(nearest.string()) + " is a file; expected a folder"};
  if (::access(nearest.c_str(), W_OK | X_OK) != 0)
    return Error{ErrorKind::BadInput, prefix + "can't write in " + inQuotes(nearest.string()) + ": " + reason(errno)};
  return {};
}

Expected<void> makeFolder(std::string_view option, const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  // With a trailing slash create_directories() returns false for a folder that it created: check that the folder exists.
  std::error_code ignored;
  if (fs::is_directory(folder, ignored)) return {};
  return Error{ErrorKind::BadInput, std::string(option) + ": can't create the folder " + inQuotes(folder.string()) + ": " +
                                        (failed ? failed.message() : "unknown reason")};
}

bool isPartFile(std::string_view name, std::string_view& target) {
  constexpr std::string_view suffix = ".part";
  if (name.size() <= suffix.size() || !name.starts_with('.') || !name.ends_with(suffix)) return false;
  name.remove_prefix(1);
  name.remove_suffix(suffix.size());
  const size_t dot = name.rfind('.');
  if (dot == std::string_view::npos || dot + 1 == name.size()) return false;
  if (name.find_first_not_of("0123456789", dot + 1) != std::string_view::npos) return false;
  target = name.substr(0, dot);
  return !target.empty();
}

}  // namespace rill::apps
