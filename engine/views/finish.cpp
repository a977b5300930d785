#include "views/finish.hpp"

#include "gpu/device_impl.hpp"
#include "gpu/texel_reads.hpp"
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
  BufferRef stairs = graph.create("picture before smoothing", {pixels * 4}), picture = graph.create("picture", {pixels * 4});
  graph.pass("picture tone", [&](Pass& pass) {
    pass.read(color, Use::ComputeSampled);
    stairs = pass.write(stairs, Use::ComputeWrite, true);
    const Kernel kernel = pass.kernel(tone_, {color, stairs});
    return [kernel, groups = divideUp(pixels, 64)](Commands& commands) { commands.dispatch(kernel, groups); };
  });
  graph.pass("picture edges", [&](Pass& pass) {
    const bool texels = usesTexelReads(*device_->device, pixels);
    pass.read(stairs, texels ? Use::ComputeTexel : Use::ComputeRead);
    picture = pass.write(picture, Use::ComputeWrite, true);
    const Kernel kernel = pass.kernel(antialias_[texels], {stairs, picture});
    const Groups groups{static_cast<uint32_t>(divideUp(width, kAntialiasGroup)), static_cast<uint32_t>(divideUp(height, kAntialiasGroup)),
                        1};
    return [kernel, groups, push = AntialiasPush{width, height}](Commands& commands) { commands.dispatch(kernel, groups, push); };
  });
  return picture;
}

}  // namespace rill
