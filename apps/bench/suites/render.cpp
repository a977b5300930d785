// Surface reconstruction: time and error of methods and settings on analytic shapes.
#include <algorithm>
#include <optional>

#include "bench/suites/suites.hpp"
#include "bench/suites/surface_aims.hpp"
#include "bench/suites/surface_costs.hpp"
#include "bench/suites/surface_pictures.hpp"
#include "bench/suites/surface_runs.hpp"
#include "bench/suites/surface_variants.hpp"
#include "views/scenery.hpp"

namespace rill::bench {
namespace {

constexpr double kTravel = 0.25;    // displacement of the moving wave per frame, spacings
constexpr double kWavelength = 18;  // its wavelength, spacings
constexpr double kFlickerFrame_s = 1.0 / 60;
constexpr double kPixelsPerPart = 2e5;  // of progress

/// A simulation run, which has no reference surface.
struct Recorded {
  const char *name, *scene;
  std::vector<Override> changes;
  double from_s;  ///< time of the first frame
};
const std::vector<Recorded>& recordings() {
  static const std::vector<Recorded> all{{"resting column", "resting-column", {}, 1.0},
                                         {"dam break", "dam50k", {{"fluid.spacing", "0.1"}}, 0.8}};
  return all;
}

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
    runs_.emplace(*workbench_, *renderer_, std::max(3u, bench_.options().repeat));
    auto bilateral = Bilateral::create(workbench_->device());
    if (!bilateral) return bilateral.error();
    variants_ = surfaceVariants(*bilateral, bench_.quick());
    errors_.title = "Surfaces against the analytic reference: total time in ms, errors in degrees";
    errors_.columns = {"picture", "shape", "method", "particles", "ms", "smoothing", "mean", "p95", "edge", "depth d", "IoU", "jitter"};
    errors_.note =
        "r: radius in pixels of a sphere of 0.75 spacings. ms: median time of all surface passes. smoothing: passes after the sphere\n"
        "depth, timed separately. mean, p95: mean and 95th percentile of the angle to the reference normal, farther than 1.5 spacings\n"
        "from edges. edge: mean nearer to edges. depth: root mean square in spacings. IoU: intersection over union of the silhouettes.\n"
        "jitter: mean change of the error of the normal between two random jitters of the particles.";
    const std::vector<Picture> all = pictures(bench_.quick());
    size_t parts = 0;
    for (const Picture& p : all) {
      for (const auto& shape : shapesOf(p, bench_.quick())) parts += selectedVariants(p, *shape).size() * partsOf(p.eye);
    }
    for (const Picture& p : movingWavePictures()) parts += selectedVariants("moving wave, " + p.name).size() * partsOf(p.eye);
    for (const Recorded& r : recordings()) parts += selectedVariants(r.name).size() * partsOf(flickerPicture().eye);
    bench_.plan(parts, "part");
    for (const Picture& p : all)
      if (auto ok = measure(p); !ok) return ok.error();
    for (const Picture& p : movingWavePictures())
      if (auto ok = flickerOfWave(p); !ok) return ok.error();
    for (const Recorded& r : recordings())
      if (auto ok = flickerOfRun(r); !ok) return ok.error();
    if (Table aims = surfaceAimTable(figures_, bench_.options().only.empty() && !bench_.stopped(), report_.failures); !aims.rows.empty())
      report_.tables.insert(report_.tables.begin(), std::move(aims));
    if (!errors_.rows.empty()) report_.tables.insert(report_.tables.begin(), std::move(errors_));
    return std::move(report_);
  }

 private:
  std::vector<Picture> movingWavePictures() const {
    if (bench_.quick()) return {picture(640, 360, 10)};
    return {picture(1024, 768, 10), picture(1024, 768, 4), picture(1024, 768, 25)};
  }
  Picture flickerPicture() const { return bench_.quick() ? picture(640, 360, 10) : picture(1024, 768, 10); }
  int frames() const { return bench_.quick() ? 3 : 8; }
  static size_t partsOf(const Eye& eye) { return std::max<size_t>(1, static_cast<size_t>(eye.width * eye.height / kPixelsPerPart)); }

