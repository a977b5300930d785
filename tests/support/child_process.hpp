#pragma once
// Runs a child process and captures its output.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace rill::test {

struct Outcome {
  int code = -1;         ///< exit code; 128 + signal number if a signal ended the program
  std::string out, err;  ///< standard output and standard error
};

/// A running program, killed by the destructor if it has not ended.
class Child {
 public:
  using Environment = std::vector<std::pair<std::string, std::string>>;

  /// `standardOutput`: a file to receive standard output instead of the pipe.
  explicit Child(const std::vector<std::string>& command, const std::string& folder = ".", const Environment& environment = {},
                 const std::string& standardOutput = {}) {
    int out[2] = {-1, -1}, err[2] = {-1, -1};
    if (::pipe2(out, O_CLOEXEC) != 0 || ::pipe2(err, O_CLOEXEC) != 0) return;
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ == 0) {
      for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
      const int target = standardOutput.empty() ? out[1] : ::open(standardOutput.c_str(), O_WRONLY | O_CLOEXEC);
      if (::chdir(folder.c_str()) == 0 && ::dup2(target, STDOUT_FILENO) >= 0 && ::dup2(err[1], STDERR_FILENO) >= 0)
        ::execv(arguments[0], arguments.data());
      ::_exit(127);
    }
    ::close(out[1]);
    ::close(err[1]);
    out_ = out[0];
    err_ = err[0];
  }
  ~Child() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    closeOut();
    if (err_ >= 0) ::close(err_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Reads until `text` appears on standard error; false if the program ends before.
  bool waitForMessage(const std::string& text) {
    while (outcome_.err.find(text) == std::string::npos)
      if (!readSome()) return false;
    return true;
  }
  /// Waits until the file exists; false if the program ends before.
  bool waitForFile(const std::filesystem::path& file) {
    const int events = ::inotify_init1(IN_CLOEXEC);
    ::inotify_add_watch(events, file.parent_path().c_str(), IN_CREATE | IN_MOVED_TO);
    while (!std::filesystem::exists(file) && readSome(events)) {}
    ::close(events);
    return std::filesystem::exists(file);
  }
  void signal(int number) const { ::kill(pid_, number); }
  /// Whether the program has ended. Does not reap it: call wait().
  bool ended() const {
    siginfo_t information{};
    return ::waitid(P_PID, static_cast<id_t>(pid_), &information, WEXITED | WNOHANG | WNOWAIT) != 0 || information.si_pid != 0;
  }
  /// Closes the read end of standard output, so that further writes of the program fail with EPIPE.
  void closeOut() {
    if (out_ >= 0) ::close(std::exchange(out_, -1));
  }

  Outcome wait() {
    while (readSome()) {}
    int status = 0;
    while (pid_ > 0 && ::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {}
    pid_ = -1;
    outcome_.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome_;
  }

 private:
  /// Waits until the program writes or closes an output, or `events` is readable. False once both outputs
  /// are closed.
  bool readSome(int events = -1) {
    pollfd ends[3] = {{out_, POLLIN, 0}, {err_, POLLIN, 0}, {events, POLLIN, 0}};  // poll ignores -1
    if (out_ < 0 && err_ < 0) return false;
    if (::poll(ends, 3, -1) < 0) return errno == EINTR;
    if (ends[2].revents != 0) {
      char passed[4096];
      if (::read(events, passed, sizeof passed) < 0 && errno != EINTR) return false;
    }
    const auto take = [](pollfd& end, int& descriptor, std::string& text) {
      if (end.fd < 0 || end.revents == 0) return;
      char buffer[4096];
      const ssize_t count = ::read(descriptor, buffer, sizeof buffer);
      if (count > 0)
        text.append(buffer, static_cast<size_t>(count));
      else
        ::close(std::exchange(descriptor, -1));
    };
    take(ends[0], out_, outcome_.out);
    take(ends[1], err_, outcome_.err);
    return true;
  }

  pid_t pid_ = -1;
  int out_ = -1, err_ = -1;
  Outcome outcome_;
};

/// Runs rill-capture and waits for it.
inline Outcome capture(std::vector<std::string> arguments, const std::string& folder = ".", const Child::Environment& environment = {},
                       const std::string& standardOutput = {}) {
  arguments.insert(arguments.begin(), std::string(RILL_BINARY_DIR) + "/apps/capture/rill-capture");
  return Child(arguments, folder, environment, standardOutput).wait();
}

}  // namespace rill::test
