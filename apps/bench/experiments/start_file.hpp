#pragma once
#include <filesystem>

#include "bench/experiments/measures.hpp"
#include "rill/expected.hpp"

namespace rill::bench {

/// A start that no fill can say (a velocity field, a displaced lattice): a PLY file in the system's temporary folder, gone with this
/// object.
class StartFile {
 public:
  /// Io, naming the file.
  static Expected<StartFile> write(const Cloud& cloud);
  StartFile(StartFile&& other) noexcept;
  StartFile& operator=(StartFile&&) = delete;
  ~StartFile();
  Fill fill() const;

 private:
  explicit StartFile(std::filesystem::path folder) : folder_(std::move(folder)) {}
  std::filesystem::path file() const { return folder_ / "start.ply"; }
  std::filesystem::path folder_;
};

}  // namespace rill::bench
