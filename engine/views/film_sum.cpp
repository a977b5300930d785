#include "views/film_sum.hpp"

#include <cmath>

#include "core/words.hpp"
#include "gpu/module_pipelines.hpp"
#include "gpu/vulkan_error.hpp"
#include "graph/shader_pass.hpp"
#include "sort/dispatches.hpp"

namespace rill {
namespace {

constexpr uint32_t kFilmGroup = 64;

}  // namespace

Expected<FilmSum> FilmSum::create(Device& device) {
  FilmSum out;
  ModulePipelines pipelines(device);
  out.add_ = pipelines.make("views/film_add");
  out.tone_ = pipelines.make("views/film_tone");
  out.linear_ = pipelines.make("views/film_linear");
  if (auto made = pipelines.result(); !made) return made.error();
  return out;
}

Expected<void> FilmSum::resize(Device& device, uint32_t width, uint32_t height) {
  if (width == width_ && height == height_) return {};
  const uint64_t bytes = uint64_t{width} * height * kPixelBytes, most = device.info().maxBufferBytes;
  if (bytes > most)
    return Error{ErrorKind::TooLarge, "film effects: a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                                          " pixels needs a buffer of " + bytesText(bytes) + "; expected at most " + bytesText(most) +
                                          " on this device"};
  auto made = createBuffer(device, "film sum", bytes);
  if (!made) return made.error();
  sum_ = *std::move(made);
  width_ = width;
  height_ = height;
  ++generation_;
  return {};
}

BufferRef FilmSum::importSum(Graph& graph) const {
  return graph.import("film sum", {sum_.handle(), 0, sum_.size(), Use::ComputeWrite, Use::ComputeWrite});
}

void FilmSum::add(Graph& graph, ImageRef color, bool first) const {
  BufferRef sum = importSum(graph);
  addDispatch(graph, "film add", add_, divideUp(uint64_t{width_} * height_, kFilmGroup), uint32_t{first}, {{"hdr", color}, {"sum", sum}});
}

BufferRef FilmSum::mean(Graph& graph, std::string_view name, const ComputePipeline* pipeline, uint64_t bytes, double gain) const {
  struct TonePush {
    uint32_t pixels;
    float gain;
  };
  const uint32_t pixels = width_ * height_;
  const BufferRef sum = importSum(graph);
  BufferRef picture = graph.create("film picture", {pixels * bytes});
  addDispatch(graph, name, pipeline, divideUp(pixels, kFilmGroup), TonePush{pixels, static_cast<float>(gain)},
              {{"sum", sum}, {"picture", picture}});
  return picture;
}

BufferRef FilmSum::picture(Graph& graph, uint32_t count, double exposure_stops) const {
  return mean(graph, "film tone", tone_, 4, std::exp2(exposure_stops) / count);
}

BufferRef FilmSum::linear(Graph& graph, uint32_t count) const { return mean(graph, "film linear", linear_, 8, 1.0 / count); }

}  // namespace rill
