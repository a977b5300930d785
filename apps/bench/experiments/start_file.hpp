#pragma once
#include <filesystem>

#include "bench/experiments/measures.hpp"
#include "rill/expected.hpp"
#include "shared/temporary_folder.hpp"

namespace rill::bench {

/// A start that no fill can say (a velocity field, a displaced lattice): a PLY file in the system's temporary folder, gone with this
/// object.
class StartFile {
 public:
  /// Io, naming the file.
  static Expected<StartFile> write(const Cloud& cloud);
  Fill fill() const;

 private:
  explicit StartFile(apps::TemporaryFolder folder) : folder_(std::move(folder)) {}
  std::filesystem::path file() const { return folder_.path() / "start.ply"; }
  apps::TemporaryFolder folder_;
};

}  // namespace rill::bench
