#include "shared/piped_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "shared/atomic_file.hpp"

namespace rill::apps {
namespace fs = std::filesystem;
namespace {

constexpr size_t kMaxOutputBytes = 600;  // bytes of a process's output that a message repeats

Error cannotStart(const std::string& name, int code) {
  return Error{ErrorKind::Io, "can't start " + name + ": " + std::generic_category().message(code)};
}

}  // namespace

std::optional<fs::path> findProgram(std::string_view name) {
  const char* path = std::getenv("PATH");
  std::string_view left = path ? path : "";
  while (!left.empty()) {
    const size_t colon = std::min(left.find(':'), left.size());
    const fs::path file = fs::path(left.substr(0, colon)) / name;
    left.remove_prefix(std::min(colon + 1, left.size()));
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0) return fs::absolute(file, ignored);
  }
  return std::nullopt;
}

Expected<PipedProcess> PipedProcess::start(const fs::path& program, std::span<const std::string> arguments) {
  const std::string name = program.filename().string();
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) return cannotStart(name, errno);
  Descriptor output(ends[0]), input(ends[1]);
  // A file, not a pipe, which would have to be read while the process runs.
  Descriptor log(::memfd_create("log", MFD_CLOEXEC));
  if (log.get() < 0) return cannotStart(name, errno);

  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, output.get(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, log.get(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, log.get(), STDERR_FILENO);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);  // ignored in this process
  ::posix_spawnattr_setsigdefault(&attributes, &defaults);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  pid_t id = -1;
  const int failed = ::posix_spawn(&id, program.c_str(), &files, &attributes, argv.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  if (failed != 0) return cannotStart(name, failed);
  return PipedProcess(name, id, std::move(input), std::move(log));
}

PipedProcess::~PipedProcess() {
  if (id_ > 0) (void)finish();
}

Expected<void> PipedProcess::write(std::span<const std::byte> bytes) { return writeAll(input_.get(), "to " + name_, bytes); }

Expected<void> PipedProcess::finish() {
  input_.close();
  int status = 0;
  pid_t ended = -1;
  do ended = ::waitpid(id_, &status, 0);
  while (ended < 0 && errno == EINTR);
  id_ = -1;
  if (ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  const std::string how = ended > 0 && WIFSIGNALED(status) ? std::string("was killed: ") + ::strsignal(WTERMSIG(status))
                                                           : "failed with exit code " + std::to_string(WEXITSTATUS(status));
  const std::string output = lastOutput();
  return Error{ErrorKind::Io, name_ + " " + how + (output.empty() ? "" : "\n" + output)};
}

std::string PipedProcess::lastOutput() const {
  struct stat info {};
  if (::fstat(log_.get(), &info) != 0) return {};
  const off_t from = std::max<off_t>(info.st_size - static_cast<off_t>(kMaxOutputBytes), 0);
  std::string output(kMaxOutputBytes, '\0');
  const ssize_t count = ::pread(log_.get(), output.data(), output.size(), from);
  output.resize(count > 0 ? static_cast<size_t>(count) : 0);
  while (!output.empty() && (output.back() == '\n' || output.back() == '\r')) output.pop_back();
  if (const size_t line = output.find('\n'); from > 0 && line != std::string::npos)
    output.erase(0, line + 1);  // drop the incomplete first line
  for (char& c : output)
    if (static_cast<unsigned char>(c) < 32 && c != '\n') c = ' ';
  return output;
}

}  // namespace rill::apps
