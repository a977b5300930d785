// Designated initializers with some fields must compile without warnings under -Wextra: all fields have defaults.
#include <rill/fluid.hpp>
#include <rill/fluid_renderer.hpp>
#include <rill/offline.hpp>
#include <rill/pipeline.hpp>
#include <rill/scene_io.hpp>
#include <rill/surface_mesher.hpp>
#include <rill/whitewater.hpp>

void describe() {
  (void)rill::HostDevice{.queueFamily = 1};
  (void)rill::MemoryRequest{.mapped = true};
  (void)rill::BufferImport{.size = 4};
  (void)rill::ImageImport{.before = rill::Use::Present};
  (void)rill::ComputePipelineDesc{.shader = "blur"};
  (void)rill::GraphicsPipelineDesc{.vertex = "quad"};
  (void)rill::FluidDesc{.settle = false};
  (void)rill::FluidStep{.advance_s = 0.01};
  (void)rill::FluidState{.capacity = 1};
  (void)rill::SolidTarget{.solid = 1};
  (void)rill::FluidView{.width = 640};
  (void)rill::FluidLook{.opaque = true};
  (void)rill::TargetFormats{.color = VK_FORMAT_R8G8B8A8_SRGB};
  (void)rill::SurfaceMesherDesc{.cell = 0.25};
  (void)rill::WhitewaterDesc{.room = 100};
  (void)rill::EnvironmentPicture{.width = 4};
  (void)rill::Fill{.jitter = 0.1};
  (void)rill::Solid{.friction = 0.1};
  (void)rill::Probe{.name = "level"};
  (void)rill::FluidSettings{.spacing = 0.1};
  (void)rill::SolverSettings{.cfl = 0.2};
  (void)rill::Scene{.duration = 2};
  (void)rill::ParticleSet{.leftOutSolid = 1};
  (void)rill::Override{.key = "fluid.spacing"};
  (void)rill::Error{.kind = rill::ErrorKind::Io};
  (void)rill::offline::Options{.validation = true};
}
