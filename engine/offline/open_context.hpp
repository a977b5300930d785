#pragma once
#include "offline/context.hpp"
#include "rill/offline.hpp"

namespace rill::offline {

/// The context that the options ask for.
inline Expected<Context> openContext(const Options& options, uint32_t framesInFlight) {
  ContextDesc desc;
  desc.device = options.device;
  desc.deviceOrigin = options.deviceOrigin;
  desc.validation = options.validation;
  desc.pipelineCache = options.pipelineCache;
  desc.reads = options.reads;
  desc.framesInFlight = framesInFlight;
  return Context::create(desc);
}

}  // namespace rill::offline
