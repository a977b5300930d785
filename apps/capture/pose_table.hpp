#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "rill/offline.hpp"

namespace rill::capture {

/// The table of --export poses as CSV (RFC 4180): a row for each solid of each frame.
class PoseTable {
 public:
  explicit PoseTable(const Scene& scene);
  /// Keeps the rows of frames before `frame` of a table that an earlier run wrote; none if the file cannot be read.
  void keep(const std::filesystem::path& file, uint32_t frame);
  /// Adds the rows of a frame.
  Expected<void> add(uint32_t frame, double time_s, offline::Simulation& simulation);
  const std::string& text() const { return text_; }

 private:
  const Scene* scene_;
  std::string text_;
};

}  // namespace rill::capture