  std::vector<const SurfaceVariant*> selectedVariants(const std::string& caseName) const {
    std::vector<const SurfaceVariant*> out;
    for (const SurfaceVariant& variant : variants_)
      if (bench_.selected(caseName + ", " + variant.name())) out.push_back(&variant);
    return out;
  }
  std::vector<const SurfaceVariant*> selectedVariants(const Picture& picture, const Shape& shape) const {
    auto out = selectedVariants(picture.name + ", " + shape.name());
    std::erase_if(out, [&](const SurfaceVariant* variant) { return !variant->isDefault() && !(picture.settings && smooth(shape)); });
    return out;
  }

  static FluidView viewOf(const Eye& eye) {
    CameraView camera;
    camera.eye[2] = 0;
    camera.target[2] = -eye.distance;
    camera.fov_y_deg = kFov;
    return fluidView(camera, eye.width, eye.height, 1);
  }

  /// Measures every variant on every shape of a picture.
  Expected<void> measure(const Picture& picture) {
    const FluidView view = viewOf(picture.eye);
    std::vector<SurfaceCost> sums;
    for (const auto& shape : shapesOf(picture, bench_.quick())) {
      const auto variants = selectedVariants(picture, *shape);
      if (variants.empty()) continue;
      const ReferenceSurface reference = referenceSurface(*shape, picture.eye);
      auto points = runs_->upload(*shape, picture.jitter, 1), rejittered = runs_->upload(*shape, picture.jitter, 2);
      if (!points) return points.error();
      if (!rejittered) return rejittered.error();
      for (const SurfaceVariant* variant : variants) {
        if (bench_.stopped()) break;
        bench_.step(picture.name + ", " + shape->name() + ", " + variant->name(), partsOf(picture.eye));
        const auto drawn = runs_->draw(*points, *variant, view);
        if (!drawn) return drawn.error();
        const auto ms = runs_->time(*points, *variant, view);
        if (!ms) return ms.error();
        const Errors e = surfaceErrors(reference, *drawn);
        Json json{{"picture", picture.name},    {"shape", shape->name()},        {"method", variant->family}, {"setting", variant->setting},
                  {"particles", points->count}, {"ms", sampleStatistics(*ms)},   {"normal_mean_deg", e.mean}, {"normal_p95_deg", e.p95},
                  {"edge_mean_deg", e.edge},    {"depth_rms_spacings", e.depth}, {"silhouette_iou", e.iou}};
        if (variant->isDefault()) {
          const auto other = runs_->draw(*rejittered, *variant, view);
          if (!other) return other.error();
          const double change = errorChange(reference, *drawn, reference, *other);
          json["jittered_anew_deg"] = change;
          const auto smoothing = runs_->timeSmoothing(*points, *variant, view);
          if (!smoothing) return smoothing.error();
          json["smoothing_ms"] = sampleStatistics(*smoothing);
          figures_.push_back({picture.name, shape->name(), variant->family, median(*ms), median(*smoothing), e.mean, e.p95, e.edge, e.iou});
          errors_.rows.push_back({picture.name, shape->name(), variant->family, std::to_string(points->count), number(median(*ms)),
                                  number(median(*smoothing)), number(e.mean), number(e.p95), number(e.edge), number(e.depth),
                                  number(e.iou, 4), number(change)});
        }
        report_.results.push_back(std::move(json));
        if (smooth(*shape)) addCost(sums, variant, median(*ms), e.mean, e.p95);
      }
    }
    if (picture.settings)
      tabulateCosts(picture.name + ": mean of plane, waves and balls", "mean error of the normal (degrees)", sums, variants_.front(),
                    report_);
    return {};
  }

  /// Change of the error of the normal between frames of a traveling wave with one fixed jitter.
  Expected<void> flickerOfWave(const Picture& picture) {
    const std::string name = std::string(kMovingWave) + ", " + picture.name;
    const auto variants = selectedVariants(name);
    if (variants.empty()) return {};
    const Eye& eye = picture.eye;
    std::vector<Points> points;
    std::vector<ReferenceSurface> references;
    for (int k = 0; k < frames() && !bench_.stopped(); ++k) {
      const auto wave = travelingWave(eye.distance, eye.tanHalfFovX, eye.tanHalfFovY, kWavelength, kTravel * k);
      auto uploaded = runs_->upload(*wave, picture.jitter, 1);
      if (!uploaded) return uploaded.error();
      points.push_back(std::move(*uploaded));
      references.push_back(referenceSurface(*wave, eye));
    }
    return flicker(name, eye, viewOf(eye), points, variants, [&](size_t k, const RenderedSurface& before, const RenderedSurface& after) {
      return errorChange(references[k - 1], before, references[k], after);
    });
  }

