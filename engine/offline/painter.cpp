#include "offline/painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "core/look_names.hpp"
#include "core/words.hpp"
#include "gpu/resources.hpp"
#include "gpu/vulkan_error.hpp"
#include "render/check_input.hpp"
#include "render/fluid_renderer_impl.hpp"

namespace rill::offline {
namespace {

/// 1/m, of fluids without a color of their own among others, where the look is opaque.
constexpr Float3 kOpaqueAbsorption{300, 300, 300};

enum class Kind { Final, Particles, Data };

struct View {
  std::string_view name;
  Kind kind;
  ParticleColor color = ParticleColor::Speed;
  bool unlit = false;
  SurfaceData data = SurfaceData::Normals;
};
constexpr View kViews[] = {{"final", Kind::Final},
                           {"particles", Kind::Particles, ParticleColor::Speed},
                           {"density", Kind::Particles, ParticleColor::Compression},
                           {"speed", Kind::Particles, ParticleColor::Speed, true},
                           {"depth", Kind::Data, {}, {}, SurfaceData::Depth},
                           {"normals", Kind::Data, {}, {}, SurfaceData::Normals},
                           {"thickness", Kind::Data, {}, {}, SurfaceData::Thickness}};
constexpr auto kNames = [] {
  std::array<std::string_view, std::size(kViews)> names;
  for (size_t i = 0; i < names.size(); ++i) names[i] = kViews[i].name;
  return names;
}();

const View* find(std::string_view name) {
  const auto found = std::find_if(std::begin(kViews), std::end(kViews), [&](const View& v) { return v.name == name; });
  return found == std::end(kViews) ? nullptr : found;
}

/// What the particles' colors show: which fluid, where there are several and the view is of no other quantity.
ParticleColor coloring(const View& view, const Scene& scene) {
  return view.name == "particles" && scene.fluids.size() > 1 ? ParticleColor::Fluid : view.color;
}

/// The texels of an image of half floats, to be read back.
BufferRef linearPixels(Graph& graph, ImageRef color, uint64_t pixels) {
  BufferRef copied = graph.create("picture linear", {pixels * 4 * sizeof(uint16_t)});
  graph.pass("picture linear", [&](Pass& pass) {
    pass.read(color, Use::CopySource);
    copied = pass.write(copied, Use::CopyTarget, true);
    return [color, copied](Commands& commands) { commands.copy(color, copied); };
  });
  return copied;
}

}  // namespace

uint64_t boundHits(const Graph& graph, const PictureTickets& tickets) {
  if (!tickets.counters) return 0;
  const auto bytes = graph.data(*tickets.counters);
  std::array<uint32_t, surface::kSurfaceCounterWords> words{};
  std::memcpy(words.data(), bytes.data(), std::min(bytes.size(), sizeof words));
  return words[surface::kBoundHits];
}

std::span<const std::string_view> Painter::views() { return kNames; }

CameraView Painter::camera(uint32_t width, uint32_t height, double time_s) const {
  CameraView view = sceneCamera(scene_, start_, double(width) / height);
  const double angle = orbit_degPerS_ * time_s * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const double x = view.eye[0] - view.target[0], z = view.eye[2] - view.target[2];
  view.eye[0] = view.target[0] + c * x + s * z;
  view.eye[2] = view.target[2] - s * x + c * z;
  return view;
}

Error Painter::environmentError(const Error& error) const {
  const std::string scene = scene_.file.empty() ? scene_.name : scene_.file.string();
  return {error.kind, scene + ": look.environment: " + error.message};
}

Expected<void> Painter::check(std::string_view name, uint32_t width, uint32_t height) {
  const View* view = find(name);
  if (!view) return Error{ErrorKind::BadInput, "unknown view " + inQuotes(name) + "; expected one of " + quotedList(kNames)};
  if (view->kind != Kind::Particles) return checkViewport(width, height);
  ParticleViewDesc desc;
  desc.width = width;
  desc.height = height;
  return ParticleView::check(desc);
}

Expected<void> Painter::checkOptions(const Options& options) {
  const double stops = options.exposure_stops;
  if (std::abs(stops) <= kMaxExposure_stops) return checkFilm(options.film);
  return Error{ErrorKind::BadInput, "Options::exposure_stops is " + shortestNumber(stops) + "; expected a number from -" +
                                        shortestNumber(kMaxExposure_stops) + " to " + shortestNumber(kMaxExposure_stops)};
}

Expected<void> Painter::prepare(Device& device, std::string_view name, uint32_t width, uint32_t height) {
  if (auto valid = check(name, width, height); !valid) return valid;
  const View* view = find(name);
  if (view->kind == Kind::Particles) {
    if (particles_) return {};
    auto made = ParticleView::create(device, scene_, start_);
    if (!made) return made.error();
    particles_ = std::move(*made);
    return {};
  }
  if (auto valid = FluidRenderer::check(fluidView(camera(width, height, 0), width, height, scene_.fluid.spacing)); !valid) return valid;
  if (!fluid_) {
    const auto look = fluidLook(scene_.look.preset);
    if (!look) return Error{ErrorKind::BadInput, "look.preset: unknown look " + inQuotes(scene_.look.preset)};
    const auto method = surfaceMethod(scene_.look.surface);
    if (!method) return Error{ErrorKind::BadInput, "look.surface: unknown method " + inQuotes(scene_.look.surface)};
    if (std::ranges::find(skies(), scene_.look.sky) == skies().end())
      return Error{ErrorKind::BadInput, "look.sky: unknown sky " + inQuotes(scene_.look.sky)};
    if (std::ranges::find(kStageNames, scene_.look.stage) == kStageNames.end())
      return Error{ErrorKind::BadInput, "look.stage: unknown stage " + inQuotes(scene_.look.stage)};
    look_ = *look;
    look_.surface = *method;
    const std::vector<FluidBody> bodies = fluidBodies(scene_);
    if (look_.opaque && !bodies.empty()) {
      look_.opaque = false;
      look_.absorption = kOpaqueAbsorption;
    }
    if (bodies.size() == 1) look_ = withBody(look_, bodies.front());
    auto made = FluidRenderer::create(device);
    if (!made) return made.error();
    if (bodies.size() > 1)
      if (auto set = made->setFluids(bodies); !set) return set;
    fluid_ = std::move(*made);
  }
  if (view->kind != Kind::Final) return {};
  const uint64_t dots = uint64_t{width} * height * WhitewaterView::kPixelBytes, most = device.info().maxBufferBytes;
  if (scene_.look.whitewater && dots > most)
    return Error{ErrorKind::TooLarge, "look.whitewater: a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                                          " pixels needs a buffer of " + bytesText(dots) + "; expected at most " + bytesText(most) +
                                          " on this device"};
  if (auto ready = prepareFilm(device, width, height); !ready || scenery_) return ready;
  if (!scene_.look.environment.empty()) {
    const auto picture = loadEnvironment(scene_.look.environment);
    if (!picture) return environmentError(picture.error());
    if (auto set = fluid_->setEnvironment(*picture); !set) return environmentError(set.error());
  } else if (const auto sky = skyPicture(scene_.look.sky)) {
    if (auto set = fluid_->setEnvironment(*sky); !set) return set;
  }
  auto scenery = Scenery::create(device, scene_, start_, {}, implOf(*fluid_).environment.get());
  if (!scenery) return scenery.error();
  auto finish = Finish::create(device);
  if (!finish) return finish.error();
  if (scene_.look.whitewater) {
    auto white = WhitewaterView::create(device, {}, implOf(*fluid_).environment != nullptr);
    if (!white) return white.error();
    whitewater_ = *white;
  }
  finish_ = *finish;
  scenery_ = std::move(*scenery);
  look_.toSun = scenery_->toSun();
  return {};
}

/// Needs the shaders of engine/views, which the scenery brings to the device.
Expected<void> Painter::prepareFilm(Device& device, uint32_t width, uint32_t height) {
  if (sampleCount(film_) == 1) return {};
  bringViewShaders(device);
  if (!sum_) {
    auto made = FilmSum::create(device);
    if (!made) return made.error();
    sum_ = *std::move(made);
  }
  if (film_.shutter_s > 0 && !motion_) {
    auto made = Motion::create(device);
    if (!made) return made.error();
    motion_ = *made;
  }
  return sum_->resize(device, width, height);
}

PictureTickets Painter::declare(Graph& graph, const FluidState& fluid, std::string_view view, uint32_t width, uint32_t height,
                                double time_s, PixelKind kind, const DrawnWhitewater& white) {
  PictureTickets tickets{graph.readback(addTo(graph, fluid, view, camera(width, height, time_s), width, height, time_s, kind, white)), {}};
  if (find(view)->kind != Kind::Particles && fluid.capacity > 0) tickets.counters = graph.readback(implOf(*fluid_).last.counters);
  return tickets;
}

BufferRef Painter::addTo(Graph& graph, const FluidState& fluid, std::string_view name, const CameraView& eye, uint32_t width,
                         uint32_t height, double time_s, PixelKind kind, const DrawnWhitewater& white) {
  const View& view = *find(name);
  if (view.kind == Kind::Particles) {
    ParticleViewDesc desc;
    desc.width = width;
    desc.height = height;
    desc.color = coloring(view, scene_);
    desc.unlit = view.unlit;
    return particles_->addTo(graph, fluid, eye, desc, time_s);
  }
  const FluidView seen = fluidView(eye, width, height, scene_.fluid.spacing);
  if (view.kind == Kind::Data) {
    const double full = view.data == SurfaceData::Depth ? 2 * seen.focus_m : 0.5 * seen.focus_m;
    return fluid_->addData(graph, fluid, seen, view.data, static_cast<float>(full), look_.surface);
  }
  const ImageRef color = addLight(graph, fluid, seen, time_s, white);
  if (kind == PixelKind::Linear) return linearPixels(graph, color, uint64_t{width} * height);
  return finish_.addTo(graph, color, width, height, exposure_stops_);
}

/// The view final in linear light.
ImageRef Painter::addLight(Graph& graph, const FluidState& fluid, const FluidView& seen, double time_s, const DrawnWhitewater& white) {
  const TargetFormats formats;
  SceneTargets targets{graph.create("picture color", {formats.color, seen.width, seen.height}),
                       graph.create("picture depth", {formats.depth, seen.width, seen.height})};
  FluidRendererImpl& renderer = implOf(*fluid_);
  const BufferRef environment = renderer.environment ? renderer.environment->addTo(graph) : BufferRef{};
  targets = scenery_->addTo(graph, fluid, targets, seen, look_, time_s, environment);
  const bool foams = whitewater_ && white.state.room > 0 && fluid.capacity > 0;
  FluidLook look = look_;
  if (foams) look.aeration = 0;  // whitewater comes in its place
  targets = renderer.addTo(graph, fluid, targets, seen, look, true, environment);
  if (foams)
    targets = whitewater_->addTo(graph,
                                 {white.state, fluid.origin, renderer.lastScene.depth, renderer.last.pixels,
                                  addLook(graph, lookRecord(look_, renderer.last.push, renderer.environment.get()))},
                                 targets, renderer.last.push, environment, exposure(white.size));
  targets =
      scenery_->addOverFluid(graph, targets, seen, look_, time_s, fluid.capacity > 0 ? renderer.last.pixels : BufferRef{}, environment);
  return targets.color;
}

/// A sample of a shutter is as long as its part of the time that this is open, so that the streaks of all samples join.
WhitewaterExposure Painter::exposure(double size) const {
  const CameraView view = sceneCamera(scene_, start_, 1);
  return {.size = size,
          .seconds = film_.shutter_s > 0 ? film_.shutter_s / sampleCount(film_) : scene_.look.spray_exposure,
          .turn = {0, orbit_degPerS_ * std::numbers::pi / 180, 0},
          .about = {view.target[0], view.target[1], view.target[2]}};
}

uint32_t Painter::samples(std::string_view name) const {
  const View* view = find(name);
  return view && view->kind == Kind::Final ? sampleCount(film_) : 1;
}

PictureTickets Painter::declareSample(Graph& graph, const FluidState& fluid, const DrawnWhitewater& white, uint32_t width, uint32_t height,
                                      double time_s, uint32_t k) {
  const FilmSample sample = filmSample(k, sampleCount(film_));
  const double since = film_.shutter_s * sample.time;
  FluidState state = fluid;
  DrawnWhitewater drawn = white;
  if (motion_) {
    state = motion_->addTo(graph, fluid, static_cast<uint32_t>(scene_.solids.size()), since);
    drawn.state = motion_->addTo(graph, white.state, since);
  }
  const CameraView eye = camera(width, height, time_s + since);
  const FluidView seen = fluidView(eye, width, height, scene_.fluid.spacing, cameraOffset(film_, sample, eye));
  sum_->add(graph, addLight(graph, state, seen, time_s + since, drawn), k == 0);
  for (const char* name : {"picture tone", "picture copy", "picture edge search", "picture edges"})
    graph.skipped(name, "a mean of several pictures has smooth edges, and a tone curve of its own");
  PictureTickets tickets;
  if (fluid.capacity > 0) tickets.counters = graph.readback(implOf(*fluid_).last.counters);
  return tickets;
}

PictureTickets Painter::declareMean(Graph& graph, PixelKind kind) const {
  const uint32_t count = sampleCount(film_);
  return {graph.readback(kind == PixelKind::Linear ? sum_->linear(graph, count) : sum_->picture(graph, count, exposure_stops_))};
}

void Painter::finish(Image& image, std::string_view name, double time_s) const {
  if (const auto scale = legend(name, time_s)) drawLegend(image.rgba, image.width, image.height, *scale);
}

std::optional<LegendDesc> Painter::legend(std::string_view name, double time_s) const {
  const View& view = *find(name);
  const ParticleColor color = coloring(view, scene_);
  if (view.kind != Kind::Particles || !particles_ || color == ParticleColor::Fluid) return std::nullopt;
  return LegendDesc{color, particles_->scaleMax(color), time_s};
}

}  // namespace rill::offline
