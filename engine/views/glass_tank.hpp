#pragma once
// The domain as a tank of glass: panes on its closed vertical sides, with their edges.
#include <optional>

#include "graph/shader_pass.hpp"
#include "render/surface.hpp"
#include "rill/fluid_renderer.hpp"
#include "rill/scene.hpp"
#include "views/glass_records.h"

namespace rill {

/// The faces of the tank, relative to `origin` (m). Glass lies outside the domain; it is 0.012 of the domain's longer horizontal side
/// thick. An outflow's pane ends at its level. Empty if all sides are open.
std::vector<GlassQuad> glassQuads(const Domain& domain, const Double3& origin);

/// Panes reflect the sky (Fresnel equations, both faces); their edges are green, as light has passed through much glass there.
class GlassTank {
 public:
  /// Empty if there is no glass to draw.
  static Expected<std::optional<GlassTank>> create(Device& device, const Domain& domain, const Double3& origin,
                                                   const TargetFormats& formats, bool environment);

  enum class Part { Behind, Front };  ///< of the fluid
  /// Blends a part over the targets. `look`: a LookRecord; `texels`: of the environment, where there is one.
  void addTo(Graph& graph, SceneTargets& targets, const surface::SurfacePush& camera, Part part, BufferRef look, BufferRef texels) const;

 private:
  Buffer quads_;
  uint32_t count_ = 0;
  const GraphicsPipeline *behind_ = nullptr, *front_ = nullptr;
};

}  // namespace rill
