#include "render/surface_rig.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>

namespace rill::test {
namespace {

uint32_t texelBytes(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R8G8B8A8_UNORM:
    case VK_FORMAT_R8G8B8A8_SRGB:
      return 4;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      return 8;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      return 16;
    default:
      ADD_FAILURE() << "unexpected format " << format;
      return 16;
  }
}

double decodedSrgb(double stored) { return stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4); }

}  // namespace

double encodedSrgb(double linear) { return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055; }

std::vector<std::array<double, 4>> Drawn::channels(VkFormat format) const {
  const uint32_t bytes = texelBytes(format);
  std::vector<std::array<double, 4>> out(color.size() / bytes);
  for (size_t i = 0; i < out.size(); ++i)
    for (size_t c = 0; c < 4; ++c) {
      const std::byte* at = color.data() + i * bytes + c * (bytes / 4);
      double& value = out[i][c];
      if (bytes == 16) {
        float single;
        std::memcpy(&single, at, 4);
        value = double{single};
      } else if (bytes == 8) {
        uint16_t half;
        std::memcpy(&half, at, 2);
        value = double{glm::unpackHalf1x16(half)};
      } else {
        value = std::to_integer<int>(*at) / 255.0;
        if (format == VK_FORMAT_R8G8B8A8_SRGB && c < 3) value = decodedSrgb(value);
      }
    }
  return out;
}

FluidView SurfaceOnGpu::looking(Vector eye, Vector target, uint32_t width, uint32_t height) {
  CameraView camera;
  camera.eye = {eye.x, eye.y, eye.z};
  camera.target = {target.x, target.y, target.z};
  camera.fov_y_deg = 45;
  return fluidView(camera, width, height, double{kSpacing});
}

FluidView SurfaceOnGpu::perspective(double focus) { return looking({0, 0, 0}, {0, 0, -focus}, kWidth, kHeight); }

FluidView SurfaceOnGpu::orthographic(double halfHeight, FluidView eye) {
  const float h = static_cast<float>(halfHeight), w = h * float(eye.width) / float(eye.height);
  eye.projection = {{{1 / w, 0, 0, 0}, {0, -1 / h, 0, 0}, {0, 0, -0.01f, 0}, {0, 0, 0, 1}}};
  return eye;
}

FluidView SurfaceOnGpu::finite(FluidView view, double near, double far, bool reversed) {
  const double from = reversed ? far : near, to = reversed ? near : far;  // where depth is 0, where 1
  view.projection.column[2].z = static_cast<float>(to / (from - to));
  view.projection.column[3].z = static_cast<float>(from * to / (from - to));
  return view;
}

void SurfaceOnGpu::fill(const std::vector<Float4>& positions) {
  count_ = uint32_t(positions.size());
  if (count_ > 0) position_ = upload("position", positions);
}

FluidState SurfaceOnGpu::state(Graph& graph) {
  FluidState fluid;
  fluid.capacity = count_;
  fluid.spacing = kSpacing;
  if (count_ > 0) fluid.position = graph.import("position", importOf(position_));
  return fluid;
}

FluidRendererImpl& SurfaceOnGpu::renderer() {
  if (!renderer_) {
    auto made = FluidRenderer::create(device());
    EXPECT_TRUE(made) << made.error().message;
    renderer_ = std::move(*made);
  }
  return implOf(*renderer_);
}

void SurfaceOnGpu::fillTransients(Graph& graph, int run) {
  const float left = run == 0 ? std::numeric_limits<float>::quiet_NaN() : 4.1f;
  graph.reset();
  BufferRef buffers = graph.create("transient fill", {uint64_t{32} << 20});
  graph.pass("transient fill", [&](Pass& pass) {
    buffers = pass.write(buffers, Use::CopyTarget, true);
    pass.sideEffect();
    return [buffers, left](Commands& commands) { commands.fill(buffers, std::bit_cast<uint32_t>(left)); };
  });
  GpuTest::run(graph);
  graph.reset();
}

