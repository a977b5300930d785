#pragma once
// Passes that draw the window: the image of the scene stretched over an area, and Dear ImGui's draw lists over it.
#include <imgui.h>

#include <memory>
#include <vector>

#include "gpu/resources.hpp"
#include "rill/graph.hpp"
#include "view/layout.hpp"
#include "view/surface_format.hpp"

namespace rill::view {

/// An RGBA8 image in sRGB, rows from the top.
struct ShownPicture {
  BufferRef pixels;
  uint32_t width = 0, height = 0;
  Area area;  ///< of the window that it fills
};

class WindowPass {
 public:
  /// `fonts` must be built; its texture is copied.
  static Expected<std::unique_ptr<WindowPass>> create(Device& device, const SurfaceFormat& format, ImFontAtlas& fonts);

  /// Uploads the draw lists, once per frame. They are kept until the graph is recorded.
  void upload(Graph& graph, const ImDrawData& lists);
  /// Draws all of `canvas`, an image of the format SurfaceFormat::canvas, with the background color `behind`.
  ImageRef draw(Graph& graph, ImageRef canvas, const ShownPicture& picture, const ImVec4& behind) const;
  /// Copies a canvas to `target`, an image of another format. Only where SurfaceFormat::isCanvas() is false.
  ImageRef copy(Graph& graph, ImageRef canvas, ImageRef target) const;

 private:
  struct Part {
    uint32_t x, y, width, height;  ///< clip rectangle, pixels
    uint32_t firstIndex, indices;
  };

  const GraphicsPipeline *ui_ = nullptr, *picture_ = nullptr, *surface_ = nullptr;
  Buffer font_;
  Buffer fontStaging_;  ///< until it has been copied to font_
  bool fontCopied_ = false;
  uint32_t fontWidth_ = 0, fontHeight_ = 0;
  std::vector<ImDrawVert> vertices_;
  std::vector<uint32_t> indices_;
  std::vector<Part> parts_;
  BufferRef vertexRef_, indexRef_, fontRef_;
};

}  // namespace rill::view
