#include "graph/shader_pass.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <type_traits>

#include "graph/graph_impl.hpp"

namespace rill {

struct PassAccess {
  static Kernel fail(Pass& pass, const std::string& what) {
    pass.graph_.fail("pass '" + std::string(pass.graph_.names[pass.graph_.passes[pass.index_].name]) + "': " + what);
    return {};
  }
  /// Whether an earlier kernel of the pass writes it: `ref` is the version that the pass makes.
  static bool writes(const Pass& pass, ResourceRef ref) {
    const Access* access = pass.graph_.accessOf(pass.index_, ref.index);
    return access && access->write && access->version == ref.version;
  }
};

template <class AnyPipeline>
static Kernel bind(Pass& pass, const AnyPipeline* pipeline, std::span<const BoundResource> resources) {
  if (!pipeline) return pass.kernel(pipeline, Bindings{});
  constexpr bool draws = std::is_same_v<AnyPipeline, GraphicsPipeline>;
  const std::vector<ShaderBinding>& bindings = pipeline->bindings;
  const auto reject = [&](const std::string& what) { return PassAccess::fail(pass, "shader '" + pipeline->shader + "'" + what); };
  if (bindings.size() != pipeline->set->kinds.size()) return reject(": its resources have no names; expected an embedded shader");
  if (bindings.size() != resources.size() || bindings.size() > kMaxBindings)
    return reject(": " + std::to_string(resources.size()) + " resources; expected " + std::to_string(bindings.size()));
  std::array<ResourceRef, kMaxBindings> bound;
  for (size_t k = 0; k < bindings.size(); ++k) {
    const BoundResource& given = resources[k];
    const Use use = given.atomic ? Use::ComputeAtomic : useOf(bindings[k], draws);
    const bool isImage = bindings[k].kind == BindingKind::StorageImage || bindings[k].kind == BindingKind::SampledImage;
    bound[k] = given.buffer ? *given.buffer : given.image ? *given.image : given.ref;
    if (PassAccess::writes(pass, bound[k])) continue;
    if (!bindings[k].writes && isImage) {
      pass.read(ImageRef{bound[k]}, use);
    } else if (!bindings[k].writes) {
      pass.read(BufferRef{bound[k]}, use);
    } else if (given.buffer && !draws) {
      bound[k] = *given.buffer = pass.write(*given.buffer, use, given.discard);
    } else if (given.image && !draws) {
      bound[k] = *given.image = pass.write(*given.image, use, given.discard ? Load::Discard : Load::Keep);
    } else {
      return reject(" writes '" + std::string(bindings[k].name) + "', which " + (draws ? "a draw cannot" : "is given to be read"));
    }
  }
  return pass.kernel(pipeline, std::span<const ResourceRef>(bound.data(), bindings.size()));
}

template <class AnyPipeline>
static Kernel bindByName(Pass& pass, const AnyPipeline* pipeline, std::span<const Named> resources) {
  std::array<BoundResource, kMaxBindings> bound;
  size_t count = 0;
  if (pipeline) {
    for (const ShaderBinding& binding : pipeline->bindings) {
      const auto named = std::ranges::find(resources, binding.name, &Named::name);
      if (named == resources.end() || count == kMaxBindings)
        return PassAccess::fail(pass, "shader '" + pipeline->shader + "': nothing is given for '" + std::string(binding.name) + "'");
      bound[count++] = {named->ref, named->buffer, named->image, named->discard};
    }
  }
  return bind(pass, pipeline, std::span<const BoundResource>(bound).first(count));
}

Kernel bindShader(Pass& pass, const ComputePipeline* pipeline, std::span<const BoundResource> resources) {
  return bind(pass, pipeline, resources);
}
Kernel bindNamed(Pass& pass, const ComputePipeline* pipeline, std::span<const Named> resources) {
  return bindByName(pass, pipeline, resources);
}
Kernel bindNamed(Pass& pass, const GraphicsPipeline* pipeline, std::span<const Named> resources) {
  return bindByName(pass, pipeline, resources);
}

void addFill(Graph& graph, std::string_view name, std::span<const Fill32> fills) {
  graph.pass(name, [&](Pass& pass) {
    constexpr size_t kMaxFills = 12;
    struct Recorded {
      BufferRef buffer;
      uint32_t value = 0;
    };
    std::array<Recorded, kMaxFills> recorded;
    size_t count = 0;
    for (const Fill32& fill : fills) {
      if (!fill.buffer) continue;
      assert(count < kMaxFills);
      *fill.buffer = pass.write(*fill.buffer, Use::CopyTarget, true);
      recorded[count++] = {*fill.buffer, fill.value};
    }
    return [recorded, count](Commands& commands) {
      for (size_t k = 0; k < count; ++k) commands.fill(recorded[k].buffer, recorded[k].value);
    };
  });
}

}  // namespace rill