std::vector<Pixel> SurfaceOnGpu::surface(const FluidView& view, SurfaceMethod method) {
  EXPECT_TRUE(FluidRenderer::check(view));
  std::vector<uint32_t> first;
  const auto storage = SurfaceStage::create(device(), true);
  EXPECT_TRUE(storage);
  Graph graph;
  for (int run = 0; run < 2; ++run) {
    fillTransients(graph, run);
    const FluidState fluid = state(graph);
    SurfaceBuffers found =
        (run == 0 ? renderer().surface : *storage).addTo(graph, fluid, renderer().camera(fluid, view), method, true, view.focus_m);
    const Ticket ticket = graph.readback(found.pixels);
    GpuTest::run(graph);
    auto words = read<uint32_t>(graph, ticket);
    if (run == 0)
      first = std::move(words);
    else
      EXPECT_EQ(first, words) << "pictures of two runs differ";
  }
  std::vector<Pixel> pixels(first.size() / 2);
  for (size_t i = 0; i < pixels.size(); ++i) {
    const auto [depth, n] = unpackPixel(&first[2 * i]);
    pixels[i] = {depth, {n[0], n[1], n[2]}};
  }
  return pixels;
}

SceneTargets SurfaceOnGpu::hosts(Graph& graph, const TargetFormats& formats, uint32_t width, uint32_t height, const Backdrop& backdrop) {
  SceneTargets targets{graph.create("color", {formats.color, width, height}), graph.create("depth", {formats.depth, width, height})};
  VkClearValue color{}, depth{};
  std::copy_n(backdrop.color.data(), 4, color.color.float32);
  depth.depthStencil = {backdrop.depth, 0};
  const auto copied = [&](Buffer& held, const auto& values, ImageRef target) {
    EXPECT_EQ(values.size(), size_t{width} * height);
    held = upload("backdrop", values);
    const BufferRef texels = graph.import("backdrop", importOf(held));
    graph.pass("backdrop", [&](Pass& pass) {
      pass.read(texels, Use::CopySource);
      target = pass.write(target, Use::CopyTarget);
      return [texels, target](Commands& commands) { commands.copy(texels, target); };
    });
    return target;
  };
  if (!backdrop.pixels.empty()) targets.color = copied(backdrop_, backdrop.pixels, targets.color);
  if (!backdrop.depths.empty()) targets.depth = copied(backdropDepth_, backdrop.depths, targets.depth);
  if (!backdrop.pixels.empty() && !backdrop.depths.empty()) return targets;
  graph.pass("clear", [&](Pass& pass) {
    if (backdrop.pixels.empty()) targets.color = pass.write(targets.color, Use::ColorTarget, Load::Clear, color);
    if (backdrop.depths.empty()) targets.depth = pass.write(targets.depth, Use::DepthTarget, Load::Clear, depth);
    return [](Commands&) {};
  });
  return targets;
}

