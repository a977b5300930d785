#pragma once
// A buffer of the engine's own in a graph.
#include <string_view>

#include "gpu/resources.hpp"
#include "rill/graph.hpp"

namespace rill {

/// All of it. What is written to it stays there after the graph.
inline BufferRef importWhole(Graph& graph, std::string_view name, const Buffer& buffer) {
  return graph.import(name, {.handle = buffer.handle(), .size = buffer.size()});
}

}  // namespace rill
