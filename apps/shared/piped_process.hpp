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

/// The program of this name in the folders of PATH; nothing where there is none that may be run.
std::optional<std::filesystem::path> findProgram(std::string_view name);

/// A program that runs beside this one and reads what it is fed from its standard input. What it says is kept for messages. It is in a
/// process group of its own: a terminal's Ctrl-C does not reach it, so that it ends when its input does.
class FedProgram {
 public:
  /// No shell is between. Io where it can't be started.
  static Expected<FedProgram> start(const std::filesystem::path& program, std::span<const std::string> arguments);
  FedProgram(FedProgram&& other) noexcept
      : name_(std::move(other.name_)), id_(std::exchange(other.id_, -1)), input_(std::move(other.input_)), said_(std::move(other.said_)) {}
  FedProgram& operator=(FedProgram&&) = delete;
  /// Ends its input and waits for it.
  ~FedProgram();

  /// Waits until all of `bytes` are taken. Io where the program has gone: finish() says why.
  Expected<void> feed(std::span<const std::byte> bytes);
  /// Ends its input and waits for it. Io with its last words where it failed.
  Expected<void> finish();

 private:
  FedProgram(std::string name, pid_t id, Descriptor input, Descriptor said)
      : name_(std::move(name)), id_(id), input_(std::move(input)), said_(std::move(said)) {}
  std::string lastWords() const;

  std::string name_;
  pid_t id_;
  Descriptor input_, said_;
};

}  // namespace rill::apps
