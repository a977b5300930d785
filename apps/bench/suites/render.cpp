// Surfaces from particles against the truth, and what they cost: methods and settings over shapes of known depth and normal.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "bench/pareto.hpp"
#include "bench/suites/suites.hpp"
#include "bench/suites/surface_aims.hpp"
#include "bench/suites/surface_ways.hpp"
#include "bench/surface_errors.hpp"
#include "bench/workbench.hpp"
#include "render/fluid_renderer_impl.hpp"
#include "views/scenery.hpp"

namespace rill::bench {
namespace {

constexpr double kFov = 40;        // degrees
constexpr double kRadius = 0.75;   // spacings: of the spheres by which pictures are named
constexpr double kTravel = 0.25;   // spacings that the moving wave travels a frame
constexpr double kTraveling = 18;  // spacings: its length
constexpr double kFlickerFrame_s = 1.0 / 60;
constexpr double kPixelsAPart = 2e5;  // of progress

constexpr const char* kAsItIs = "settings as they are";

struct Picture {
  std::string name;
  Eye eye;
  Jitter jitter = {};
  bool tilted = false;
  bool settings = true;  ///< whether settings are varied, too
};

Picture picture(uint32_t width, uint32_t height, double radius) {
  const double tangentY = std::tan(0.5 * kFov * std::numbers::pi / 180);
  char name[64];
  std::snprintf(name, sizeof name, "%ux%u r %g", width, height, radius);
  return {name, {width, height, tangentY * width / height, tangentY, kRadius * height / (2 * tangentY * radius)}};
}

std::vector<Picture> pictures(bool quick) {
  Picture main = picture(1024, 768, 10);
  if (quick) {
    main.settings = false;
    return {main, picture(640, 360, 10)};
  }
  std::vector<Picture> all{main};
  for (const double radius : {4.0, 25.0}) all.push_back(picture(1024, 768, radius));
  Picture noisy = main, tilted = main;
  noisy.name += " noisy";
  noisy.jitter = {0.35, 0.2};
  tilted.name += " tilted";
  tilted.tilted = true;
  all.push_back(std::move(noisy));
  all.push_back(std::move(tilted));
  for (const auto& [w, h] : {std::pair{640u, 360u}, std::pair{1280u, 720u}, std::pair{1920u, 1080u}}) all.push_back(picture(w, h, 10));
  for (const double radius : {3.0, 30.0}) {
    all.push_back(picture(1024, 768, radius));
    all.back().settings = false;
  }
  return all;
}

std::vector<std::unique_ptr<Shape>> shapesOf(const Picture& picture, bool quick) {
  const Eye& eye = picture.eye;
  if (picture.tilted) return tiltedShapes(eye.distance, eye.tangentX, eye.tangentY);
  auto all = shapes(eye.distance, eye.tangentX, eye.tangentY);
  if (quick) std::erase_if(all, [](const auto& shape) { return shape->name() == "waves 30" || shape->name() == "waves 60"; });
  return all;
}

/// What fronts are drawn of: neither the corner nor the sheet, where edges decide.
bool smooth(const Shape& shape) { return shape.name() != "corner" && shape.name() != "sheet"; }

/// A run of the solver, whose surface nobody knows.
struct Recorded {
  const char *name, *scene;
  std::vector<Override> changes;
  double from_s;  ///< of the first frame
};
const std::vector<Recorded>& recordings() {
  static const std::vector<Recorded> all{{"resting column", "resting-column", {}, 1.0},
                                         {"dam break", "dam50k", {{"fluid.spacing", "0.1"}}, 0.8}};
  return all;
}

/// Particles on the device.
struct Points {
  Buffer positions;
  uint32_t count = 0;
  double spacing = 1;
};

/// A way's cost and error, added up over shapes or frames.
struct Sum {
  const SurfaceWay* way = nullptr;
  double ms = 0, mean = 0, p95 = 0, count = 0;
};

class Render {
 public:
  explicit Render(Bench& bench) : bench_(bench) {}

