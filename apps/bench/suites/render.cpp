// Surfaces from particles against the truth, and what they cost: methods and settings over shapes of known depth and normal.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "bench/suites/suites.hpp"
#include "bench/surface_shapes.hpp"
#include "bench/workbench.hpp"
#include "render/fluid_renderer_impl.hpp"
#include "render/scenery.hpp"

namespace rill::bench {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFov = 40;  // degrees

constexpr std::pair<std::string_view, SurfaceMethod> kMethods[] = {
    {"planes", SurfaceMethod::Planes}, {"curvature flow", SurfaceMethod::CurvatureFlow}, {"narrow range", SurfaceMethod::NarrowRange}};

/// A picture's surface as it was read back.
struct Drawn {
  std::vector<float> depth;  ///< spacings; infinite: no fluid
  std::vector<std::array<double, 3>> normal;
};

struct Errors {
  double mean = 0, p95 = 0;  ///< degrees, away from edges
  double edge = 0;           ///< degrees in the band of 1.5 spacings along them
  double depth = 0;          ///< rms, spacings, away from edges
  double overlap = 1;        ///< of silhouettes: both over either
  double flicker = 0;        ///< mean change of the normal under another jitter, degrees
};

double angle(const double* a, const double* b) {
  return std::acos(std::clamp(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], -1.0, 1.0)) / kDegree;
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
    struct Picture {
      uint32_t width, height;
      double radius;  ///< pixels of a sphere of 0.75 spacings
      Jitter jitter;
    };
    std::vector<Picture> pictures{{1024, 768, 10, {}}};
    if (!bench_.quick()) {
      for (const double radius : {3.0, 4.0, 25.0}) pictures.push_back({1024, 768, radius, {}});
      pictures.push_back({1024, 768, 10, {0.35, 0.2}});
      for (const auto& [w, h] : {std::pair{640u, 360u}, std::pair{1280u, 720u}, std::pair{1920u, 1080u}})
        pictures.push_back({w, h, 10, {}});
    }
    bench_.plan(pictures.size() * std::size(kMethods) * shapes(100, 1, 1).size());
    table_.title = "Surfaces against the truth: ms of the whole chain, errors in degrees";
    table_.columns = {"picture", "shape", "method", "particles", "ms", "mean", "p95", "edge", "depth d", "IoU", "flicker"};
    table_.note =
        "ms: occlusion, splat, fit, blend, composition; the median. mean, p95: of the angle to the true normal, 1.5 spacings away from "
        "edges; edge: mean nearer\n"
        "to them. depth: rms in spacings. IoU: of silhouettes. flicker: mean change of the normal where particles are jittered anew.";
    for (const Picture& picture : pictures) {
      const double tangentY = std::tan(0.5 * kFov * kDegree), tangentX = tangentY * picture.width / picture.height;
      // A sphere of 0.75 spacings is `radius` pixels wide at this distance.
      const double distance = 0.75 * picture.height / (2 * tangentY * picture.radius);
      char name[64];
      std::snprintf(name, sizeof name, "%ux%u r %.3g%s", picture.width, picture.height, picture.radius,
                    picture.jitter.along > 0.3 ? " noisy" : "");
      for (const auto& shape : shapes(distance, tangentX, tangentY))
        for (const auto& [method, which] : kMethods) {
          if (bench_.stopped()) return finish();
          const std::string about = std::string(name) + ", " + shape->name() + ", " + std::string(method);
          bench_.step(about);
          if (!bench_.wanted(about)) continue;
          CameraView camera;
          camera.eye[2] = 0;
          camera.target[2] = -distance;
          camera.fov_y_deg = kFov;
          const FluidView view = fluidView(camera, picture.width, picture.height, 1);
          if (auto ok = measure(name, *shape, std::string(method), which, view, tangentX, tangentY, picture.jitter); !ok) return ok.error();
        }
    }
    return finish();
  }

 private:
  Expected<Report> finish() {
    report_.tables.push_back(std::move(table_));
    Plot plot{"1024x768, spheres of 10 pixels", "ms", "mean error of the normal (degrees)", true, true, {}};
    plot.series = std::move(series_);
    if (!plot.series.empty()) report_.plots.push_back(std::move(plot));
    return std::move(report_);
  }

  Expected<std::pair<Drawn, uint32_t>> draw(const Shape& shape, SurfaceMethod method, const FluidView& view, const Jitter& jitter,
                                            uint32_t seed, GraphSamples* times) {
    std::vector<Float4> positions;
    for (const Float3& p : shape.particles(jitter, seed)) positions.push_back({p.x, p.y, -p.z, 0});
    auto buffer = workbench_->upload("positions", std::span<const Float4>(positions));
    if (!buffer) return buffer.error();
    const auto declare = [&](Graph& graph, bool whole) {
      FluidState fluid;
      fluid.position = importWhole(graph, "positions", *buffer);
      fluid.count = static_cast<uint32_t>(positions.size());
      fluid.spacing = 1;
      return renderer_->impl().surface.addTo(graph, fluid, renderer_->impl().camera(fluid, view), method, whole, view.focus_m);
    };
    if (times) {
      auto taken = sampleGraph(*workbench_, std::max(3u, bench_.options().repeat), [&](Graph& graph) {
        const SurfaceBuffers found = declare(graph, false);
        graph.pass("look", [&](Pass& pass) {
          pass.read(found.pixels, Use::CopySource);
          pass.sideEffect();
          return [](Commands&) {};
        });
      });
      if (!taken) return taken.error();
      *times = std::move(*taken);
    }
    auto pixels = workbench_->make("pixels", uint64_t{view.width} * view.height * 8);
    if (!pixels) return pixels.error();
    auto ran = workbench_->run([&](Graph& graph) {
      const SurfaceBuffers found = declare(graph, true);
      BufferRef kept = importWhole(graph, "pixels", *pixels);
      graph.pass("keep", [&](Pass& pass) {
        pass.read(found.pixels, Use::CopySource);
        kept = pass.write(kept, Use::CopyTarget, true);
        return [=, from = found.pixels, bytes = pixels->size()](Commands& commands) { commands.copy(from, kept, bytes); };
      });
    });
    if (!ran) return ran.error();
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
    return std::pair{std::move(drawn), static_cast<uint32_t>(positions.size())};
  }

  Expected<void> measure(const std::string& picture, const Shape& shape, const std::string& method, SurfaceMethod which,
                         const FluidView& view, double tangentX, double tangentY, const Jitter& jitter) {
    GraphSamples times;
    auto first = draw(shape, which, view, jitter, 1, &times);
    if (!first) return first.error();
    auto second = draw(shape, which, view, jitter, 2, nullptr);
    if (!second) return second.error();
    const Errors e = compare(shape, first->first, second->first, view, tangentX, tangentY);
    const double ms = median(times.run_ms);
    table_.rows.push_back({picture, shape.name(), method, std::to_string(first->second), number(ms), number(e.mean), number(e.p95),
                           number(e.edge), number(e.depth), number(e.overlap, 4), number(e.flicker)});
    report_.results.push_back({{"picture", picture},
                               {"shape", shape.name()},
                               {"method", method},
                               {"particles", first->second},
                               {"ms", sampled(times.run_ms)},
                               {"normal_mean_deg", e.mean},
                               {"normal_p95_deg", e.p95},
                               {"edge_mean_deg", e.edge},
                               {"depth_rms_spacings", e.depth},
                               {"silhouette_iou", e.overlap},
                               {"flicker_deg", e.flicker}});
    if (picture == "1024x768 r 10") {
      auto found = std::ranges::find(series_, shape.name(), &Series::name);
      if (found == series_.end()) found = series_.insert(series_.end(), {shape.name(), Series::Style::Points, {}, {}});
      found->points.emplace_back(ms, e.mean);
      found->labels.push_back(method);
    }
    return {};
  }

  Errors compare(const Shape& shape, const Drawn& drawn, const Drawn& other, const FluidView& view, double tangentX,
                 double tangentY) const {
    const uint32_t width = view.width, height = view.height;
    std::vector<Truth> truth(size_t{width} * height);
    std::vector<uint8_t> hit(truth.size());
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x) {
        const size_t i = size_t{y} * width + x;
        hit[i] = shape.hit(((x + 0.5) / width * 2 - 1) * tangentX, (1 - (y + 0.5) / height * 2) * tangentY, truth[i]);
      }
    const int band = std::max(1, static_cast<int>(1.5 * height / (2 * tangentY * view.focus_m)));
    const auto nearEdge = [&](uint32_t x, uint32_t y) {
      const size_t i = size_t{y} * width + x;
      for (const auto& [dx, dy] : {std::pair{band, 0}, std::pair{-band, 0}, std::pair{0, band}, std::pair{0, -band}}) {
        const int nx = int(x) + dx, ny = int(y) + dy;
        if (nx < 0 || ny < 0 || nx >= int(width) || ny >= int(height)) continue;
        const size_t j = size_t(ny) * width + size_t(nx);
        if (!hit[j] || std::abs(truth[j].depth - truth[i].depth) > 4) return true;
      }
      return false;
    };
    Errors e;
    std::vector<double> inner, edge, flicker;
    double both = 0, either = 0, square = 0;
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x) {
        const size_t i = size_t{y} * width + x;
        const bool there = std::isfinite(drawn.depth[i]);
        both += there && hit[i];
        either += there || hit[i];
        if (!there || !hit[i]) continue;
        const double off = angle(drawn.normal[i].data(), truth[i].normal);
        if (nearEdge(x, y)) {
          edge.push_back(off);
          continue;
        }
        inner.push_back(off);
        square += std::pow(drawn.depth[i] - truth[i].depth, 2);
        if (std::isfinite(other.depth[i])) { flicker.push_back(angle(drawn.normal[i].data(), other.normal[i].data())); }
      }
    const auto mean = [](const std::vector<double>& values) {
      double sum = 0;
      for (const double v : values) sum += v;
      return values.empty() ? 0 : sum / double(values.size());
    };
    e.mean = mean(inner);
    e.edge = mean(edge);
    e.flicker = mean(flicker);
    e.depth = std::sqrt(square / std::max<double>(double(inner.size()), 1));
    e.overlap = both / std::max(either, 1.0);
    if (!inner.empty()) {
      const auto place = inner.begin() + static_cast<std::ptrdiff_t>(0.95 * double(inner.size() - 1));
      std::nth_element(inner.begin(), place, inner.end());
      e.p95 = *place;
    }
    return e;
  }

  Bench& bench_;
  std::optional<Workbench> workbench_;
  std::unique_ptr<FluidRenderer> renderer_;
  Table table_;
  std::vector<Series> series_;
  Report report_;
};

}  // namespace

Expected<Report> runRender(Bench& bench) { return Render(bench).run(); }

}  // namespace rill::bench