Drawn SurfaceOnGpu::drawn(const FluidView& view, const FluidLook& look, const Backdrop& backdrop, const TargetFormats& formats,
                          uint32_t width, uint32_t height) {
  EXPECT_TRUE(FluidRenderer::check(view));
  if (width == 0) width = view.x + view.width;
  if (height == 0) height = view.y + view.height;
  auto made = FluidRenderer::create(device(), formats);
  EXPECT_TRUE(made) << made.error().message;
  if (!made) return {};
  if (!bodies_.empty()) { EXPECT_TRUE(made->setFluids(bodies_)); }
  if (environment_) { EXPECT_TRUE(made->setEnvironment(*environment_)); }
  Drawn first;
  Graph graph;
  for (int run = 0; run < 2; ++run) {
    fillTransients(graph, run);
    const FluidState fluid = state(graph);
    const SceneTargets targets = made->addTo(graph, fluid, hosts(graph, formats, width, height, backdrop), view, look);
    const uint64_t pixels = uint64_t{width} * height;
    BufferRef color = graph.create("color texels", {pixels * texelBytes(formats.color)});
    BufferRef depth = graph.create("depth texels", {pixels * 4});
    graph.pass("copy", [&](Pass& pass) {
      pass.read(targets.color, Use::CopySource);
      pass.read(targets.depth, Use::CopySource);
      color = pass.write(color, Use::CopyTarget);
      depth = pass.write(depth, Use::CopyTarget);
      return [=](Commands& commands) {
        commands.copy(targets.color, color);
        commands.copy(targets.depth, depth);
      };
    });
    const Ticket colorTicket = graph.readback(color), depthTicket = graph.readback(depth);
    GpuTest::run(graph);
    Drawn out{read<std::byte>(graph, colorTicket), read<float>(graph, depthTicket)};
    EXPECT_EQ(out.color.size(), pixels * texelBytes(formats.color));
    if (run == 0) {
      first = std::move(out);
    } else {
      EXPECT_TRUE(first.color == out.color) << "pictures of two runs differ";
      EXPECT_TRUE(std::memcmp(first.depth.data(), out.depth.data(), out.depth.size() * 4) == 0) << "depths of two runs differ";
    }
  }
  return first;
}

std::vector<Float4> SurfaceOnGpu::block(Vector low, Vector high, double jitter) {
  std::uniform_real_distribution<double> wobble(-jitter * kSpacing, jitter * kSpacing);
  std::vector<Float4> out;
  for (double z = low.z + 0.5 * kSpacing; z < high.z; z += kSpacing)
    for (double y = low.y + 0.5 * kSpacing; y < high.y; y += kSpacing)
      for (double x = low.x + 0.5 * kSpacing; x < high.x; x += kSpacing)
        out.push_back({float(x + wobble(random_)), float(y + wobble(random_)), float(z + wobble(random_)), 0});
  return out;
}

std::vector<Float4> SurfaceOnGpu::under(Vector point, Vector normal, Vector u, Vector v, double extent) {
  std::uniform_real_distribution<double> along(-0.25 * kSpacing, 0.25 * kSpacing), across(-0.1 * kSpacing, 0.1 * kSpacing);
  std::vector<Float4> out;
  for (int layer = 0; layer < 4; ++layer)
    for (double a = -extent; a < extent; a += kSpacing)
      for (double b = -extent; b < extent; b += kSpacing) {
        const double p = a + along(random_), q = b + along(random_), h = -(layer + 0.5) * kSpacing + across(random_);
        out.push_back({float(point.x + p * u.x + q * v.x + h * normal.x), float(point.y + p * u.y + q * v.y + h * normal.y),
                       float(point.z + p * u.z + q * v.z + h * normal.z), 0});
      }
  return out;
}

std::vector<Float4> SurfaceOnGpu::shells(Vector center, double radius) {
  std::uniform_real_distribution<double> wobble(-0.1 * kSpacing, 0.1 * kSpacing);
  std::vector<Float4> out;
  for (double r = radius - 0.5 * kSpacing; r > 0; r -= kSpacing) {
    const int count = std::max(1, int(4 * std::numbers::pi * r * r / (kSpacing * kSpacing)));
    for (int k = 0; k < count; ++k) {
      const double z = 1 - (2 * k + 1.0) / count, angle = 2.399963 * k, s = std::sqrt(1 - z * z);
      out.push_back({float(center.x + r * s * std::cos(angle) + wobble(random_)),
                     float(center.y + r * s * std::sin(angle) + wobble(random_)), float(center.z + r * z + wobble(random_)), 0});
    }
  }
  return out;
}

std::vector<Float4> SurfaceOnGpu::scattered(Vector low, Vector high, uint32_t count) {
  std::uniform_real_distribution<double> x(low.x, high.x), y(low.y, high.y), z(low.z, high.z);
  std::vector<Float4> out(count);
  for (Float4& p : out) p = {float(x(random_)), float(y(random_)), float(z(random_)), 0};
  return out;
}

}  // namespace rill::test