  Expected<Report> run() {
    auto opened = Workbench::open(bench_);
    if (!opened) return opened.error();
    workbench_.emplace(std::move(*opened));
    auto renderer = FluidRenderer::create(workbench_->device());
    if (!renderer) return renderer.error();
    renderer_ = std::move(*renderer);
    auto bilateral = Bilateral::create(workbench_->device());
    if (!bilateral) return bilateral.error();
    ways_ = surfaceWays(*bilateral, bench_.quick());
    errors_.title = "Surfaces against the truth: ms of the whole chain, errors in degrees";
    errors_.columns = {"picture", "shape", "method", "particles", "ms", "smoothing", "mean", "p95", "edge", "depth d", "IoU", "anew"};
    errors_.note =
        "r: pixels of a sphere of 0.75 spacings. ms: occlusion, splat, fit, blend, composition; the median. smoothing: without what comes\n"
        "before the depth of spheres, passes timed one by one. mean, p95: of the angle to the true normal, 1.5 spacings away from edges;\n"
        "edge: mean nearer to them. depth: rms in spacings. IoU: of silhouettes. anew: mean change of the normal where particles are\n"
        "jittered anew.";
    const std::vector<Picture> all = pictures(bench_.quick());
    size_t parts = 0;
    for (const Picture& p : all) {
      for (const auto& shape : shapesOf(p, bench_.quick())) parts += wanted(p, *shape).size() * partsOf(p.eye);
    }
    for (const Picture& p : moving()) parts += wanted("moving wave, " + p.name).size() * partsOf(p.eye);
    for (const Recorded& r : recordings()) parts += wanted(r.name).size() * partsOf(still().eye);
    bench_.plan(parts, "part");
    for (const Picture& p : all)
      if (auto ok = measure(p); !ok) return ok.error();
    for (const Picture& p : moving())
      if (auto ok = flickerOfWave(p); !ok) return ok.error();
    for (const Recorded& r : recordings())
      if (auto ok = flickerOfRun(r); !ok) return ok.error();
    if (Table aims = judgedSurfaces(figures_, bench_.options().only.empty() && !bench_.stopped(), report_.failures); !aims.rows.empty())
      report_.tables.insert(report_.tables.begin(), std::move(aims));
    if (!errors_.rows.empty()) report_.tables.insert(report_.tables.begin(), std::move(errors_));
    return std::move(report_);
  }

 private:
  std::vector<Picture> moving() const {
    if (bench_.quick()) return {picture(640, 360, 10)};
    return {picture(1024, 768, 10), picture(1024, 768, 4), picture(1024, 768, 25)};
  }
  Picture still() const { return bench_.quick() ? picture(640, 360, 10) : picture(1024, 768, 10); }
  int frames() const { return bench_.quick() ? 3 : 8; }
  uint32_t samples() const { return std::max(3u, bench_.options().repeat); }
  static size_t partsOf(const Eye& eye) { return std::max<size_t>(1, static_cast<size_t>(eye.width * eye.height / kPixelsAPart)); }

  std::vector<const SurfaceWay*> wanted(const std::string& about) const {
    std::vector<const SurfaceWay*> out;
    for (const SurfaceWay& way : ways_)
      if (bench_.wanted(about + ", " + way.name())) out.push_back(&way);
    return out;
  }
  std::vector<const SurfaceWay*> wanted(const Picture& picture, const Shape& shape) const {
    auto out = wanted(picture.name + ", " + shape.name());
    std::erase_if(out, [&](const SurfaceWay* way) { return !way->standard() && !(picture.settings && smooth(shape)); });
    return out;
  }

  Expected<Points> upload(std::span<const Float4> positions, double spacing) {
    auto buffer = workbench_->upload("positions", positions);
    if (!buffer) return buffer.error();
    return Points{std::move(*buffer), static_cast<uint32_t>(positions.size()), spacing};
  }
  Expected<Points> upload(const Shape& shape, const Jitter& jitter, uint32_t seed) {
    std::vector<Float4> positions;
    for (const Float3& p : shape.particles(jitter, seed)) positions.push_back({p.x, p.y, -p.z, 0});
    return upload(positions, 1);
  }
  static FluidView viewOf(const Eye& eye) {
    CameraView camera;
    camera.eye[2] = 0;
    camera.target[2] = -eye.distance;
    camera.fov_y_deg = kFov;
    return fluidView(camera, eye.width, eye.height, 1);
  }

