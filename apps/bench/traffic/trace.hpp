#pragma once
// What a graph gives a device to do: its barriers, dispatches, fills and copies, and how many workgroups the device really ran. Taken from
// the commands as they are recorded, so it follows the solver.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/traffic/shader_accesses.hpp"
#include "bench/workbench.hpp"

namespace rill::bench {

/// A buffer that a dispatch binds, and what the shader does with it.
struct TracedBinding {
  std::string array;     ///< its name in the shader
  std::string resource;  ///< and in the graph
  uint64_t bytes = 0;    ///< of the resource
  BindingAccess access;
};

struct TracedDispatch {
  uint64_t groups = 0;  ///< as executed; 0: an indirect dispatch that was switched off
  uint32_t groupSize = 1;
  std::vector<TracedBinding> bindings;  ///< those that the shader accesses
};

struct TracedPass {
  std::string name;
  bool barrier = false;
  std::vector<TracedDispatch> dispatches;
  uint32_t transfers = 0;      ///< fills and copies
  uint64_t transferBytes = 0;  ///< read and written by them
};

/// Declares and runs a graph on the workbench; its passes in order of execution, without read-backs to the host.
Expected<std::vector<TracedPass>> traceGraph(Workbench& workbench, const std::function<void(Graph&)>& declare);

}  // namespace rill::bench
