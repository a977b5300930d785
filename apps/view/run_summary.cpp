#include "view/run_summary.hpp"

#include <algorithm>
#include <cstdio>

#include "shared/atomic_file.hpp"
#include "shared/message.hpp"

namespace rill::view {

Expected<void> RunSummary::print(const std::string& scene, uint64_t frames, double wall_s, Runner& runner) {
  if (!runner.betweenSteps())
    if (auto ended = runner.step(); !ended) return ended;
  auto hash = runner.hash();
  if (!hash) return hash.error();
  std::ranges::sort(frames_ms_);
  const auto frame_ms = [&](double share) {
    return frames_ms_.empty() ? 1e3 * wall_s : frames_ms_[static_cast<size_t>(share * static_cast<double>(frames_ms_.size() - 1))];
  };
  char text[600];  // a file name has up to 255
  std::snprintf(text, sizeof text,
                "scene         %s\nframes        %llu\nsteps         %llu\ntime_s        %.9g\n"
                "particles     %u\nbodies        %zu\nwall_s        %.3f\n"
                "frame_ms      %.1f\nframe_ms_p95  %.1f\nstate_hash    %016llx\n",
                scene.c_str(), static_cast<unsigned long long>(frames), static_cast<unsigned long long>(runner.steps()), runner.time_s(),
                runner.fluid().count(), runner.fluid().bodies().size(), wall_s, frame_ms(0.5), frame_ms(0.95),
                static_cast<unsigned long long>(*hash));
  return apps::writeStream(STDOUT_FILENO, apps::printable(text));
}

}  // namespace rill::view