  SurfaceBuffers declare(Graph& graph, const Points& points, const SurfaceWay& way, const FluidView& view, bool whole) {
    FluidState fluid;
    fluid.position = importWhole(graph, "positions", points.positions);
    fluid.count = points.count;
    fluid.spacing = static_cast<float>(points.spacing);
    surface::SurfacePush camera = renderer_->impl().camera(fluid, view);
    camera.step = sampleStep(camera, fluid.spacing, view.focus_m, way.settings.samples);
    return renderer_->impl().surface.addTo(graph, fluid, camera, way.method, whole, view.focus_m, way.settings);
  }

  /// `ms`: what it took, its pixels kept.
  Expected<Drawn> draw(const Points& points, const SurfaceWay& way, const FluidView& view, double* ms = nullptr) {
    auto pixels = workbench_->make("pixels", uint64_t{view.width} * view.height * 8);
    if (!pixels) return pixels.error();
    const auto ran = workbench_->run([&](Graph& graph) {
      const SurfaceBuffers found = declare(graph, points, way, view, true);
      BufferRef kept = importWhole(graph, "pixels", *pixels);
      graph.pass("keep", [&](Pass& pass) {
        pass.read(found.pixels, Use::CopySource);
        kept = pass.write(kept, Use::CopyTarget, true);
        return [=, from = found.pixels, bytes = pixels->size()](Commands& commands) { commands.copy(from, kept, bytes); };
      });
    });
    if (!ran) return ran.error();
    if (ms) *ms = ran->run_ms;
    const auto words = workbench_->download<uint32_t>(*pixels);
    if (!words) return words.error();
    Drawn drawn;
    drawn.depth.resize(words->size() / 2);
    drawn.normal.resize(drawn.depth.size());
    for (size_t i = 0; i < drawn.depth.size(); ++i) {
      const SurfacePixel pixel = unpackPixel(&(*words)[2 * i]);
      drawn.depth[i] = pixel.depth;
      drawn.normal[i] = pixel.normal;
    }
    return drawn;
  }

  void declareToTime(Graph& graph, const Points& points, const SurfaceWay& way, const FluidView& view) {
    const SurfaceBuffers found = declare(graph, points, way, view, false);
    graph.pass("look", [&](Pass& pass) {
      pass.read(found.pixels, Use::CopySource);
      pass.sideEffect();
      return [](Commands&) {};
    });
  }

  /// Once its shaders have run.
  Expected<std::vector<double>> time(const Points& points, const SurfaceWay& way, const FluidView& view) {
    auto taken = sampleGraph(
        *workbench_, samples(), [&](Graph& graph) { declareToTime(graph, points, way, view); }, WarmUp::Done);
    if (!taken) return taken.error();
    return std::move(taken->run_ms);
  }

  /// Of smoothing with normals: all passes but those up to the depth of spheres. In runs of their own, since timing passes slows them.
  Expected<std::vector<double>> timeSmoothing(const Points& points, const SurfaceWay& way, const FluidView& view) {
    static constexpr std::array kBefore{"surface clear", "surface occlude", "surface cull", "surface splat", "surface tiles"};
    std::vector<double> taken;
    workbench_->timePasses(true);
    for (uint32_t k = 0; k < samples(); ++k) {
      const auto ran = workbench_->run([&](Graph& graph) { declareToTime(graph, points, way, view); });
      if (!ran) return ran.error();
      double ms = 0;
      for (const Timing& timing : workbench_->passTimes())
        if (std::ranges::find(kBefore, timing.name) == kBefore.end()) ms += timing.ms;
      taken.push_back(ms);
    }
    workbench_->timePasses(false);
    return taken;
  }

