// Renders given particles.
#include "rill/player.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>

#include "gpu/resources.hpp"
#include "offline/guarded.hpp"
#include "offline/open_context.hpp"
#include "offline/painter.hpp"
#include "offline/picture_run.hpp"
#include "offline/whitewater_run.hpp"

namespace rill::offline {

constexpr size_t kMaxPlayedWhitewater = size_t{1} << 22;  // as WhitewaterDesc::room

class Player::Impl {
 public:
  Impl(Scene scene, const Options& options) : scene_(std::move(scene)), painter_(scene_, start_, options) {}

  Expected<void> open(const Options& options) {
    if (auto valid = Painter::checkOptions(options); !valid) return valid;
    auto start = makeParticles(scene_);
    if (!start) return start.error();
    start_ = std::move(*start);
    scene_.fluid.spacing = start_.spacing;
    if (!(scene_.fluid.spacing > 0))
      return Error{ErrorKind::BadInput,
                   "fluid.spacing: not given, and no fill to compute it from fluid.particles; expected a number above 0 (m)"};
    auto context = openContext(options, 1);
    if (!context) return context.error();
    context_ = std::move(*context);
    return {};
  }

  Expected<void> show(const PlayedFrame& frame) {
    if (auto valid = check(frame); !valid) return valid;
    count_ = static_cast<uint32_t>(frame.positions.size());
    time_s_ = frame.time_s;
    origin_ = frame.origin;
    pictures_.contentChanged();
    mixes_ = !frame.concentrations.empty();
    foams_ = scene_.look.whitewater && frame.whitewater.has_value();
    if (count_ == 0) return {};
    if (mixes_)
      if (auto set = upload(concentration_, frame.concentrations); !set) return set;
    if (foams_)
      if (auto set = setWhitewater(*frame.whitewater); !set) return set;
    const auto fluidOf = [&](size_t i) { return frame.fluids.empty() ? 0.0f : static_cast<float>(frame.fluids[i]); };
    std::vector<Float4> records(count_);
    for (size_t i = 0; i < count_; ++i) records[i] = withW(frame.positions[i], fluidOf(i));
    if (auto set = upload(position_, records); !set) return set;
    for (size_t i = 0; i < count_; ++i) records[i] = withW(frame.velocities.empty() ? Float3{} : frame.velocities[i], 1);
    return upload(velocity_, records);
  }

  Expected<void> prepareRender(std::string_view view, uint32_t width, uint32_t height) {
    return painter_.prepare(context_->device(), view, width, height);
  }
  Expected<Image> render(std::string_view view, uint32_t width, uint32_t height) {
    Image image{width, height, {}};
    if (auto drawn = draw(view, image.rgba, width, height, PixelKind::Display); !drawn) return drawn.error();
    painter_.finish(image, view, time_s_);
    return image;
  }
  Expected<LinearImage> renderLinear(uint32_t width, uint32_t height) {
    LinearImage image{width, height, {}};
    if (auto drawn = draw("final", image.rgba, width, height, PixelKind::Linear); !drawn) return drawn.error();
    return image;
  }

  std::string pictureDot() const { return pictures_.graph().dot(); }
  uint64_t boundHits() const { return pictures_.boundHits(); }
  const DeviceInfo& device() const { return context_->device().info(); }
  std::vector<std::string> takeMessages() { return context_->takeMessages(); }
  const Scene& scene() const { return scene_; }

 private:
  static Float4 withW(const Float3& v, float w) { return {v.x, v.y, v.z, w}; }

  Expected<void> check(const PlayedFrame& frame) const {
    const size_t count = frame.positions.size();
    if (count > kMaxParticles)
      return Error{ErrorKind::TooLarge, std::to_string(count) + " particles; expected at most " + std::to_string(kMaxParticles)};
    const auto fits = [&](size_t found, const char* what) -> Expected<void> {
      if (found == 0 || found == count) return {};
      return Error{ErrorKind::BadInput,
                   "found " + std::to_string(found) + " " + what + " for " + std::to_string(count) + " positions, expected equal numbers"};
    };
    if (auto ok = fits(frame.velocities.size(), "velocities"); !ok) return ok;
    if (auto ok = fits(frame.fluids.size(), "fluids"); !ok) return ok;
    if (auto ok = fits(frame.concentrations.size(), "concentrations"); !ok) return ok;
    const size_t known = std::max<size_t>(scene_.fluids.size(), 1);
    if (const auto wrong = std::ranges::find_if(frame.fluids, [&](uint8_t fluid) { return fluid >= known; }); wrong != frame.fluids.end())
      return Error{ErrorKind::BadInput, "found fluid " + std::to_string(*wrong) + " of a particle, expected an index below " +
                                            std::to_string(known) + ", the number of the scene's fluids"};
    return frame.whitewater ? checkWhitewater(*frame.whitewater) : Expected<void>();
  }

  static Expected<void> checkWhitewater(const DiffuseParticles& white) {
    const size_t count = white.positions.size();
    if (count > kMaxPlayedWhitewater)
      return Error{ErrorKind::TooLarge,
                   std::to_string(count) + " particles of whitewater; expected at most " + std::to_string(kMaxPlayedWhitewater)};
    const bool randoms = white.randoms.empty() || white.randoms.size() == count;
    if (white.velocities.size() == count && white.classes.size() == count && white.ages.size() == count && randoms) return {};
    return Error{ErrorKind::BadInput, "found " + std::to_string(count) + " positions, " + std::to_string(white.velocities.size()) +
                                          " velocities, " + std::to_string(white.ages.size()) + " ages, " +
                                          std::to_string(white.classes.size()) + " classes and " + std::to_string(white.randoms.size()) +
                                          " random numbers of whitewater, expected equal numbers, or no random numbers"};
  }

