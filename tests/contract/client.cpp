#include "contract/client.hpp"

namespace rill::test {
namespace {

constexpr uint32_t kWidth = 48, kHeight = 32;

/// A block of 512 particles that falls into a corner of a box, and a sphere driven into it by the host.
Scene tank() {
  Scene scene;
  scene.fluid.spacing = 1.0 / 16;
  scene.domain = Domain{};
  scene.fill.resize(1);
  scene.fill[0].shape = BoxShape{{0, 0.25, 0}, {0.5, 0.75, 0.5}};
  scene.solids.resize(1);
  scene.solids[0].shape = SphereShape{{0.66, 0.5, 0.25}, 0.15};
  scene.solids[0].driven = 2;
  return scene;
}

/// A camera 2.5 m in front of the box with a horizontal field of view of 40 degrees.
FluidView viewOf(const FluidState& fluid) {
  FluidView view;
  view.view.column[3] = {-0.5f, -0.5f, -3, 1};
  constexpr float near = 0.1f, far = 10, zoom = 2.7f;
  view.projection = {
      {{zoom * kHeight / kWidth, 0, 0, 0}, {0, -zoom, 0, 0}, {0, 0, far / (near - far), -1}, {0, 0, near * far / (near - far), 0}}};
  for (int a = 0; a < 3; ++a) view.origin[a] = fluid.origin[a];
  view.width = kWidth;
  view.height = kHeight;
  view.focus_m = 2.5;
  return view;
}

}  // namespace

Expected<std::unique_ptr<Client>> Client::open(Host& host, const HostDevice& hostDevice, bool draws) {
  host.interceptor.currentCall = "create";
  std::unique_ptr<Client> client(new Client(host));
  auto device = Device::borrow(hostDevice);
  if (!device) return device.error();
  client->device_ = std::make_unique<Device>(*std::move(device));
  Scene scene = tank();
  auto particles = makeParticles(scene, 10000);
  if (!particles) return particles.error();
  auto fluid = Fluid::create(*client->device_, {.scene = &scene, .particles = &*particles});
  if (!fluid) return fluid.error();
  client->fluid_ = std::make_unique<Fluid>(*std::move(fluid));
  client->draws = draws;
  if (!draws) return client;
  auto renderer = FluidRenderer::create(*client->device_);
  if (!renderer) return renderer.error();
  client->renderer_ = std::make_unique<FluidRenderer>(*std::move(renderer));
  const EnvironmentPicture sky{2, 1, {sharedExponent(0.5f, 0.6f, 0.9f), sharedExponent(0.9f, 0.6f, 0.5f)}};
  if (auto ok = client->renderer_->setEnvironment(sky); !ok) return ok.error();
  return client;
}

Client::~Client() {
  host_.interceptor.currentCall = "destroy";
  renderer_.reset();
  fluid_.reset();
  graph_.reset();
  host_.interceptor.currentCall = "~Device";
}

void Client::moveHandles() {
  device_ = std::make_unique<Device>(std::move(*device_));
  fluid_ = std::make_unique<Fluid>(std::move(*fluid_));
  renderer_ = std::make_unique<FluidRenderer>(std::move(*renderer_));
  Graph graph = std::move(graph_);
  graph_ = std::move(graph);
}

ImageRef Client::picture(const FluidState& state) {
  SceneTargets targets{graph_.create("color", ImageDesc{VK_FORMAT_R16G16B16A16_SFLOAT, kWidth, kHeight}),
                       graph_.create("depth", ImageDesc{VK_FORMAT_D32_SFLOAT, kWidth, kHeight})};
  graph_.pass("background", [&](Pass& pass) {
    VkClearValue blue{}, far{};
    blue.color = {{0.1f, 0.2f, 0.5f, 1}};
    far.depthStencil = {1, 0};
    targets.color = pass.write(targets.color, Use::ColorTarget, Load::Clear, blue);
    targets.depth = pass.write(targets.depth, Use::DepthTarget, Load::Clear, far);
    return [](Commands&) {};
  });
  return renderer_->addTo(graph_, state, targets, viewOf(state)).color;
}

Ticket Client::readPixels(ImageRef color) {
  BufferRef pixels = graph_.create("pixels", {uint64_t{kWidth} * kHeight * 8});
  graph_.pass("read pixels", [&](Pass& pass) {
    pass.read(color, Use::CopySource);
    pixels = pass.write(pixels, Use::CopyTarget);
    return [=](Commands& commands) { commands.copy(color, pixels); };
  });
  return graph_.readback(pixels);
}

Expected<void> Client::frame(Submission submission, bool completes) {
  ++clock.recording;
  (void)readback();  // marks the last frame's read-backs as read, so that this frame can reuse their memory
  host_.interceptor.currentCall = "declare";
  graph_.reset();
  const SolidTarget target{0, {0.2, 0.5, 0.25}};
  const FluidState state = fluid_->addTo(graph_, {.advance_s = 1.0 / 120, .substeps = 12, .targets = {&target, 1}});
  tickets_ = {graph_.readback(state.position), graph_.readback(state.velocity)};
  if (draws) tickets_.push_back(readPixels(picture(state)));
  auto ok = graph_.compile();
  host_.interceptor.currentCall = "prepare";
  if (ok) ok = graph_.prepare(*device_);
  host_.interceptor.currentCall = "record";
  if (!ok) return ok;
  host_.run([&](VkCommandBuffer commands) { graph_.record(commands); }, submission == Submission::Submitted);
  if (submission == Submission::Abandoned) device_->abandon(clock.recording);
  if (completes) clock.completed = clock.recording;
  return {};
}

std::vector<std::byte> Client::readback() {
  if (clock.completed == clock.recording) ++clock.recording;
  host_.interceptor.currentCall = "beginFrame";
  device_->beginFrame(clock);
  host_.interceptor.currentCall = "read";
  (void)fluid_->progress();
  std::vector<std::byte> all;
  for (const Ticket ticket : tickets_) {
    const auto bytes = graph_.data(ticket);
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  return all;
}

}  // namespace rill::test
