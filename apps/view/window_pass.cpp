#include "view/window_pass.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include "gpu/device_impl.hpp"
#include "gpu/shader_constants.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/import_whole.hpp"
#include "graph/shader_pass.hpp"

namespace rill {
std::span<const EmbeddedShader> viewShaders();
}

namespace rill::view {
namespace {

static_assert(sizeof(ImDrawVert) == 20, "shaders/ui.vert reads five words a vertex");

struct UiPush {
  float clipMin[2], clipSize[2];
  uint32_t firstIndex, fontWidth, fontHeight;
};
struct PicturePush {
  uint32_t size[2];
  float scale[2];
  float corner[2];
  float unused[2];
  float behind[4];
};

/// Rounds up to a power of two, so that the graph's memory plan rarely changes.
uint64_t roundedSize(uint64_t bytes) { return std::max<uint64_t>(std::bit_ceil(bytes), 64 << 10); }

template <class Record>
BufferRef uploaded(Graph& graph, std::string_view name, const std::vector<Record>& records) {
  BufferRef buffer = graph.create(name, {roundedSize(records.size() * sizeof(Record))});
  graph.pass("ui upload", [&](Pass& pass) {
    buffer = pass.write(buffer, Use::CopyTarget, true);
    return [buffer, bytes = std::as_bytes(std::span(records))](Commands& commands) {
      constexpr size_t kMaxUpdate = 64 << 10;  // bytes
      for (size_t at = 0; at < bytes.size(); at += kMaxUpdate)
        commands.update(buffer, bytes.subspan(at, std::min(kMaxUpdate, bytes.size() - at)), at);
    };
  });
  return buffer;
}

}  // namespace

Expected<std::unique_ptr<WindowPass>> WindowPass::create(Device& device, const SurfaceFormat& format, ImFontAtlas& fonts) {
  auto made = std::make_unique<WindowPass>();
  const VkFormat colors[] = {format.canvas};
  implOf(device).shaders.add(viewShaders());
  const auto variant = [&](const char* shader) { return texelVariant(device, shader, usesTexelReads(device)); };
  const std::string uiFragment = variant("view/ui_fragment"), pictureFragment = variant("view/picture_fragment");
  auto ui = graphicsPipeline(device, {.vertex = "view/ui_vertex", .fragment = uiFragment, .colors = colors, .blend = Blend::Premultiplied});
  if (!ui) return ui.error();
  made->ui_ = *ui;
  auto picture = graphicsPipeline(device, {.vertex = "view/picture_vertex", .fragment = pictureFragment, .colors = colors});
  if (!picture) return picture.error();
  made->picture_ = *picture;
  if (!format.isCanvas()) {
    const VkFormat target[] = {format.format};
    const uint32_t encodes[] = {format.encodes};
    auto surface = graphicsPipeline(
        device, {.vertex = "view/picture_vertex", .fragment = "view/surface_fragment", .constants = encodes, .colors = target});
    if (!surface) return surface.error();
    made->surface_ = *surface;
  }

  unsigned char* texels = nullptr;
  int width = 0, height = 0;
  fonts.GetTexDataAsAlpha8(&texels, &width, &height);
  const size_t bytes = static_cast<size_t>(width) * static_cast<size_t>(height);
  const uint64_t wholeWords = (bytes + 3) / 4 * 4;
  auto staging = createBuffer(device, "font staging", wholeWords, MemoryKind::Upload);
  if (!staging) return staging.error();
  auto font = createBuffer(device, "font", wholeWords);
  if (!font) return font.error();
  std::memcpy(staging->mapped(), texels, bytes);
  made->fontStaging_ = std::move(*staging);
  made->font_ = std::move(*font);
  made->fontWidth_ = static_cast<uint32_t>(width);
  made->fontHeight_ = static_cast<uint32_t>(height);
  return made;
}

void WindowPass::upload(Graph& graph, const ImDrawData& lists) {
  vertices_.clear();
  indices_.clear();
  parts_.clear();
  for (int l = 0; l < lists.CmdListsCount; ++l) {
    const ImDrawList& list = *lists.CmdLists[l];
    const auto firstVertex = static_cast<uint32_t>(vertices_.size()), firstIndex = static_cast<uint32_t>(indices_.size());
    vertices_.insert(vertices_.end(), list.VtxBuffer.begin(), list.VtxBuffer.end());
    indices_.insert(indices_.end(), list.IdxBuffer.begin(), list.IdxBuffer.end());
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const auto clamped = [](float v, float limit) { return static_cast<uint32_t>(std::clamp(v, 0.0f, limit)); };
      const uint32_t x0 = clamped(std::floor(command.ClipRect.x), lists.DisplaySize.x),
                     x1 = clamped(command.ClipRect.z, lists.DisplaySize.x);
      const uint32_t y0 = clamped(std::floor(command.ClipRect.y), lists.DisplaySize.y),
                     y1 = clamped(command.ClipRect.w, lists.DisplaySize.y);
      if (command.UserCallback || command.ElemCount == 0 || x1 <= x0 || y1 <= y0) continue;
      const Part part{x0, y0, x1 - x0, y1 - y0, firstIndex + command.IdxOffset, command.ElemCount};
      for (uint32_t i = 0; i < part.indices; ++i) indices_[part.firstIndex + i] += firstVertex + command.VtxOffset;
      parts_.push_back(part);
    }
  }
  if (parts_.empty()) return;
  vertexRef_ = uploaded(graph, "ui vertices", vertices_);
  indexRef_ = uploaded(graph, "ui indices", indices_);
  fontRef_ = importWhole(graph, "font", font_);
  if (fontCopied_) {
    fontStaging_ = {};
    return;
  }
  const BufferRef staging = graph.import("font staging", {fontStaging_.handle(), 0, fontStaging_.size(), Use::Nothing, Use::Nothing});
  graph.pass("font upload", [&](Pass& pass) {
    pass.read(staging, Use::CopySource);
    fontRef_ = pass.write(fontRef_, Use::CopyTarget, true);
    return [this, staging, font = fontRef_](Commands& commands) {
      commands.copy(staging, font, font_.size());
      fontCopied_ = true;
    };
  });
}