  /// Change of the normal between simulated frames with a fixed camera. It includes real motion, so only variants are comparable.
  Expected<void> flickerOfRun(const Recorded& recorded) {
    const auto variants = selectedVariants(recorded.name);
    if (variants.empty() || bench_.stopped()) return {};
    const auto scene = namedScene(recorded.scene, recorded.changes);
    if (!scene) return scene.error();
    auto simulation = offline::Simulation::open(*scene, simulationOptions(bench_));
    if (!simulation) return simulation.error();
    std::vector<Points> points;
    for (int k = 0; k < frames() && !bench_.stopped(); ++k) {
      if (auto ran = simulation->advance(k == 0 ? recorded.from_s : kFlickerFrame_s); !ran) return ran.error();
      const auto particles = simulation->particles();
      if (!particles) return particles.error();
      std::vector<Float4> positions;
      for (const Float3& p : particles->positions) positions.push_back({p.x, p.y, p.z, 0});
      auto uploaded = runs_->upload(positions, scene->fluid.spacing);
      if (!uploaded) return uploaded.error();
      points.push_back(std::move(*uploaded));
    }
    const Eye eye = flickerPicture().eye;
    const CameraView camera = sceneCamera(*scene, simulation->start(), double(eye.width) / eye.height);
    return flicker(recorded.name, eye, fluidView(camera, eye.width, eye.height, scene->fluid.spacing), points, variants,
                   [&](size_t, const RenderedSurface& before, const RenderedSurface& after) {
                     return normalChange(before, after, scene->fluid.spacing);
                   });
  }

  /// `change(k, before, after)`: change between frames k - 1 and k, degrees.
  Expected<void> flicker(const std::string& name, const Eye& eye, const FluidView& view, std::span<const Points> points,
                         std::span<const SurfaceVariant* const> variants,
                         const std::function<double(size_t, const RenderedSurface&, const RenderedSurface&)>& change) {
    std::vector<SurfaceCost> sums;
    for (const SurfaceVariant* variant : variants) {
      if (bench_.stopped()) break;
      bench_.step(name + ", " + variant->name(), partsOf(eye));
      RenderedSurface before;
      std::vector<double> ms(points.size()), changes;
      for (size_t k = 0; k < points.size(); ++k) {
        auto drawn = runs_->draw(points[k], *variant, view, &ms[k]);
        if (!drawn) return drawn.error();
        if (k > 0) changes.push_back(change(k, before, *drawn));
        before = std::move(*drawn);
      }
      double mean = 0;
      for (const double c : changes) mean += c / double(changes.size());
      if (variant->isDefault() && name.starts_with(kMovingWave)) {
        SurfaceFigures figures;
        figures.shape = kMovingWave;
        figures.method = variant->family;
        figures.flicker = mean;
        figures_.push_back(figures);
      }
      report_.results.push_back({{"case", name},
                                 {"method", variant->family},
                                 {"setting", variant->setting},
                                 {"particles", points[0].count},
                                 {"ms", sampleStatistics(ms)},
                                 {"flicker_deg", mean}});
      addCost(sums, variant, median(ms), mean, *std::ranges::max_element(changes));
    }
    tabulateCosts(name + ": change between frames", "mean change of the normal (degrees)", sums, variants_.front(), report_);
    return {};
  }

  Bench& bench_;
  std::optional<Workbench> workbench_;
  std::optional<FluidRenderer> renderer_;
  std::optional<SurfaceRuns> runs_;
  std::vector<SurfaceVariant> variants_;
  Table errors_;
  std::vector<SurfaceFigures> figures_;
  Report report_;
};

}  // namespace

Expected<Report> runRender(Bench& bench) { return Render(bench).run(); }

}  // namespace rill::bench