  /// A picture of each shape, in each way.
  Expected<void> measure(const Picture& picture) {
    const FluidView view = viewOf(picture.eye);
    std::vector<Sum> sums;
    for (const auto& shape : shapesOf(picture, bench_.quick())) {
      const auto ways = wanted(picture, *shape);
      if (ways.empty()) continue;
      const TrueSurface truth = trueSurface(*shape, picture.eye);
      auto points = upload(*shape, picture.jitter, 1), anew = upload(*shape, picture.jitter, 2);
      if (!points) return points.error();
      if (!anew) return anew.error();
      for (const SurfaceWay* way : ways) {
        if (bench_.stopped()) break;
        bench_.step(picture.name + ", " + shape->name() + ", " + way->name(), partsOf(picture.eye));
        const auto drawn = draw(*points, *way, view);
        if (!drawn) return drawn.error();
        const auto ms = time(*points, *way, view);
        if (!ms) return ms.error();
        const Errors e = surfaceErrors(truth, *drawn);
        Json json{{"picture", picture.name},       {"shape", shape->name()},     {"method", way->family},
                  {"setting", way->setting},       {"particles", points->count}, {"ms", sampled(*ms)},
                  {"normal_mean_deg", e.mean},     {"normal_p95_deg", e.p95},    {"edge_mean_deg", e.edge},
                  {"depth_rms_spacings", e.depth}, {"silhouette_iou", e.overlap}};
        if (way->standard()) {
          const auto other = draw(*anew, *way, view);
          if (!other) return other.error();
          const double change = errorChange(truth, *drawn, truth, *other);
          json["jittered_anew_deg"] = change;
          const auto smoothing = timeSmoothing(*points, *way, view);
          if (!smoothing) return smoothing.error();
          json["smoothing_ms"] = sampled(*smoothing);
          figures_.push_back({picture.name, shape->name(), way->family, median(*ms), median(*smoothing), e.mean, e.p95, e.edge, e.overlap});
          errors_.rows.push_back({picture.name, shape->name(), way->family, std::to_string(points->count), number(median(*ms)),
                                  number(median(*smoothing)), number(e.mean), number(e.p95), number(e.edge), number(e.depth),
                                  number(e.overlap, 4), number(change)});
        }
        report_.results.push_back(std::move(json));
        if (smooth(*shape)) add(sums, way, median(*ms), e.mean, e.p95);
      }
    }
    if (picture.settings) tell(picture.name + ": mean over plane, waves and balls", "mean error of the normal (degrees)", sums);
    return {};
  }

  /// One jitter of particles on a wave that travels: what changes in the error of the normal from frame to frame.
  Expected<void> flickerOfWave(const Picture& picture) {
    const std::string name = std::string(kMovingWave) + ", " + picture.name;
    const auto ways = wanted(name);
    if (ways.empty()) return {};
    const Eye& eye = picture.eye;
    std::vector<Points> points;
    std::vector<TrueSurface> truth;
    for (int k = 0; k < frames() && !bench_.stopped(); ++k) {
      const auto wave = traveledWave(eye.distance, eye.tangentX, eye.tangentY, kTraveling, kTravel * k);
      auto uploaded = upload(*wave, picture.jitter, 1);
      if (!uploaded) return uploaded.error();
      points.push_back(std::move(*uploaded));
      truth.push_back(trueSurface(*wave, eye));
    }
    return flicker(name, eye, viewOf(eye), points, ways,
                   [&](size_t k, const Drawn& before, const Drawn& after) { return errorChange(truth[k - 1], before, truth[k], after); });
  }

  /// Frames of the solver in a still camera. What moves is counted, too: only the ways can be compared.
  Expected<void> flickerOfRun(const Recorded& recorded) {
    const auto ways = wanted(recorded.name);
    if (ways.empty() || bench_.stopped()) return {};
    const auto scene = namedScene(recorded.scene, recorded.changes);
    if (!scene) return scene.error();
    offline::Options options;
    options.device = bench_.options().device;
    auto simulation = offline::Simulation::open(*scene, options);
    if (!simulation) return simulation.error();
    std::vector<Points> points;
    for (int k = 0; k < frames() && !bench_.stopped(); ++k) {
      if (auto ran = (*simulation)->advance(k == 0 ? recorded.from_s : kFlickerFrame_s); !ran) return ran.error();
      const auto particles = (*simulation)->particles();
      if (!particles) return particles.error();
      std::vector<Float4> positions;
      for (const Float3& p : particles->positions) positions.push_back({p.x, p.y, p.z, 0});
      auto uploaded = upload(positions, scene->fluid.spacing);
      if (!uploaded) return uploaded.error();
      points.push_back(std::move(*uploaded));
    }
    const Eye eye = still().eye;
    const CameraView camera = sceneCamera(*scene, (*simulation)->start(), double(eye.width) / eye.height);
    return flicker(recorded.name, eye, fluidView(camera, eye.width, eye.height, scene->fluid.spacing), points, ways,
                   [&](size_t, const Drawn& before, const Drawn& after) { return normalChange(before, after, scene->fluid.spacing); });
  }

