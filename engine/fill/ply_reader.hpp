#pragma once
// Reads particles from PLY files, ASCII or binary of either byte order: x y z, and vx vy vz, fluid and concentrations if present. Other
// properties are skipped.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "rill/expected.hpp"
#include "rill/vectors.hpp"

namespace rill {

struct PlyParticles {
  std::vector<Double3> positions;  ///< m
  std::vector<Float3> velocities;  ///< m/s; empty if the file has none
  std::vector<uint8_t> fluids;     ///< index of each particle's fluid; empty if the file has none, or they are not read
  /// Of the fluids that were asked for; one that the file lacks has not mixed. Empty if it lacks all, or they are not read.
  std::vector<Float4> concentrations = {};
};

/// A PLY file with a valid header whose counts fit the size of the file, so that memory may be allocated by them.
class PlyFile {
 public:
  /// `fluids`: number of fluids that the property `fluid` may index; 0: the property is skipped. `diffusing`: indices of those whose
  /// concentration is read, at most kMaxDiffusing. BadInput naming the file, what was found and what was expected.
  static Expected<PlyFile> open(const std::filesystem::path& file, size_t fluids = 0, std::span<const size_t> diffusing = {});
  PlyFile(PlyFile&&) noexcept;
  PlyFile& operator=(PlyFile&&) noexcept;
  ~PlyFile();

  uint64_t count() const;  ///< of vertices
  /// Every position (m) and velocity (m/s) is finite and fits a 32-bit float, concentrations are within 0 .. 1, and every fluid exists.
  /// BadInput naming the vertex otherwise.
  Expected<PlyParticles> read() const;

 private:
  struct Header;
  explicit PlyFile(std::unique_ptr<Header> header);
  std::unique_ptr<Header> header_;
};

}  // namespace rill
