#include "views/finish.hpp"

#include "gpu/device_impl.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/step.hpp"
#include "sort/dispatches.hpp"
#include "views/antialias_record.h"

namespace rill {

using namespace antialias;

Expected<Finish> Finish::create(Device& device) {
  using enum BindingKind;
  static constexpr BindingKind kTone[] = {SampledImage, Storage};
  auto tone = computePipeline(device, {.shader = "views/tonemap", .bindings = kTone});
  if (!tone) return tone.error();
  Finish out;
  out.device_ = &implOf(device);
  out.tone_ = *tone;
  for (const bool texels : {false, true}) {
    const BindingKind bindings[] = {texels ? TexelUint : Storage, Storage};
    auto antialias = computePipeline(
        device,
        {.shader = texels ? "views/antialias_texel" : "views/antialias", .bindings = bindings, .pushConstantBytes = sizeof(AntialiasPush)});
    if (!antialias) return antialias.error();
    out.antialias_[texels] = *antialias;
  }
  return out;
}

BufferRef Finish::addTo(Graph& graph, ImageRef color, uint32_t width, uint32_t height) const {
  const uint64_t pixels = uint64_t{width} * height;
  BufferRef aliased = graph.create("picture aliased", {pixels * 4}), picture = graph.create("picture", {pixels * 4});
  addStep(graph, "picture tone", tone_, {sampled(color), fresh(aliased)}, divideUp(pixels, 64));
  const bool texels = usesTexelReads(*device_->device, pixels);
  const Groups tiles{static_cast<uint32_t>(divideUp(width, kAntialiasGroup)), static_cast<uint32_t>(divideUp(height, kAntialiasGroup)), 1};
  addStep(graph, "picture edges", antialias_[texels], {texels ? rill::texels(aliased) : reads(aliased), fresh(picture)}, tiles,
          AntialiasPush{width, height});
  return picture;
}

}  // namespace rill