ImageRef WindowPass::draw(Graph& graph, ImageRef canvas, const ShownPicture& picture, const ImVec4& behind) const {
  graph.pass("window", [&](Pass& pass) {
    const VkClearValue clear{.color = {.float32 = {behind.x, behind.y, behind.z, 1}}};
    canvas = pass.write(canvas, Use::ColorTarget, Load::Clear, clear);
    const Kernel stretched = bindNamed(pass, picture_, {{"picture", picture.pixels}});
    Kernel ui;
    if (!parts_.empty()) ui = bindNamed(pass, ui_, {{"vertices", vertexRef_}, {"indices", indexRef_}, {"font", fontRef_}});
    const auto over = [](uint32_t a, uint32_t b) { return static_cast<float>(a) / static_cast<float>(b); };
    const Area area = picture.area;
    const PicturePush push{{picture.width, picture.height},
                           {over(picture.width, area.width), over(picture.height, area.height)},
                           {static_cast<float>(area.x), static_cast<float>(area.y)},
                           {},
                           {behind.x, behind.y, behind.z, 1}};
    return [this, stretched, ui, push, area](Commands& commands) {
      commands.viewport(area.x, area.y, area.width, area.height);
      commands.draw(stretched, 3, 1, push);
      for (const Part& p : parts_) {
        commands.viewport(p.x, p.y, p.width, p.height);
        const UiPush uiPush{{static_cast<float>(p.x), static_cast<float>(p.y)},
                            {static_cast<float>(p.width), static_cast<float>(p.height)},
                            p.firstIndex,
                            fontWidth_,
                            fontHeight_};
        commands.draw(ui, p.indices, 1, uiPush);
      }
    };
  });
  return canvas;
}

ImageRef WindowPass::copy(Graph& graph, ImageRef canvas, ImageRef target) const {
  graph.pass("window copy", [&](Pass& pass) {
    pass.read(canvas, Use::DrawSampled);
    target = pass.write(target, Use::ColorTarget, Load::Discard);
    const Kernel copied = pass.kernel(surface_, {canvas});
    return [copied](Commands& commands) { commands.draw(copied, 3, 1); };
  });
  return target;
}

}  // namespace rill::view
