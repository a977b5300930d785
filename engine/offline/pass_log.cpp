#include "offline/pass_log.hpp"

#include <algorithm>
#include <cstdio>

namespace rill::offline {

PassLog::Entry& PassLog::entry(std::string_view name) {
  // A few dozen passes: a search costs less than a map.
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.name == name; });
  if (found != entries_.end()) return *found;
  entries_.push_back({std::string(name), 0, 0, {}});
  return entries_.back();
}

void PassLog::add(std::span<const PassReport> report, bool submitted) {
  for (const PassReport& pass : report) {
    Entry& known = entry(pass.name);
    if (!pass.reason.empty())
      known.reason = pass.reason;
    else if (submitted && !pass.culled)
      known.runs += pass.runs;
  }
}

void PassLog::add(std::span<const Timing> timings) {
  for (const Timing& timing : timings) entry(timing.name).ms += timing.ms;
}

std::vector<PassTime> PassLog::times() const {
  std::vector<PassTime> times;
  for (const Entry& e : entries_)
    if (e.runs > 0) times.push_back({e.name, e.ms, e.runs});
  return times;
}

std::vector<std::pair<std::string, std::string>> PassLog::skipped() const {
  std::vector<std::pair<std::string, std::string>> skipped;
  for (const Entry& e : entries_)
    if (e.runs == 0 && !e.reason.empty()) skipped.emplace_back(e.name, e.reason);
  return skipped;
}

std::string PassLog::table() const {
  std::string text;
  for (const Entry& e : entries_) {
    if (e.runs == 0) continue;
    char line[256];
    std::snprintf(line, sizeof line, "%-36s %7u runs %11.3f ms\n", e.name.c_str(), e.runs, e.ms);
    text += line;
  }
  for (const auto& [name, reason] : skipped())
    text += name + std::string(name.size() < 36 ? 36 - name.size() : 0, ' ') + " skipped: " + reason + "\n";
  return text;
}

}  // namespace rill::offline
