#include "view/display.hpp"

#include <algorithm>
#include <cmath>

#include "graph/import_whole.hpp"

namespace rill::view {

Expected<std::unique_ptr<Display>> Display::create(offline::Context& context, Window& window, ImFontAtlas& fonts, VkPresentModeKHR mode) {
  auto surface = window.surface(context.instance());
  if (!surface) return surface.error();
  std::unique_ptr<Display> made(new Display(context));
  auto swapchain = Swapchain::create(context, *surface, mode);
  if (!swapchain) return swapchain.error();
  made->swapchain_ = std::move(*swapchain);
  auto pass = WindowPass::create(context.device(), made->swapchain_->format(), fonts);
  if (!pass) return pass.error();
  made->pass_ = std::move(*pass);
  made->window_.enableTimings(false);
  return made;
}

void Display::choose(VkPresentModeKHR mode) {
  stale_ |= mode != swapchain_->mode();
  swapchain_->choose(mode);
}

Expected<void> Display::fit(Window::Size size) {
  stale_ |= size.width != size_.width || size.height != size_.height;
  if (!stale_) return {};
  size_ = size;
  stale_ = false;
  return swapchain_->make(size.width, size.height);
}

Expected<void> Display::paint(Session& session, std::string_view view, const CameraView& eye, const Area& area, double scale,
                              double time_s) {
  const auto side = [&](uint32_t pixels) { return std::max(1u, static_cast<uint32_t>(std::lround(pixels * scale))); };
  const uint32_t width = side(area.width), height = side(area.height);
  if (auto ready = session.painter().prepare(context_.device(), view, width, height); !ready) return ready;
  const uint64_t bytes = uint64_t{width} * height * 4;
  if (shown_.size() != bytes) {
    auto made = createBuffer(context_.device(), "shown picture", bytes);
    if (!made) return made.error();
    shown_ = std::move(*made);
  }
  shownWidth_ = width;
  shownHeight_ = height;
  area_ = area;
  auto frame = context_.beginFrame();
  if (!frame) return frame.error();
  picture_.reset();
  const FluidState fluid = session.runner().present(picture_);
  const BufferRef drawn = session.painter().addTo(picture_, fluid, view, eye, width, height, time_s, offline::PixelKind::Display,
                                                  session.runner().presentWhitewater(picture_, fluid));
  BufferRef shown = importWhole(picture_, "shown picture", shown_);
  picture_.pass("show", [&](Pass& pass) {
    pass.read(drawn, Use::CopySource);
    shown = pass.write(shown, Use::CopyTarget, true);
    return [drawn, shown, bytes](Commands& commands) { commands.copy(drawn, shown, bytes); };
  });
  timing_ = frame->recording;
  return context_.run(picture_);
}

std::optional<double> Display::pictureSeconds() {
  if (!timing_ || picture_.timings().empty()) return std::nullopt;
  double ms = 0;
  for (const Timing& timing : picture_.timings()) ms += timing.ms;
  timing_.reset();
  return ms * 1e-3;
}

Expected<void> Display::show(const ImDrawData& lists, const ImVec4& behind, offline::Image* screenshot) {
  auto acquired = swapchain_->acquire();
  if (!acquired) return acquired.error();
  if (!*acquired) {
    stale_ = true;
    return {};
  }
  const Swapchain::Target& target = **acquired;
  if (auto frame = context_.beginFrame(); !frame) return frame.error();
  window_.reset();
  const ShownPicture picture{importWhole(window_, "shown picture", shown_), shownWidth_, shownHeight_, area_};
  pass_->upload(window_, lists);
  const SurfaceFormat& format = swapchain_->format();
  const ImageDesc desc{format.canvas, target.width, target.height};
  const ImageRef image = window_.import("window", {target.image, {format.format, target.width, target.height}, Use::Unknown, Use::Present});
  ImageRef canvas = pass_->draw(window_, format.isCanvas() ? image : window_.create("canvas", desc), picture, behind);
  if (!format.isCanvas()) static_cast<void>(pass_->copy(window_, canvas, image));
  Ticket ticket;
  if (screenshot) {  // the window's own image cannot be copied from
    const ImageRef copied = format.isCanvas() ? pass_->draw(window_, window_.create("screenshot", desc), picture, behind) : canvas;
    BufferRef bytes = window_.create("screenshot bytes", {uint64_t{target.width} * target.height * 4});
    window_.pass("screenshot", [&](Pass& pass) {
      pass.read(copied, Use::CopySource);
      bytes = pass.write(bytes, Use::CopyTarget, true);
      return [copied, bytes](Commands& commands) { commands.copy(copied, bytes); };
    });
    ticket = window_.readback(bytes);
  }
  if (auto compiled = window_.compile(); !compiled) return compiled;
  if (auto prepared = window_.prepare(context_.device()); !prepared) return prepared;
  const auto record = [&](VkCommandBuffer commands) { window_.record(commands); };
  if (auto ran = context_.submit(record, {.wait = {&target.ready, 1}, .signal = {&target.drawn, 1}}); !ran) return ran;
  auto presented = swapchain_->present(target);
  if (!presented) return presented.error();
  stale_ |= !*presented;
  if (!screenshot) return {};

  if (auto waited = context_.wait(); !waited) return waited;
  const auto bytes = window_.data(ticket);
  *screenshot = {target.width, target.height, {}};
  screenshot->rgba.resize(bytes.size());
  const bool swapped = format.canvas == VK_FORMAT_B8G8R8A8_UNORM;
  for (size_t at = 0; at + 3 < bytes.size(); at += 4)
    for (size_t c = 0; c < 4; ++c) screenshot->rgba[at + c] = static_cast<uint8_t>(bytes[at + (swapped && c < 3 ? 2 - c : c)]);
  return {};
}

}  // namespace rill::view
