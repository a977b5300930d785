#pragma once
#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rill/expected.hpp"
#include "shared/descriptor.hpp"

namespace rill::apps {

/// Finds an executable file of this name in the folders of PATH.
std::optional<std::filesystem::path> findProgram(std::string_view name);

/// A child process whose standard input is written by this one. Its output is kept for error messages. It runs in a
/// process group of its own, so that Ctrl-C in a terminal does not end it before its input ends.
class PipedProcess {
 public:
  /// Starts the program without a shell. Io where that fails.
  static Expected<PipedProcess> start(const std::filesystem::path& program, std::span<const std::string> arguments);
  PipedProcess(PipedProcess&& other) noexcept
      : name_(std::move(other.name_)), id_(std::exchange(other.id_, -1)), input_(std::move(other.input_)), log_(std::move(other.log_)) {}
  PipedProcess& operator=(PipedProcess&&) = delete;
  /// Closes its standard input and waits for it to exit.
  ~PipedProcess();

  /// Blocks until all of `bytes` are written. Io where the process has exited; finish() returns the reason.
  Expected<void> write(std::span<const std::byte> bytes);
  /// Closes its standard input and waits for it to exit. Io with the end of its output where it failed.
  Expected<void> finish();

 private:
  PipedProcess(std::string name, pid_t id, Descriptor input, Descriptor log)
      : name_(std::move(name)), id_(id), input_(std::move(input)), log_(std::move(log)) {}
  std::string lastOutput() const;

  std::string name_;
  pid_t id_;
  Descriptor input_, log_;
};

}  // namespace rill::apps
