#include "shared/pipeline_cache_folder.hpp"

#include <cstdlib>
#include <string_view>

namespace rill::apps {
namespace fs = std::filesystem;

fs::path pipelineCacheFolder() {
  if (const char* named = std::getenv("RILL_PIPELINE_CACHE"); named && *named)
    return std::string_view(named) == "off" ? fs::path{} : fs::path(named);
  // Of the XDG Base Directory Specification: relative paths are to be ignored.
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && fs::path(cache).is_absolute()) return fs::path(cache) / "rill";
  if (const char* home = std::getenv("HOME"); home && fs::path(home).is_absolute()) return fs::path(home) / ".cache" / "rill";
  return {};
}

}  // namespace rill::apps
