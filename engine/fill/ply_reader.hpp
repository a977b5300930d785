#pragma once
// Particles from a PLY file: ascii or binary of either byte order. x y z, and vx vy vz where it has them; all else is skipped.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "rill/expected.hpp"
#include "rill/float3.hpp"

namespace rill {

struct Double3 {
  double x = 0, y = 0, z = 0;
};

struct PlyParticles {
  std::vector<Double3> positions;  ///< m
  std::vector<Float3> velocities;  ///< m/s; empty where the file has none
};

/// A PLY file whose header was read and found to fit the file's size: a count can be trusted before memory is asked for.
class PlyFile {
 public:
  /// BadInput naming the file, what was found and what was expected.
  static Expected<PlyFile> open(const std::filesystem::path& file);
  PlyFile(PlyFile&&) noexcept;
  PlyFile& operator=(PlyFile&&) noexcept;
  ~PlyFile();

  uint64_t count() const;
  /// Every position and velocity is finite and fits a 32-bit float.
  Expected<PlyParticles> read() const;

 private:
  struct Header;
  explicit PlyFile(std::unique_ptr<Header> header);
  std::unique_ptr<Header> header_;
};

}  // namespace rill
