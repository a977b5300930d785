#include "shared/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace rill::apps {
namespace {

constexpr int kBarCells = 24;
constexpr double kSilence_s = 10;

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[160];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

int terminalColumns() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void toStandardError(std::string_view text) {
  // A failure to write progress is ignored.
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;
}

}  // namespace

std::string formatDuration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return "?";
  const auto whole = static_cast<long long>(std::min(std::ceil(seconds), 3.6e8));
  if (whole < 60) return format("%lld s", whole);
  if (whole < 3600) return format("%lld min %02lld s", whole / 60, whole % 60);
  return format("%lld h %02lld min", whole / 3600, whole / 60 % 60);
}

double secondsLeft(const ProgressState& state) {
  if (state.done == 0) return NAN;
  return state.elapsed_s / state.done * (state.total - std::min(state.done, state.total));
}

std::string progressText(const ProgressState& state) {
  const std::string text = std::string(state.unit) + format(" %u/%u  ", state.done, state.total) + state.about;
  return text + (state.done < state.total ? "  left " + formatDuration(secondsLeft(state)) : "  took " + formatDuration(state.elapsed_s));
}

std::string progressBar(const ProgressState& state, int columns) {
  const std::string text = progressText(state);
  std::string line = text;
  if (const int room = columns - static_cast<int>(text.size()) - 4; room >= 5) {
    const int cells = std::min(room, kBarCells);
    const double part = state.total ? std::min(1.0, double(state.done) / state.total) : 1.0;
    const int full = static_cast<int>(part * cells);
    line = "[" + std::string(static_cast<size_t>(full), '#') + std::string(static_cast<size_t>(cells - full), '.') + "] " + text;
  }
  // Some terminals wrap after the last column: leave it empty.
  return line.substr(0, static_cast<size_t>(std::max(1, columns - 1)));
}

Progress::Style Progress::styleForTerminal() {
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal == nullptr || std::string_view(terminal) == "dumb" || *terminal == '\0';
  return ::isatty(STDERR_FILENO) && !dumb ? Style::Bar : Style::Lines;
}

void Progress::show(const ProgressState& state) {
  if (style_ == Style::Quiet) return;
  if (style_ == Style::Bar) {
    toStandardError("\r\033[K" + progressBar(state, terminalColumns()));
    drawn_ = true;
    return;
  }
  const uint32_t tenths = state.total ? 10 * state.done / state.total : 10;
  if (tenths == tenths_ && state.elapsed_s - lastLine_s_ < kSilence_s) return;
  tenths_ = tenths;
  lastLine_s_ = state.elapsed_s;
  toStandardError(progressText(state) + "\n");
}

void Progress::clear() {
  if (drawn_) toStandardError("\r\033[K");
  drawn_ = false;
}

}  // namespace rill::apps
