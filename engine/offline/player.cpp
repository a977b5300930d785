// Renders given particles.
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
#include "rill/offline.hpp"

namespace rill::offline {

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

  Expected<void> show(const std::vector<Float3>& positions, const Double3& origin, const std::vector<Float3>& velocities, double time_s,
                      const std::vector<uint8_t>& fluids, const std::vector<Float4>& concentrations) {
    if (positions.size() > kMaxParticles)
      return Error{ErrorKind::TooLarge, std::to_string(positions.size()) + " particles; expected at most " + std::to_string(kMaxParticles)};
    if (!velocities.empty() && velocities.size() != positions.size())
      return Error{ErrorKind::BadInput, "found " + std::to_string(velocities.size()) + " velocities for " +
                                            std::to_string(positions.size()) + " positions, expected equal numbers"};
    if (!fluids.empty() && fluids.size() != positions.size())
      return Error{ErrorKind::BadInput, "found " + std::to_string(fluids.size()) + " fluids for " + std::to_string(positions.size()) +
                                            " positions, expected equal numbers"};
    if (!concentrations.empty() && concentrations.size() != positions.size())
      return Error{ErrorKind::BadInput, "found concentrations of " + std::to_string(concentrations.size()) + " particles for " +
                                            std::to_string(positions.size()) + " positions, expected equal numbers"};
    const size_t known = std::max<size_t>(scene_.fluids.size(), 1);
    if (const auto wrong = std::ranges::find_if(fluids, [&](uint8_t fluid) { return fluid >= known; }); wrong != fluids.end())
      return Error{ErrorKind::BadInput, "found fluid " + std::to_string(*wrong) + " of a particle, expected an index below " +
                                            std::to_string(known) + ", the number of the scene's fluids"};
    count_ = static_cast<uint32_t>(positions.size());
    time_s_ = time_s;
    origin_ = origin;
    pictures_.contentChanged();
    mixes_ = !concentrations.empty();
    if (count_ == 0) return {};
    if (mixes_) {
      if (auto room = makeRoom(concentration_); !room) return room;
      std::memcpy(concentration_.mapped(), concentrations.data(), concentrations.size() * sizeof(Float4));
    }
    for (const auto& [buffer, from] : {std::pair{&position_, &positions}, std::pair{&velocity_, &velocities}}) {
      if (auto room = makeRoom(*buffer); !room) return room;
      std::byte* to = buffer->mapped();
      for (uint32_t i = 0; i < count_; ++i, to += sizeof(Float4)) {
        const Float3 v = from->empty() ? Float3{} : (*from)[i];
        const float w = buffer == &velocity_ ? 1.0f : fluids.empty() ? 0.0f : static_cast<float>(fluids[i]);
        const Float4 record{v.x, v.y, v.z, w};
        std::memcpy(to, &record, sizeof record);
      }
    }
    return {};
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
  /// For a vector of each particle.
  Expected<void> makeRoom(Buffer& buffer) {
    const uint64_t bytes = uint64_t{count_} * sizeof(Float4);
    if (buffer.size() >= bytes) return {};
    auto made = createBuffer(context_->device(), "played particles", bytes, MemoryKind::Upload);
    if (!made) return made.error();
    buffer = std::move(*made);
    return {};
  }

  template <class T>
  Expected<void> draw(std::string_view view, std::vector<T>& rgba, uint32_t width, uint32_t height, PixelKind kind) {
    if (auto ready = prepareRender(view, width, height); !ready) return ready.error();
    const PictureRun::Source source{.time_s = time_s_,
                                    .content = [&](Graph& graph) { return PictureRun::Content{.fluid = drawn(graph)}; },
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
  Buffer position_, velocity_, concentration_;
  bool mixes_ = false;  ///< there are concentrations
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

Expected<void> Player::show(const std::vector<Float3>& positions, const Double3& origin, const std::vector<Float3>& velocities,
                            double time_s, const std::vector<uint8_t>& fluids, const std::vector<Float4>& concentrations) {
  return impl_->show(positions, origin, velocities, time_s, fluids, concentrations);
}

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
