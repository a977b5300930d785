#include "views/glass_tank.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "gpu/resources.hpp"
#include "views/scene_buffers.hpp"

namespace rill {
namespace {

constexpr double kThickness = 0.012;  // of the longer horizontal side
constexpr double kPolished = 0.35;    // of the thickness: the band at the top of a pane where its edge is seen through it
constexpr uint32_t kQuadVertices = 6;

/// Adds the faces of one side's panes; a quad is given by two opposite corners, which agree along one axis.
class PaneFaces {
 public:
  PaneFaces(std::vector<GlassQuad>& quads, size_t axis, double outward) : quads_(quads), axis_(axis), outward_(outward) {}

  void add(const Double3& low, const Double3& high, bool edge) {
    const size_t flat = low[1] == high[1] ? 1 : axis_, first = flat == 0 ? 1 : 0, second = flat == 2 ? 1 : 2;
    if (!(high[first] > low[first]) || !(high[second] > low[second])) return;
    float sides[2][3] = {}, normal[3] = {};
    sides[0][first] = static_cast<float>(high[first] - low[first]);
    sides[1][second] = static_cast<float>(high[second] - low[second]);
    normal[axis_] = static_cast<float>(outward_);
    quads_.push_back({.cornerX = static_cast<float>(low[0]),
                      .cornerY = static_cast<float>(low[1]),
                      .cornerZ = static_cast<float>(low[2]),
                      .edge = edge ? 1.0F : 0.0F,
                      .firstX = sides[0][0],
                      .firstY = sides[0][1],
                      .firstZ = sides[0][2],
                      .secondX = sides[1][0],
                      .secondY = sides[1][1],
                      .secondZ = sides[1][2],
                      .outwardX = normal[0],
                      .outwardY = normal[1],
                      .outwardZ = normal[2]});
  }

 private:
  std::vector<GlassQuad>& quads_;
  size_t axis_;
  double outward_;
};

}  // namespace

std::vector<GlassQuad> glassQuads(const Domain& domain, const Double3& origin) {
  std::vector<GlassQuad> quads;
  Double3 low, high;
  for (size_t a = 0; a < 3; ++a) {
    low[a] = domain.min[a] - origin[a];
    high[a] = domain.max[a] - origin[a];
  }
  const double thick = kThickness * std::max(high[0] - low[0], high[2] - low[2]);
  const auto closed = [&](size_t side) { return (domain.open >> side & 1) == 0; };
  for (const size_t axis : {size_t{0}, size_t{2}})
    for (const size_t upper : {size_t{0}, size_t{1}}) {
      const size_t side = 2 * axis + upper, other = 2 - axis;
      if (!closed(side)) continue;
      double top = high[1];
      if (domain.outflow && sideBit(domain.outflow->side) == side) top = std::min(top, low[1] + domain.outflow->level);
      PaneFaces faces(quads, axis, upper ? 1 : -1);
      const double outer = upper ? high[axis] + thick : low[axis] - thick, inner = upper ? high[axis] : low[axis];
      const double band = std::min(kPolished * thick, 0.25 * (top - low[1])), base = std::min(thick, 0.25 * (top - low[1]));
      // Along the pane: panes across x cover the corners of the tank.
      const double before = closed(2 * other) ? thick : 0, after = closed(2 * other + 1) ? thick : 0;
      const auto strip = [&](double from, double to, double bottom, double up, bool edge) {
        Double3 a{0, bottom, 0}, b{0, up, 0};
        a[axis] = b[axis] = outer;
        a[other] = from;
        b[other] = to;
        faces.add(a, b, edge);
      };
      strip(low[other], high[other], low[1] + base, top - band, false);
      strip(low[other], high[other], top - band, top, true);
      strip(low[other], high[other], low[1], low[1] + base, true);
      strip(low[other] - before, low[other], low[1], top, true);
      strip(high[other], high[other] + after, low[1], top, true);
      Double3 a{0, top, 0}, b{0, top, 0};
      a[axis] = std::min(inner, outer);
      b[axis] = std::max(inner, outer);
      a[other] = low[other] - (axis == 0 ? before : 0);
      b[other] = high[other] + (axis == 0 ? after : 0);
      faces.add(a, b, true);
    }
  return quads;
}

Expected<std::optional<GlassTank>> GlassTank::create(Device& device, const Domain& domain, const Double3& origin,
                                                     const TargetFormats& formats, bool environment) {
  const std::vector<GlassQuad> quads = glassQuads(domain, origin);
  if (quads.empty()) return std::optional<GlassTank>{};
  bringViewShaders(device);
  GlassTank out;
  out.count_ = static_cast<uint32_t>(quads.size());
  auto buffer = createBuffer(device, "view: glass", quads.size() * sizeof(GlassQuad), MemoryKind::Upload);
  if (!buffer) return buffer.error();
  out.quads_ = *std::move(buffer);
  std::memcpy(out.quads_.mapped(), quads.data(), out.quads_.size());
  for (const bool front : {false, true}) {
    const std::string name = front ? "views/glass_front" : "views/glass_behind";
    const std::string vertex = name + "_vertex", fragment = name + (environment ? "_environment_fragment" : "_fragment");
    auto made = graphicsPipeline(device, {.vertex = vertex,
                                          .fragment = fragment,
                                          .colors = {&formats.color, 1},
                                          .depth = formats.depth,
                                          .depthCompare = VK_COMPARE_OP_GREATER,
                                          .depthWrite = false,
                                          .blend = Blend::Premultiplied});
    if (!made) return made.error();
    (front ? out.front_ : out.behind_) = *made;
  }
  return std::optional<GlassTank>{std::move(out)};
}

void GlassTank::addTo(Graph& graph, SceneTargets& targets, const surface::SurfacePush& camera, Part part, BufferRef look,
                      BufferRef texels) const {
  const bool front = part == Part::Front;
  const BufferRef quads = graph.import("view glass", {quads_.handle(), 0, quads_.size(), Use::Nothing, Use::Nothing});
  graph.pass(front ? "glass before fluid" : "glass behind fluid", [&](Pass& pass) {
    targets.color = pass.write(targets.color, Use::ColorTarget);
    targets.depth = pass.write(targets.depth, Use::DepthTarget);
    const Kernel kernel = bindNamed(pass, front ? front_ : behind_,
                                    {{"quads", quads}, {"look", std::as_const(look)}, {"environment", std::as_const(texels)}});
    return [kernel, camera, count = count_](Commands& commands) { commands.draw(kernel, kQuadVertices, count, camera); };
  });
}

}  // namespace rill
