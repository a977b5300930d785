#include "shared/fed_program.hpp"

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

constexpr size_t kMaxWords = 600;  // bytes of what a program said that a message repeats

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

Expected<FedProgram> FedProgram::start(const fs::path& program, std::span<const std::string> arguments) {
  const std::string name = program.filename().string();
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) return cannotStart(name, errno);
  Descriptor output(ends[0]), input(ends[1]);
  // A file, not a pipe: nobody has to read it while the program is fed.
  Descriptor said(::memfd_create("said", MFD_CLOEXEC));
  if (said.get() < 0) return cannotStart(name, errno);

  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);

  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, output.get(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, said.get(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, said.get(), STDERR_FILENO);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  sigset_t ours;
  sigemptyset(&ours);
  sigaddset(&ours, SIGPIPE);  // ignored here
  ::posix_spawnattr_setsigdefault(&attributes, &ours);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  pid_t id = -1;
  const int failed = ::posix_spawn(&id, program.c_str(), &files, &attributes, words.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  if (failed != 0) return cannotStart(name, failed);
  return FedProgram(name, id, std::move(input), std::move(said));
}

FedProgram::~FedProgram() {
  if (id_ > 0) (void)finish();
}

Expected<void> FedProgram::feed(std::span<const std::byte> bytes) { return writeAll(input_.get(), "to " + name_, bytes); }

Expected<void> FedProgram::finish() {
  input_.close();
  int status = 0;
  pid_t ended = -1;
  do ended = ::waitpid(id_, &status, 0);
  while (ended < 0 && errno == EINTR);
  id_ = -1;
  if (ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  const std::string how = ended > 0 && WIFSIGNALED(status) ? std::string("was ended: ") + ::strsignal(WTERMSIG(status))
                                                           : "failed with exit code " + std::to_string(WEXITSTATUS(status));
  const std::string words = lastWords();
  return Error{ErrorKind::Io, name_ + " " + how + (words.empty() ? "" : "\n" + words)};
}

std::string FedProgram::lastWords() const {
  struct stat info {};
  if (::fstat(said_.get(), &info) != 0) return {};
  const off_t from = std::max<off_t>(info.st_size - static_cast<off_t>(kMaxWords), 0);
  std::string words(kMaxWords, '\0');
  const ssize_t count = ::pread(said_.get(), words.data(), words.size(), from);
  words.resize(count > 0 ? static_cast<size_t>(count) : 0);
  while (!words.empty() && (words.back() == '\n' || words.back() == '\r')) words.pop_back();
  if (const size_t line = words.find('\n'); from > 0 && line != std::string::npos) words.erase(0, line + 1);  // whole lines
  for (char& c : words)
    if (static_cast<unsigned char>(c) < 32 && c != '\n') c = ' ';
  return words;
}

}  // namespace rill::apps
