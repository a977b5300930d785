#pragma once
// A simulation without a host (of the library rill::offline): owns a device, runs a scene, hands out arrays. No Vulkan in sight.
//
//   auto run = rill::offline::Simulation::open("dam-break.json");
//   if (!run) return fail(run.error().message);
//   if (auto ok = (*run)->advance(0.5); !ok) return fail(ok.error().message);
//   auto particles = (*run)->particles();  // positions, velocities, densities, numbers at birth
//   auto stats = (*run)->stats();
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rill/expected.hpp"
#include "rill/fluid.hpp"
#include "rill/scene_io.hpp"

namespace rill::offline {

/// Settings of a simulation that are no part of its scene.
struct Options {
  double orbit_deg_per_s = 0;            ///< pictures: how fast the camera goes around its target, counter-clockwise from above
  std::string device = {};               ///< part of a name, or an index; empty: the best there is
  std::vector<Override> overrides = {};  ///< applied to the scene
  bool validation = false;               ///< with the validation layer, synchronization included; needs it installed
  bool passTimes = false;                ///< with Stats::pass_ms; its time stamps cost a tenth to a fifth of a run on lavapipe
  uint32_t substepsPerSubmit = 0;        ///< 0: chosen; bits never depend on it
  double longestFrame_s = 1.0 / 60;      ///< s; a longer advance() is made of equal frames, each with the scene's max_substeps of its own
};

/// The order in which particles are read back.
enum class Order { AsStored, ById };

/// Particles as read back from the device.
struct Particles {
  std::vector<Float3> positions = {};   ///< m, in the scene's coordinates (origin added)
  std::vector<Float3> velocities = {};  ///< m/s
  std::vector<float> densities = {};    ///< kg/m^3
  std::vector<uint32_t> ids = {};       ///< numbers at birth: the order of the scene's fills
};

/// An image in memory: RGBA, 8 bits a channel, sRGB, rows from the top.
struct Image {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba = {};
};

/// Runs and time of one pass of the graph.
struct PassTime {
  std::string name = {};
  double ms = 0;      ///< 0 without Options::passTimes
  uint32_t runs = 0;  ///< times recorded
  uint32_t ran = 0;   ///< of those: the device leaves out substeps and rebuilds that are not due, which then cost an empty dispatch
};
using SkippedPass = std::pair<std::string, std::string>;  ///< and the reason

/// A table for people: what was recorded, how often it ran and the time it took, then what was skipped and why.
std::string passTable(std::span<const PassTime> passes, std::span<const SkippedPass> skipped);

/// What the transients of one kind of frame take on the device.
struct FrameMemory {
  std::string frame = {};
  std::vector<TransientHeap> heaps = {};
};

/// A table for people: each heap's bytes with and without aliasing.
std::string memoryTable(std::span<const FrameMemory> frames);

/// Everything `rill-capture --stats` writes about an instant.
struct Stats : FluidStats {
  double front_m = 0;                                       ///< farthest fluid along +x from the domain's minimum
  uint64_t state_hash = 0;                                  ///< of positions and velocities in id order
  std::vector<std::pair<std::string, double>> probes = {};  ///< name and value, m
  uint64_t picture_bound_hits = 0;     ///< times that loops of the renderer's shaders ran into their bound, in pictures of it
  double wall_s = 0;                   ///< spent since the instant before, simulation alone
  std::vector<PassTime> pass_ms = {};  ///< what was recorded
  std::vector<SkippedPass> skipped = {};
};

/// A simulation between two advances: a run that goes on from it has the bits of one that was never interrupted, on the same driver.
struct Checkpoint {
  std::string rill = {};                                       ///< version that wrote it
  std::string scene = {};                                      ///< its name
  std::string device, driver;                                  ///< as in DeviceInfo
  double time_s = 0;                                           ///< simulated
  uint64_t frame = 0;                                          ///< for the caller: where in a sequence of frames this is,
  double fps = 0;                                              ///< and how many of them make a second; 0: in none
  std::vector<std::pair<std::string, std::string>> keys = {};  ///< what of the scene decides the simulation; another scene's is refused
  FluidSnapshot fluid = {};
  friend bool operator==(const Checkpoint&, const Checkpoint&) = default;
};

/// The bytes of a checkpoint's file: versioned, with a checksum (the format is described in engine/offline/checkpoint.cpp).
std::vector<std::byte> encodeCheckpoint(const Checkpoint& checkpoint);
/// `name` stands for the file in messages. BadInput for bytes that are no checkpoint, of a newer format, cut short, or changed anywhere.
Expected<Checkpoint> decodeCheckpoint(std::span<const std::byte> bytes, std::string_view name);
/// The same from a file. OutOfMemory, too.
Expected<Checkpoint> loadCheckpoint(const std::filesystem::path& file);

/// One scene on a device of its own. Not for several threads at once.
class Simulation {
 public:
  /// `scene` is a path to a scene file. BadInput, NoDevice, TooLarge (with bytes needed and available), OutOfMemory.
  static Expected<std::unique_ptr<Simulation>> open(const std::filesystem::path& scene, const Options& options = {});
  /// A scene that was read before, with its overrides applied (those of `options` are not). The scene is judged before a device is opened.
  static Expected<std::unique_ptr<Simulation>> open(Scene scene, const Options& options = {});
  /// With particles of the caller's own in place of the scene's fills, taken as they are: they may overlap, lie outside, or not be numbers.
  /// `fluid.spacing` is given. BadInput for as many velocities as there are not positions, or no spacing.
  static Expected<std::unique_ptr<Simulation>> open(Scene scene, ParticleSet start, const Options& options = {});
  /// Goes on from a checkpoint of the same scene. BadInput, naming the first key that differs, for one of another scene, judged before a
  /// device is opened; a device, a driver or a Rill other than the checkpoint's is among warnings(). Other errors as open().
  static Expected<std::unique_ptr<Simulation>> resume(Scene scene, const Checkpoint& checkpoint, const Options& options = {});
  ~Simulation();

