#pragma once
// Pictures of particles that come from elsewhere, for example from files, without a simulation (library rill::offline).
//
//   auto player = rill::offline::Player::open(scene);
//   if (!player) return fail(player.error().message);
//   rill::offline::PlayedFrame frame;
//   frame.positions = {{0.1f, 0.2f, 0.1f}, {0.11f, 0.2f, 0.1f}};
//   if (auto ok = player->show(frame); !ok) return fail(ok.error().message);
//   auto image = player->render("final", 1280, 720);  // RGBA, from the top
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rill/offline.hpp"

namespace rill::offline {

/// What Player draws: particles at one time. Vectors may be empty, else they are as long as `positions`.
struct PlayedFrame {
  std::vector<Float3> positions = {};       ///< m, relative to `origin`
  Double3 origin = {0, 0, 0};               ///< m, scene coordinates
  std::vector<Float3> velocities = {};      ///< m/s, for the color of some views and for motion blur
  std::vector<uint8_t> fluids = {};         ///< indices among resolvedFluids(); empty: all 0
  std::vector<Float4> concentrations = {};  ///< as FluidState::concentration; empty: nothing has mixed
  /// At most 2^22, drawn with Look::whitewater where there are positions; none: drops and thin sheets are white.
  std::optional<DiffuseParticles> whitewater = {};
  double time_s = 0;  ///< of moving solids
};

/// Renders given particles with a scene's camera, solids and look. Not thread-safe. Moves as Simulation.
class Player {
 public:
  /// BadInput for a scene without a spacing; other errors as Simulation::open(). Uses Options::device, validation,
  /// orbit_degPerS, exposure_stops and film.
  static Expected<Player> open(Scene scene, const Options& options = {});
  ~Player();
  Player(Player&&) noexcept;
  Player& operator=(Player&&) noexcept;

  /// Sets what to draw. BadInput if the lengths of vectors differ or the scene lacks one of the fluids; TooLarge, OutOfMemory.
  Expected<void> show(const PlayedFrame& frame);
  /// As Simulation::render(). Without fluid before the first show().
  Expected<Image> render(const std::string& view, uint32_t width, uint32_t height);
  Expected<LinearImage> renderLinear(uint32_t width, uint32_t height);                     ///< as Simulation::renderLinear()
  Expected<void> prepareRender(const std::string& view, uint32_t width, uint32_t height);  ///< as Simulation::prepareRender()
  std::string pictureDot() const;                                                          ///< Graphviz graph of the last picture
  uint64_t boundHits() const;                                                              ///< Stats::pictureBoundHits of the last picture

  const Scene& scene() const;
  const DeviceInfo& device() const;
  std::vector<std::string> takeValidationMessages();  ///< as Simulation::takeValidationMessages()

 private:
  class Impl;
  explicit Player(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rill::offline
