#pragma once
#include <filesystem>

namespace rill::apps {

/// Lines for the help of the programs.
inline constexpr const char* kPipelineCacheHelp =
    "Compiled pipelines are kept in the folder RILL_PIPELINE_CACHE (default: $XDG_CACHE_HOME/rill or ~/.cache/rill; off: not kept).\n";

/// Where a program keeps what the driver has compiled: RILL_PIPELINE_CACHE, else rill in the user's cache folder. Empty: nowhere, where
/// RILL_PIPELINE_CACHE is `off`, or there is no such folder.
std::filesystem::path pipelineCacheFolder();

}  // namespace rill::apps
