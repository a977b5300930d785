#pragma once
#include <filesystem>

#include "bench/experiments/measures.hpp"
#include "rill/expected.hpp"
#include "shared/temporary_folder.hpp"

namespace rill::bench {

/// Initial particles that fills cannot describe (velocity fields, sloped surfaces): a temporary PLY file, deleted by the destructor.
class StartFile {
 public:
  /// Io with the name of the file.
  static Expected<StartFile> write(const Cloud& cloud);
  Fill fill() const;

 private:
  explicit StartFile(apps::TemporaryFolder folder) : folder_(std::move(folder)) {}
  std::filesystem::path file() const { return folder_.path() / "start.ply"; }
  apps::TemporaryFolder folder_;
};

}  // namespace rill::bench