  /// `change`: of frame k from the one before, degrees.
  Expected<void> flicker(const std::string& name, const Eye& eye, const FluidView& view, std::span<const Points> points,
                         std::span<const SurfaceWay* const> ways, const std::function<double(size_t, const Drawn&, const Drawn&)>& change) {
    std::vector<Sum> sums;
    for (const SurfaceWay* way : ways) {
      if (bench_.stopped()) break;
      bench_.step(name + ", " + way->name(), partsOf(eye));
      Drawn before;
      std::vector<double> ms(points.size()), changes;
      for (size_t k = 0; k < points.size(); ++k) {
        auto drawn = draw(points[k], *way, view, &ms[k]);
        if (!drawn) return drawn.error();
        if (k > 0) changes.push_back(change(k, before, *drawn));
        before = std::move(*drawn);
      }
      double mean = 0;
      for (const double c : changes) mean += c / double(changes.size());
      if (way->standard() && name.starts_with(kMovingWave)) {
        SurfaceFigures figures;
        figures.shape = kMovingWave;
        figures.method = way->family;
        figures.flicker = mean;
        figures_.push_back(figures);
      }
      report_.results.push_back({{"case", name},
                                 {"method", way->family},
                                 {"setting", way->setting},
                                 {"particles", points[0].count},
                                 {"ms", sampled(ms)},
                                 {"flicker_deg", mean}});
      add(sums, way, median(ms), mean, *std::ranges::max_element(changes));
    }
    tell(name + ": from frame to frame", "mean change of the normal (degrees)", sums);
    return {};
  }

  static void add(std::vector<Sum>& sums, const SurfaceWay* way, double ms, double mean, double p95) {
    auto found = std::ranges::find(sums, way, &Sum::way);
    if (found == sums.end()) found = sums.insert(sums.end(), Sum{way});
    found->ms += ms;
    found->mean += mean;
    found->p95 += p95;
    ++found->count;
  }

  /// A table and a diagram of cost against error, with the front; methods as they are stand out.
  void tell(const std::string& title, const std::string& what, const std::vector<Sum>& sums) {
    if (sums.empty()) return;
    std::vector<CostError> points;
    for (const Sum& sum : sums) points.emplace_back(sum.ms / sum.count, sum.mean / sum.count);
    const std::vector<size_t> front = paretoFront(points);
    Table table{title, {"method", "ms", "degrees", "p95 or worst frame", "front"}, {}, ""};
    for (size_t k = 0; k < sums.size(); ++k)
      table.rows.push_back({sums[k].way->name(), number(points[k].first), number(points[k].second), number(sums[k].p95 / sums[k].count),
                            std::ranges::find(front, k) != front.end() ? "front" : ""});
    report_.tables.push_back(std::move(table));

    Plot plot{title, "ms", what, true, true, {}};
    plot.series.push_back({kAsItIs, Series::Style::Points, {}, {}, true});
    for (size_t k = 0; k < sums.size(); ++k) {
      const SurfaceWay& way = *sums[k].way;
      const std::string name = way.standard() ? kAsItIs : way.family;
      auto found = std::ranges::find(plot.series, name, &Series::name);
      if (found == plot.series.end()) found = plot.series.insert(plot.series.end(), {name, Series::Style::Points, {}, {}});
      found->points.push_back(points[k]);
      found->labels.push_back(&way == &ways_.front() ? way.family + ", the default" : way.standard() ? way.family : way.setting);
    }
    Series line{"Pareto front", Series::Style::Lines, {}, {}};
    for (const size_t k : front) line.points.push_back(points[k]);
    plot.series.push_back(std::move(line));
    report_.plots.push_back(std::move(plot));
  }

  Bench& bench_;
  std::optional<Workbench> workbench_;
  std::unique_ptr<FluidRenderer> renderer_;
  std::vector<SurfaceWay> ways_;
  Table errors_;
  std::vector<SurfaceFigures> figures_;
  Report report_;
};

}  // namespace

Expected<Report> runRender(Bench& bench) { return Render(bench).run(); }

}  // namespace rill::bench