  /// Runs `seconds` of simulated time on (>= 0), waits for it. One advance of the solver up to Options::longestFrame_s: substeps divide it
  /// evenly at its end. Figures of an advance (substeps, time dropped) are added up over the frames of a longer one. BadInput for a time
  /// that is not finite or negative; DeviceLost, OutOfMemory or Failed, saying what was being done.
  Expected<void> advance(double seconds);
  double time() const;  ///< s
  /// Of the present instant. Errors as advance().
  Expected<Particles> particles(Order order = Order::ById);
  Expected<Stats> stats();  ///< of the present instant, measured when first asked for; errors as advance()
  /// Of the present instant; no later bit depends on whether one was taken. Errors as advance().
  Expected<Checkpoint> checkpoint(uint64_t frame = 0, double fps = 0);
  /// Renders the present instant. `view` is one of views(); sizes in pixels. BadInput for another view or a size that the device cannot
  /// draw.
  Expected<Image> render(const std::string& view, uint32_t width, uint32_t height);
  /// What render() needs before the first picture: BadInput already here for what it would refuse, the environment's file among it.
  Expected<void> prepareRender(const std::string& view, uint32_t width, uint32_t height);
  static std::span<const std::string_view> views();
  /// BadInput where render() would refuse this view or size. Needs no device.
  static Expected<void> checkPicture(const std::string& view, uint32_t width, uint32_t height);

  const Scene& scene() const;
  const ParticleSet& start() const;  ///< as placed: counts of particles left out
  const DeviceInfo& device() const;
  std::vector<std::string> warnings() const;
  std::string explain() const;                        ///< each pass of the last advance: ran, how often, ms; or skipped and why
  std::vector<FrameMemory> transientMemory() const;   ///< of the last frame of each kind: advance, measure, picture
  std::string graphDot() const;                       ///< of the last advance
  std::string pictureDot() const;                     ///< of the last picture
  std::vector<std::string> takeValidationMessages();  ///< since the last call; none without Options::validation

 private:
  class Impl;
  static Expected<std::unique_ptr<Simulation>> make(Scene scene, std::optional<ParticleSet> start, const Options& options,
                                                    const Checkpoint* from);
  explicit Simulation(std::unique_ptr<Impl>);
  std::unique_ptr<Impl> impl_;
};

/// Pictures of particles that somebody else simulated, with a scene's camera, solids and look. Not for several threads at once.
class Player {
 public:
  /// BadInput for a scene without a spacing; errors as Simulation::open(). Of `options` the device and validation count.
  static Expected<std::unique_ptr<Player>> open(Scene scene, const Options& options = {});
  ~Player();

  /// What is drawn from now on: positions in m, relative to `origin`; velocities in m/s (they color the view `particles`), or none at all.
  /// `time_s`: where moving solids are. BadInput for as many velocities as there are not positions, TooLarge, OutOfMemory.
  Expected<void> show(const std::vector<Float3>& positions, const double origin[3], const std::vector<Float3>& velocities = {},
                      double time_s = 0);
  /// As Simulation::render(); before the first show() a scene without fluid.
  Expected<Image> render(const std::string& view, uint32_t width, uint32_t height);
  Expected<void> prepareRender(const std::string& view, uint32_t width, uint32_t height);  ///< as Simulation::prepareRender()
  std::string pictureDot() const;                                                          ///< passes of the last picture
  uint64_t boundHits() const;  ///< as Stats::picture_bound_hits, of the last picture

  const Scene& scene() const;
  const DeviceInfo& device() const;
  std::vector<std::string> takeValidationMessages();

 private:
  class Impl;
  explicit Player(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rill::offline
