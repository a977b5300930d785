#include "offline/pass_log.hpp"

#include <algorithm>
#include <cstdio>

namespace rill::offline {

bool runsAnything(std::span<const PassReport> report) {
  return std::ranges::any_of(report, [](const PassReport& pass) { return !pass.culled && pass.reason.empty() && pass.runs > 0; });
}

PassLog::Entry& PassLog::entry(std::string_view name) {
  // With a few dozen passes, linear search is faster than a map.
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.name == name; });
  if (found != entries_.end()) return *found;
  entries_.push_back({std::string(name), 0, 0, 0, {}});
  return entries_.back();
}

void PassLog::add(std::span<const PassReport> report, bool submitted) {
  for (const PassReport& pass : report) {
    Entry& known = entry(pass.name);
    if (!pass.reason.empty())
      known.reason = pass.reason;
    else if (submitted && !pass.culled) {
      known.recorded += pass.runs;
      known.executed += pass.runs;
    }
  }
}

void PassLog::add(std::span<const Timing> timings) {
  for (const Timing& timing : timings) entry(timing.name).ms += timing.ms;
}

void PassLog::add(std::span<const FluidPassRuns> passes, std::span<const PassReport> report) {
  for (const PassReport& pass : report) {
    const auto matches = [&](const FluidPassRuns& r) {
      return r.name.ends_with('/') ? pass.name.starts_with(r.name) : pass.name == r.name;
    };
    const auto found = std::ranges::find_if(passes, matches);
    if (found == passes.end() || pass.culled || !pass.reason.empty()) continue;
    const uint32_t skipped = found->recorded - std::min(found->executed, found->recorded);
    entry(pass.name).executed -= static_cast<uint32_t>(uint64_t{pass.runs} * skipped / found->recorded);
  }
}

std::vector<PassTime> PassLog::times() const {
  std::vector<PassTime> times;
  for (const Entry& e : entries_)
    if (e.recorded > 0) times.push_back({e.name, e.ms, e.recorded, e.executed});
  return times;
}

std::vector<SkippedPass> PassLog::skipped() const {
  std::vector<SkippedPass> skipped;
  for (const Entry& e : entries_)
    if (e.recorded == 0 && !e.reason.empty()) skipped.emplace_back(e.name, e.reason);
  return skipped;
}

std::string passTable(std::span<const PassTime> passes, std::span<const SkippedPass> skipped) {
  char line[256];
  std::snprintf(line, sizeof line, "%-36s %9s %9s %11s %10s\n", "pass", "recorded", "ran", "ms", "us a run");
  std::string text = line;
  for (const PassTime& pass : passes) {
    std::snprintf(line, sizeof line, "%-36s %9u %9u", pass.name.c_str(), pass.recorded, pass.executed);
    text += line;
    if (pass.ms > 0 && pass.executed > 0)
      std::snprintf(line, sizeof line, " %11.3f %10.2f\n", pass.ms, 1e3 * pass.ms / pass.executed);
    else if (pass.ms > 0)
      std::snprintf(line, sizeof line, " %11.3f %10s\n", pass.ms, "-");
    else  // not timed
      std::snprintf(line, sizeof line, " %11s %10s\n", "-", "-");
    text += line;
  }
  for (const auto& [name, reason] : skipped)
    text += name + std::string(name.size() < 36 ? 36 - name.size() : 0, ' ') + " skipped: " + reason + "\n";
  return text;
}

std::string readsText(const DeviceInfo& device) {
  return std::string("arrays are read through ") + (device.texelReads ? "texel" : "storage") +
         " buffers: " + std::string(device.readsBecause) + "\n";
}

std::string memoryTable(std::span<const FrameMemory> frames) {
  if (frames.empty()) return "";
  char line[256];
  std::snprintf(line, sizeof line, "%-36s %9s %11s %10s\n", "transient memory", "resources", "MiB", "unaliased");
  std::string text = line;
  constexpr double kMiB = 1 << 20;
  for (const FrameMemory& frame : frames)
    for (const TransientHeap& heap : frame.heaps) {
      const std::string name = frame.frame + (heap.images ? ", images" : ", buffers");
      std::snprintf(line, sizeof line, "%-36s %9u %11.3f %10.3f\n", name.c_str(), heap.transients, double(heap.bytes) / kMiB,
                    double(heap.separate) / kMiB);
      text += line;
    }
  return text;
}

}  // namespace rill::offline
