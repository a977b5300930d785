#pragma once
// Import of the engine's own buffers into a graph.
#include <string_view>

#include "gpu/resources.hpp"
#include "rill/graph.hpp"

namespace rill {

/// Imports the whole buffer. Its content persists after the graph.
inline BufferRef importWhole(Graph& graph, std::string_view name, const Buffer& buffer) {
  return graph.import(name, {.handle = buffer.handle(), .size = buffer.size()});
}

}  // namespace rill
