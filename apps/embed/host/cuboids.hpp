#pragma once
// Draws cuboids in render passes, into a color and a reversed depth buffer.
#include "camera.hpp"
#include "engine.hpp"

namespace host {

struct Cuboid {
  float low[3], high[3], color[3];
  Matrix pose = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};  ///< to the world: rotation and translation
};

class Cuboids {
 public:
  Cuboids(Engine& engine, const Image& color, const Image& depth);
  ~Cuboids();
  Cuboids(const Cuboids&) = delete;
  Cuboids& operator=(const Cuboids&) = delete;

  /// Draws in a render pass that clears both images.
  void drawFirst(const Frame& frame, const Matrix& clipFromWorld, const Cuboid* cuboids, uint32_t count);
  /// Draws in a render pass that loads both images, with depth test.
  void drawOver(const Frame& frame, const Matrix& clipFromWorld, const Cuboid* cuboids, uint32_t count);

 private:
  VkRenderPass makePass(VkAttachmentLoadOp load, VkImageLayout color, VkImageLayout depth);
  void draw(VkRenderPass pass, const Frame& frame, const Matrix& clipFromWorld, const Cuboid* cuboids, uint32_t count);
  Engine& engine_;
  const Image &color_, &depth_;
  VkRenderPass first_ = VK_NULL_HANDLE, over_ = VK_NULL_HANDLE;
  VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace host