  Expected<void> setWhitewater(const DiffuseParticles& white) {
    const WhitewaterSnapshot state = whitewaterSnapshot(white, origin_);
    whiteRoom_ = static_cast<uint32_t>(state.place.size());
    if (auto set = upload(whitePlace_, state.place); !set) return set;
    if (auto set = upload(whiteMotion_, state.motion); !set) return set;
    return upload(whiteCounts_, state.counts);
  }

  /// Makes room where it is missing.
  template <class Record>
  Expected<void> upload(Buffer& buffer, const std::vector<Record>& records) {
    const uint64_t bytes = std::max<uint64_t>(records.size(), 1) * sizeof(Record);
    if (buffer.size() < bytes) {
      auto made = createBuffer(context_->device(), "played particles", bytes, MemoryKind::Upload);
      if (!made) return made.error();
      buffer = std::move(*made);
    }
    if (!records.empty()) std::memcpy(buffer.mapped(), records.data(), records.size() * sizeof(Record));
    return {};
  }

  template <class T>
  Expected<void> draw(std::string_view view, std::vector<T>& rgba, uint32_t width, uint32_t height, PixelKind kind) {
    if (auto ready = prepareRender(view, width, height); !ready) return ready.error();
    const PictureRun::Source source{
        .time_s = time_s_,
        .content = [&](Graph& graph) { return PictureRun::Content{.fluid = drawn(graph), .white = drawnWhitewater(graph)}; },
        .run = [&](Graph& graph, const auto& declare) { return run(graph, declare); }};
    return pictures_.draw(painter_, source, view, width, height, kind, rgba);
  }

  FluidState drawn(Graph& graph) {
    FluidState fluid;
    fluid.capacity = count_;
    fluid.spacing = static_cast<float>(scene_.fluid.spacing);
    fluid.origin = origin_;
    if (count_ > 0) {
      fluid.position = staged(graph, "played positions", position_);
      fluid.velocity = staged(graph, "played velocities", velocity_);
      if (mixes_) fluid.concentration = staged(graph, "played concentrations", concentration_);
    }
    return fluid;
  }

  DrawnWhitewater drawnWhitewater(Graph& graph) {
    if (!foams_ || count_ == 0) return {};
    const auto capacity = std::max(count_, static_cast<uint32_t>(capacityOf(scene_, start_.positions.size())));
    return {.state = {.place = staged(graph, "played places of whitewater", whitePlace_),
                      .motion = staged(graph, "played motions of whitewater", whiteMotion_),
                      .counts = staged(graph, "played counts of whitewater", whiteCounts_),
                      .room = std::max(whiteRoom_, 1u)},
            .size = drawnRadius(whitewaterOf(scene_, start_, capacity))};
  }

  Expected<void> run(Graph& graph, const std::function<void(Graph&)>& declare) {
    graph.reset();
    declare(graph);
    if (auto ran = context_->run(graph); !ran) return ran;
    return context_->wait();
  }

  /// A copy of the particles in the device's memory: passes read them many times.
  BufferRef staged(Graph& graph, std::string_view name, const Buffer& buffer) {
    const BufferRef host = graph.import("played particles", {buffer.handle(), 0, buffer.size(), Use::Nothing, Use::Nothing});
    BufferRef copied = graph.create(name, {buffer.size()});
    graph.pass("upload particles", [&](Pass& pass) {
      pass.read(host, Use::CopySource);
      copied = pass.write(copied, Use::CopyTarget, true);
      return [host, copied, bytes = buffer.size()](Commands& commands) { commands.copy(host, copied, bytes); };
    });
    return copied;
  }

  Scene scene_;
  ParticleSet start_;  ///< framed if the scene has no camera
  std::optional<Context> context_;
  Buffer position_, velocity_, concentration_, whitePlace_, whiteMotion_, whiteCounts_;
  bool mixes_ = false;      ///< there are concentrations
  bool foams_ = false;      ///< there is whitewater to draw
  uint32_t whiteRoom_ = 0;  ///< its particles
  uint32_t count_ = 0;
  Double3 origin_ = {0, 0, 0};
  double time_s_ = 0;
  Painter painter_;
  PictureRun pictures_;
};

Player::Player(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Player::~Player() = default;
Player::Player(Player&&) noexcept = default;
Player& Player::operator=(Player&&) noexcept = default;

Expected<Player> Player::open(Scene scene, const Options& options) {
  return guarded("opening the scene", [&]() -> Expected<Player> {
    auto impl = std::make_unique<Impl>(std::move(scene), options);
    if (auto opened = impl->open(options); !opened) return opened.error();
    return Player(std::move(impl));
  });
}

Expected<void> Player::show(const PlayedFrame& frame) { return impl_->show(frame); }

Expected<Image> Player::render(const std::string& view, uint32_t width, uint32_t height) {
  return guarded("drawing", [&] { return impl_->render(view, width, height); });
}

Expected<LinearImage> Player::renderLinear(uint32_t width, uint32_t height) {
  return guarded("drawing", [&] { return impl_->renderLinear(width, height); });
}

std::string Player::pictureDot() const { return impl_->pictureDot(); }
uint64_t Player::boundHits() const { return impl_->boundHits(); }
Expected<void> Player::prepareRender(const std::string& view, uint32_t width, uint32_t height) {
  return guarded("drawing", [&] { return impl_->prepareRender(view, width, height); });
}

const DeviceInfo& Player::device() const { return impl_->device(); }
const Scene& Player::scene() const { return impl_->scene(); }
std::vector<std::string> Player::takeValidationMessages() { return impl_->takeMessages(); }

}  // namespace rill::offline
