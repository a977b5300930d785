#pragma once
// What the window shows, as passes of our own graph: a picture stretched over an area of it, and Dear ImGui's draw lists over that.
#include <imgui.h>

#include <memory>
#include <vector>

#include "gpu/resources.hpp"
#include "rill/graph.hpp"
#include "view/layout.hpp"

namespace rill::view {

/// A picture of RGBA8 words in sRGB, rows from the top.
struct ShownPicture {
  BufferRef pixels;
  uint32_t width = 0, height = 0;
  Area area;  ///< of the window, over which it is stretched
};

class WindowPass {
 public:
  /// `target`: the format of the images that are drawn to, of linear bytes (UNORM). `fonts` has been built; its texture is copied.
  static Expected<std::unique_ptr<WindowPass>> create(Device& device, VkFormat target, ImFontAtlas& fonts);

  /// Brings the lists to the device, once a frame. They are kept until the graph has been recorded.
  void upload(Graph& graph, const ImDrawData& lists);
  /// Draws all of `target`; `behind` is what there is where the picture is not, or is transparent.
  ImageRef draw(Graph& graph, ImageRef target, const ShownPicture& picture, const ImVec4& behind) const;

 private:
  struct Part {
    uint32_t x, y, width, height;  ///< pixels that it may draw to
    uint32_t firstIndex, indices;
  };

  const GraphicsPipeline *ui_ = nullptr, *picture_ = nullptr;
  Buffer font_;
  uint32_t fontWidth_ = 0, fontHeight_ = 0;
  std::vector<ImDrawVert> vertices_;
  std::vector<uint32_t> indices_;
  std::vector<Part> parts_;
  BufferRef vertexRef_, indexRef_, fontRef_;
};

}  // namespace rill::view
