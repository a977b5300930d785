#pragma once
// Passes of embedded shaders: what a pass reads, writes and binds follows from the names that its shader gives to its resources.
//
//   addDispatch(graph, "histogram", pipeline, groups, push, {{"keys", keys}, {"counts", counts}});
//
// A buffer that the shader declares `readonly` is read. Any other is written, and the ref given for it becomes its new version.
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "gpu/pipeline.hpp"
#include "rill/graph.hpp"

namespace rill {

/// A resource under the name that it has in a shader.
struct Named {
  std::string_view name;
  BufferRef* buffer = nullptr;  ///< where the new version of a written buffer goes
  ImageRef* image = nullptr;
  ResourceRef ref;
  bool discard = false;  ///< the shader writes all of it that is read later
  Named(std::string_view n, BufferRef& written) : name(n), buffer(&written), ref(written) {}
  Named(std::string_view n, const BufferRef& read) : name(n), ref(read) {}
  Named(std::string_view n, ImageRef& written) : name(n), image(&written), ref(written) {}
  Named(std::string_view n, const ImageRef& read) : name(n), ref(read) {}
};

/// Of a target that a gated pass writes in full: without a gate its old content is not needed.
inline Named discardUnless(const void* gate, Named named) {
  named.discard = !gate;
  return named;
}

/// How a pass uses a binding of a shader that dispatches, or draws.
constexpr Use useOf(const ShaderBinding& binding, bool draws = false) {
  switch (binding.kind) {
    case BindingKind::Uniform:
      return draws ? Use::DrawUniform : Use::ComputeUniform;
    case BindingKind::TexelFloat4:
    case BindingKind::TexelUint:
    case BindingKind::TexelUint2:
    case BindingKind::TexelUint4:
      return draws ? Use::DrawTexel : Use::ComputeTexel;
    case BindingKind::SampledImage:
      return draws ? Use::DrawSampled : Use::ComputeSampled;
    default:
      return draws ? Use::DrawRead : binding.writes ? Use::ComputeWrite : Use::ComputeRead;
  }
}

constexpr size_t kMaxBindings = 32;

/// What one binding of a shader is bound to.
struct BoundResource {
  ResourceRef ref;
  BufferRef* buffer = nullptr;  ///< in place of `ref`: advances to its new version if the shader writes it
  ImageRef* image = nullptr;
  bool discard = false;  ///< the shader writes all of it that is read later
  bool atomic =
      false;  ///< a buffer that is written by commutative atomics alone, whose results decide at most a carry into the same buffer
};

/// Declares what the shader of `pipeline` reads and writes, and binds it, in the order of its bindings. Writing a resource that is given as
/// `ref` is an error that compile() reports.
Kernel bindShader(Pass& pass, const ComputePipeline* pipeline, std::span<const BoundResource> resources);

/// The same by names. Resources that the shader does not name are left alone; one that it names and that is not given, and a written one
/// given as read-only, are errors that compile() reports.
Kernel bindNamed(Pass& pass, const ComputePipeline* pipeline, std::span<const Named> resources);
/// Of a pass with targets, which the pass has declared before.
Kernel bindNamed(Pass& pass, const GraphicsPipeline* pipeline, std::span<const Named> resources);
template <class AnyPipeline>
Kernel bindNamed(Pass& pass, const AnyPipeline* pipeline, std::initializer_list<Named> resources) {
  return bindNamed(pass, pipeline, std::span(resources.begin(), resources.size()));
}

/// The workgroups of a dispatch: their number, folded into x and y; an exact grid; or three words of a buffer on the device.
struct DispatchSize {
  uint64_t groups = 0;
  Groups grid{0, 0, 0};
  BufferRef arguments;
  uint64_t offset = 0;  ///< bytes
  DispatchSize(uint64_t count) : groups(count) {}
  DispatchSize(Groups exact) : grid(exact) {}
  DispatchSize(BufferRef buffer, uint64_t bytes) : arguments(buffer), offset(bytes) {}
};

struct NoPush {};

/// Records a dispatch; nothing for 0 groups.
template <class Push = NoPush>
void dispatch(Commands& commands, Kernel kernel, const DispatchSize& size, const Push& push = {}) {
  std::span<const std::byte> bytes;
  if constexpr (!std::is_same_v<Push, NoPush>) bytes = std::as_bytes(std::span(&push, 1));
  if (size.arguments != BufferRef{})
    commands.dispatchIndirect(kernel, size.arguments, size.offset, bytes);
  else if (size.grid.x > 0)
    commands.dispatch(kernel, size.grid, bytes);
  else
    commands.dispatch(kernel, size.groups, bytes);
}

/// A pass of one dispatch. Resources that the shader does not name are left alone, so passes can share a list.
template <class Push>
void addDispatch(Graph& graph, std::string_view name, const ComputePipeline* pipeline, const DispatchSize& size, const Push& push,
                 std::span<const Named> resources) {
  graph.pass(name, [&](Pass& pass) {
    if (size.arguments != BufferRef{}) pass.read(size.arguments, Use::Indirect);
    const Kernel kernel = bindNamed(pass, pipeline, resources);
    return [kernel, size, push](Commands& commands) { dispatch(commands, kernel, size, push); };
  });
}

template <class Push>
void addDispatch(Graph& graph, std::string_view name, const ComputePipeline* pipeline, const DispatchSize& size, const Push& push,
                 std::initializer_list<Named> resources) {
  addDispatch(graph, name, pipeline, size, push, std::span(resources.begin(), resources.size()));
}

/// A buffer and the word that fills it; null: nothing is filled.
struct Fill32 {
  BufferRef* buffer = nullptr;
  uint32_t value = 0;
};

/// A pass that fills whole buffers, whose old content is discarded. At most 12.
void addFill(Graph& graph, std::string_view name, std::span<const Fill32> fills);
inline void addFill(Graph& graph, std::string_view name, std::initializer_list<Fill32> fills) {
  addFill(graph, name, std::span<const Fill32>(fills.begin(), fills.size()));
}

}  // namespace rill
