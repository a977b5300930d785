#pragma once
// A mean of pictures in linear light, which are drawn one after another.
#include "gpu/resources.hpp"
#include "rill/graph.hpp"

namespace rill {

class FilmSum {
 public:
  static constexpr uint64_t kPixelBytes = 16;

  /// The device must have the shaders of engine/views.
  static Expected<FilmSum> create(Device& device);
  /// Makes room for pictures of this size; the sum is lost if it was of another. OutOfMemory; TooLarge for the device's buffers.
  Expected<void> resize(Device& device, uint32_t width, uint32_t height);

  /// Another number after each resize() that lost the sum.
  uint64_t generation() const { return generation_; }

  /// Adds a picture, `color` of the size at hand; `first`: the sum begins with it.
  void add(Graph& graph, ImageRef color, bool first) const;
  /// The mean of `count` summed pictures, multiplied by two to the power of `exposure_stops`: RGBA8 in sRGB, rows from the top.
  BufferRef picture(Graph& graph, uint32_t count, double exposure_stops) const;
  /// The same in linear light, before exposure: RGBA of half floats.
  BufferRef linear(Graph& graph, uint32_t count) const;

 private:
  BufferRef importSum(Graph& graph) const;
  BufferRef mean(Graph& graph, std::string_view name, const ComputePipeline* pipeline, uint64_t bytes, double gain) const;

  const ComputePipeline *add_ = nullptr, *tone_ = nullptr, *linear_ = nullptr;
  Buffer sum_;
  uint32_t width_ = 0, height_ = 0;
  uint64_t generation_ = 0;
};

}  // namespace rill
