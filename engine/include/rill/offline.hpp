#pragma once
// Simulation without a host application (library rill::offline): opens a device, runs a scene and returns arrays. Needs no Vulkan code.
//
//   auto run = rill::offline::Simulation::open("dam-break.json");
//   if (!run) return fail(run.error().message);
//   if (auto ok = run->advance(0.5); !ok) return fail(ok.error().message);
//   auto particles = run->particles();  // positions, velocities, densities, ids
//   auto stats = run->stats();
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
#include <variant>
#include <vector>

#include "rill/expected.hpp"
#include "rill/fluid.hpp"
#include "rill/scene_io.hpp"
#include "rill/snapshot.hpp"
#include "rill/whitewater.hpp"

namespace rill::offline {

/// Limit of Options::exposure_stops, in both directions.
inline constexpr double kMaxExposure_stops = 10;

inline constexpr uint32_t kMaxFilmSamples = 256;  ///< limit of Film::samples
inline constexpr uint32_t kFilmSamples = 32;      ///< default with an effect
inline constexpr double kMaxShutter_s = 1000;     ///< limit of Film::shutter_s
inline constexpr double kMinAperture = 0.5;       ///< least Film::aperture
inline constexpr double kMaxAperture = 64;        ///< largest Film::aperture
inline constexpr double kMinFocus_m = 1e-3;       ///< least Film::focus_m
inline constexpr double kMaxFocus_m = 1e6;        ///< largest Film::focus_m

/// Effects of a camera on the view `final`: the mean of several pictures in linear light. They do not affect the simulation.
struct Film {
  uint32_t samples = 0;  ///< pictures, each at another point of the pixels, 1 (no effect) to 256; 0: 32 with an effect below, else 1
  /// Time that the shutter is open, half before and half after that of the picture, s, 0 (an instant) to 1000. Particles and bodies move
  /// by their velocities, solids with keyframes and the camera as they do.
  double shutter_s = 0;
  double aperture = 0;  ///< f-number of a lens before a sensor 24 mm high, 0.5 to 64; 0: a pinhole, with which all is sharp
  double focus_m = 0;   ///< distance along the view direction that is sharp, 0.001 to 1e6; 0: that of the camera's target
};

/// Options of Simulation and Player.
struct Options {
  double orbit_degPerS = 0;                  ///< angular speed of the camera around its target, counter-clockwise seen from above
  double exposure_stops = 0;                 ///< of the view `final`: each stop doubles the light before the tone curve; -10 to 10
  Film film = {};                            ///< super-sampling, motion blur, depth of field
  std::string device = {};                   ///< a name, a part that no other has, or an index; empty: the most capable device
  std::string deviceOrigin = {};             ///< what messages about `device` begin with, such as the user's option; may be empty
  std::vector<Override> overrides = {};      ///< applied to the scene
  bool validation = false;                   ///< enable the validation layer with synchronization validation; it must be installed
  bool passTimes = false;                    ///< measure Stats::passes; costs time, on CPU drivers up to a fifth of the run
  uint32_t substepsPerSubmit = 0;            ///< 0: automatic; results do not depend on it
  std::filesystem::path pipelineCache = {};  ///< folder of a file with what the driver has compiled, for the next run; empty: none is kept
  ArrayReads reads = ArrayReads::Auto;       ///< results do not depend on it
  double longestFrame_s = 1.0 / 60;          ///< s, >= 1e-6; longer advances are split into equal frames, each with max_substeps
};

/// Order of particles in arrays: that of the device, or by id.
enum class Order { AsStored, ById };

/// Particles at one time.
struct Particles {
  std::vector<Float3> positions = {};   ///< m, scene coordinates
  std::vector<Float3> velocities = {};  ///< m/s
  std::vector<float> densities = {};    ///< kg/m^3
  std::vector<uint32_t> ids = {};       ///< index in the initial particles: the order of the fills
  std::vector<uint8_t> fluids = {};     ///< index among the scene's fluids; empty in a scene without `fluids`
  /// The share of each of diffusingFluids() in each particle, 0 to 1 but for rounding, one after the other; empty if none diffuses.
  std::vector<std::vector<float>> concentrations = {};
  std::vector<size_t> diffusing = {};  ///< their indices among the scene's fluids
};

/// The diffuse particles of whitewater at one time, in the order of the device.
struct DiffuseParticles {
  std::vector<Float3> positions = {};   ///< m, scene coordinates
  std::vector<Float3> velocities = {};  ///< m/s
  std::vector<float> ages = {};         ///< s, as foam or spray; bubbles age at a quarter of the rate
  std::vector<WhitewaterClass> classes = {};
  std::vector<uint32_t> randoms = {};  ///< below 2^24: pictures take sizes from them. None at all: all have the mean size
};

/// The surface of the fluid at one time as a closed triangle mesh; see rill/surface_mesher.hpp.
struct SurfaceTriangles {
  std::vector<Float3> positions = {};   ///< of vertices, m, scene coordinates
  std::vector<Float3> normals = {};     ///< of vertices, unit length, out of the fluid
  std::vector<Float3> velocities = {};  ///< of vertices, m/s
  std::vector<uint32_t> indices = {};   ///< of vertices, three a triangle, counter-clockwise seen from outside
  uint64_t tooFar = 0;                  ///< particles left out because they are too far from the others
  uint64_t boundHits = 0;               ///< sums over particles that were cut off: too many lie at one place
};

/// An image: RGBA, 8 bits per channel, sRGB, top row first.
struct Image {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba = {};
};

/// An image in linear light, before exposure and tone curve: RGBA of IEEE half floats (binary16), top row first. Antialiased
/// by Options::film alone.
struct LinearImage {
  uint32_t width = 0, height = 0;
  std::vector<uint16_t> rgba = {};
};

/// Executions and time of a pass.
struct PassTime {
  std::string name = {};
  double ms = 0;          ///< 0 without Options::passTimes
  uint32_t recorded = 0;  ///< number of times
  uint32_t executed = 0;  ///< number of times; the device skips the others, which are empty dispatches
};
using SkippedPass = std::pair<std::string, std::string>;  ///< name of a pass and the reason why it was skipped

/// A text table of passes: recorded, executed, time; then the skipped passes with reasons.
std::string passTable(std::span<const PassTime> passes, std::span<const SkippedPass> skipped);

/// A line of text that says how kernels read arrays on this device, and why.
std::string readsText(const DeviceInfo& device);

/// Temporary device memory of a kind of frame.
struct FrameMemory {
  std::string frame = {};
  std::vector<TransientHeap> heaps = {};
};

/// A text table of the heaps with and without aliasing.
std::string memoryTable(std::span<const FrameMemory> frames);

/// Value of a probe of a load: of the fluid on a solid, mean over the last advance(); zeros before the first.
struct LoadValue {
  Double3 force = {0, 0, 0};   ///< N
  Double3 torque = {0, 0, 0};  ///< N m, about the solid's center
};

/// Where a solid is and how it moves, in the scene. Probes of poses: by its center (of a mesh: its origin, of a body: its center of mass).
struct PoseValue {
  Double3 position = {0, 0, 0};         ///< m; of what, its function says
  Quaternion rotation = {0, 0, 0, 1};   ///< unit quaternion x y z w, from the solid's frame to the scene's
  Double3 velocity = {0, 0, 0};         ///< m/s
  Double3 angularVelocity = {0, 0, 0};  ///< rad/s
};

/// Value of a probe of a pressure: mean over the last advance(); 0 before the first.
struct PressureValue {
  double pressure = 0;  ///< Pa, over that of the air, >= 0; NaN inside a solid
};

/// Value of a probe of a flow: of the fluid through an emitter or a drain.
struct FlowValue {
  double flow = 0;    ///< m^3/s, mean over the last advance(); 0 before the first
  double volume = 0;  ///< m^3, since the start
};

/// A length (m) of a level or a front, or one of the above.
using ProbeValue = std::variant<double, LoadValue, PoseValue, PressureValue, FlowValue>;

/// Statistics at one time, as written by `rill-capture --stats`.
struct Stats : FluidStats {
  double front_m = 0;                                           ///< farthest fluid along +x, relative to the domain's minimum, m
  uint64_t stateHash = 0;                                       ///< FNV-1a of positions and velocities in id order, bodies, fluids
  std::vector<std::pair<std::string, ProbeValue>> probes = {};  ///< name and value
  std::optional<WhitewaterStats> whitewater = {};               ///< with Look::whitewater
  uint64_t pictureBoundHits = 0;      ///< times that shader loops of the renderer reached their limit in pictures at this time
  double wall_s = 0;                  ///< wall-clock time of the last advance()
  std::vector<PassTime> passes = {};  ///< recorded passes of the last advance
  std::vector<SkippedPass> skipped = {};
};

/// A simulation between two advances. A run resumed from it is bitwise identical to an uninterrupted run on the same driver.
struct Checkpoint {
  std::string rill = {};                                       ///< Rill version that wrote it
  std::string scene = {};                                      ///< name of the scene
  std::string device, driver;                                  ///< as in DeviceInfo
  double time_s = 0;                                           ///< simulated time
  uint64_t frame = 0;                                          ///< for the caller: index in a sequence of frames
  double fps = 0;                                              ///< for the caller: frames per second; 0: no sequence
  std::vector<std::pair<std::string, std::string>> keys = {};  ///< scene keys that affect the simulation; resume() requires them to match
  FluidSnapshot fluid = {};
  WhitewaterSnapshot whitewater = {};  ///< empty without Look::whitewater
  friend bool operator==(const Checkpoint&, const Checkpoint&) = default;
};

/// Encodes a checkpoint file, with version and checksum (format: engine/offline/checkpoint.cpp).
std::vector<std::byte> encodeCheckpoint(const Checkpoint& checkpoint);
/// Decodes a checkpoint file. `name` is the file name in messages. BadInput for other data, another format version, and truncated or
/// corrupted files.
Expected<Checkpoint> decodeCheckpoint(std::span<const std::byte> bytes, std::string_view name);
/// Loads a checkpoint file. BadInput as decodeCheckpoint(); OutOfMemory.
Expected<Checkpoint> loadCheckpoint(const std::filesystem::path& file);

/// A simulation of one scene on its own device. Not thread-safe. A moved-from one may only be destroyed or assigned to.
class Simulation {
 public:
  /// Opens a scene file. BadInput, NoDevice, TooLarge (naming bytes needed and available), OutOfMemory.
  static Expected<Simulation> open(const std::filesystem::path& scene, const Options& options = {});
  /// Opens a loaded scene; Options::overrides are not applied. The scene is validated before a device is opened.
  static Expected<Simulation> open(Scene scene, const Options& options = {});
  /// Opens a scene with the given particles instead of its fills. They are not checked: they may overlap, be outside or not finite.
  /// BadInput without `fluid.spacing`, or if the numbers of positions and velocities differ.
  static Expected<Simulation> open(Scene scene, ParticleSet start, const Options& options = {});
  /// Continues from a checkpoint of the same scene. BadInput, naming the first key that differs, for another scene; checked before a
  /// device is opened. Another device, driver or Rill version adds to warnings(). Other errors as open().
  static Expected<Simulation> resume(Scene scene, const Checkpoint& checkpoint, const Options& options = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Advances by `seconds` of simulated time (finite, >= 0) and waits for the device. Longer times are split into frames of at most
  /// Options::longestFrame_s; statistics of the advance are summed over them. BadInput for an invalid time; DeviceLost, OutOfMemory or
  /// Failed, naming the operation.
  Expected<void> advance(double seconds);
  double time() const;  ///< simulated time, s
  /// The particles at the current time. Errors as advance().
  Expected<Particles> particles(Order order = Order::ById);
  /// The surface of the fluid at the current time. `cell`: side of the grid's cells in spacings, 0.25 to 1. BadInput for another one;
  /// TooLarge for a mesh that the device has no room for; other errors as advance().
  Expected<SurfaceTriangles> mesh(double cell = 0.5);
  /// Foam, spray and bubbles at the current time; none without Look::whitewater. Errors as advance().
  Expected<DiffuseParticles> whitewater();
  /// Where each solid of the scene is at the current time: its center, or a mesh's origin. Errors as advance().
  Expected<std::vector<PoseValue>> poses();
  Expected<Stats> stats();  ///< statistics at the current time, measured at the first call; errors as advance()
  /// A checkpoint at the current time. Does not affect later results. Errors as advance().
  Expected<Checkpoint> checkpoint(uint64_t frame = 0, double fps = 0);
  /// Renders the current time. `view`: one of views(). `width`, `height`: pixels. BadInput for another view or an unsupported size.
  Expected<Image> render(const std::string& view, uint32_t width, uint32_t height);
  /// The view `final` in linear light. Errors as render().
  Expected<LinearImage> renderLinear(uint32_t width, uint32_t height);
  /// Creates what render() needs, so that its BadInput errors, such as an invalid environment map, are found early. Optional.
  Expected<void> prepareRender(const std::string& view, uint32_t width, uint32_t height);
  static std::span<const std::string_view> views();  ///< names of the views
  /// BadInput if render() would reject this view or size. Needs no device.
  static Expected<void> checkPicture(const std::string& view, uint32_t width, uint32_t height);

  const Scene& scene() const;
  const ParticleSet& start() const;  ///< the initial particles, with the numbers left out
  const DeviceInfo& device() const;
  std::vector<std::string> warnings() const;
  std::string explain() const;                        ///< passTable() and memoryTable() of the last advance, and readsText()
  std::vector<FrameMemory> transientMemory() const;   ///< of the last frame of each kind: advance, measure, picture
  std::string graphDot() const;                       ///< Graphviz graph of the last advance
  std::string pictureDot() const;                     ///< Graphviz graph of the last picture
  std::vector<std::string> takeValidationMessages();  ///< new messages since the last call; empty without Options::validation

 private:
  class Impl;
  static Expected<Simulation> make(Scene scene, std::optional<ParticleSet> start, const Options& options, const Checkpoint* from);
  explicit Simulation(std::unique_ptr<Impl>);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rill::offline
