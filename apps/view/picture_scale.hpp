#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace rill::view {

/// Resolution scale of the image: where rendering is slow, the image is rendered smaller and stretched, as long as that
/// saves time (the cost per particle does not depend on the resolution).
class PictureScale {
 public:
  /// Adds the device time of an image at the current scale.
  void addImage(double seconds);
  double scale() const { return kScales[level_]; }  ///< image over window resolution, per side
  void restart() { *this = {}; }

 private:
  static constexpr std::array kScales{1.0, 0.75, 0.5, 0.375};

  void setLevel(size_t level);

  size_t level_ = 0;
  uint32_t ignored_ = 2;                         // images to ignore: the first ones compile shaders and allocate memory
  uint32_t fastInRow_ = 0;                       // consecutive images that are fast enough for the next finer level
  uint32_t age_ = 0;                             // images since the times of all levels were reset
  std::array<double, kScales.size()> took_s_{};  // recent time by level; 0: unknown
};

}  // namespace rill::view
