#include "render/environment.hpp"

#include <cmath>
#include <cstring>
#include <numbers>

#include "gpu/device_impl.hpp"
#include "render/environment_mips.hpp"
#include "render/environment_sun.hpp"
#include "render/environment_texels.hpp"

namespace rill {
namespace {

/// Irradiance over pi from the upper and from the lower half: the mean radiance, weighted by the cosine to the vertical.
void irradiance(const EnvironmentPicture& picture, Float3& above, Float3& below) {
  double sums[2][3] = {}, weights[2] = {};
  for (uint32_t y = 0; y < picture.height; ++y) {
    const double polar = (y + 0.5) / picture.height * std::numbers::pi, up = std::cos(polar);
    const double weight = std::abs(up) * std::sin(polar);
    const int half = up > 0 ? 0 : 1;
    Double3 row = {};
    for (uint32_t x = 0; x < picture.width; ++x) {
      const Double3 color = unpackTexel(picture.texels[size_t{y} * picture.width + x]);
      for (int c = 0; c < 3; ++c) row[c] += color[c];
    }
    for (int c = 0; c < 3; ++c) sums[half][c] += weight * row[c];
    weights[half] += weight * picture.width;
  }
  const auto mean = [&](int half) {
    // A map of one row has no lower half.
    if (weights[half] <= 0) half = 1 - half;
    return Float3{static_cast<float>(sums[half][0] / weights[half]), static_cast<float>(sums[half][1] / weights[half]),
                  static_cast<float>(sums[half][2] / weights[half])};
  };
  above = mean(0);
  below = mean(1);
}

}  // namespace

Expected<std::unique_ptr<Environment>> Environment::create(Device& device, EnvironmentPicture picture) {
  if (auto fits = checkEnvironmentSize(picture.width, picture.height); !fits)
    return Error{ErrorKind::BadInput, "an environment: " + fits.error().message};
  if (picture.texels.size() != size_t{picture.width} * picture.height)
    return Error{ErrorKind::BadInput, "an environment of " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
                                          " pixels: found " + std::to_string(picture.texels.size()) + " texels"};
  auto out = std::unique_ptr<Environment>(new Environment(implOf(device)));
  out->sun_ = takeSun(picture);
  irradiance(picture, out->above_, out->below_);
  std::vector<uint32_t> levels = environmentLevels(picture);
  out->width_ = 2 * dropFineLevels(levels, picture.height, device.info().maxBufferBytes);
  const uint64_t bytes = levels.size() * sizeof(uint32_t);
  auto texels = createBuffer(device, "environment", bytes, MemoryKind::Device);
  if (!texels) return texels.error();
  auto staging = createBuffer(device, "environment staging", bytes, MemoryKind::Upload);
  if (!staging) return staging.error();
  std::memcpy(staging->mapped(), levels.data(), bytes);
  out->texels_ = *std::move(texels);
  out->staging_ = *std::move(staging);
  return out;
}

BufferRef Environment::addTo(Graph& graph) {
  const DeviceImpl& device = device_;
  if (copied_ && device.abandoned(*copied_)) copied_.reset();
  if (copied_ && *copied_ <= device.clock.completed) staging_ = {};
  BufferRef texels =
      graph.import("environment", {texels_.handle(), 0, texels_.size(), staging_ ? Use::Unknown : Use::CopyTarget, Use::Nothing});
  if (!staging_) return texels;
  const BufferRef from = graph.import("environment staging", {staging_.handle(), 0, staging_.size(), Use::Nothing, Use::Nothing});
  graph.pass("environment upload", [&](Pass& pass) {
    pass.read(from, Use::CopySource);
    texels = pass.write(texels, Use::CopyTarget, true);
    return [this, from, texels](Commands& commands) {
      commands.copy(from, texels, texels_.size());
      if (!copied_) copied_ = device_.clock.recording;
    };
  });
  return texels;
}

}  // namespace rill
