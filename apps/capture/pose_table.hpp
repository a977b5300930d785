#pragma once
#include <cstdint>
#include <string>

#include "rill/offline.hpp"

namespace rill::capture {

/// The table of --export poses as CSV (RFC 4180): a row for each solid of each frame.
class PoseTable {
 public:
  explicit PoseTable(const Scene& scene);
  /// Adds the rows of a frame.
  Expected<void> add(uint32_t frame, double time_s, offline::Simulation& simulation);
  const std::string& text() const { return text_; }

 private:
  const Scene* scene_;
  std::string text_;
};

}  // namespace rill::capture
