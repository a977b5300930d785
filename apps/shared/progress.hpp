#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace rill::apps {

/// How far counted work is.
struct ProgressState {
  std::string_view unit;  ///< what is counted, "frame"
  uint32_t done = 0, total = 0;
  std::string about;     ///< of what is at hand, "t 0.033 s"
  double elapsed_s = 0;  ///< wall time since the first was begun
};

/// "1 h 02 min", "3 min 05 s", "12 s".
std::string formatDuration(double seconds);
/// Wall time left if those to come cost what those done have cost in the mean.
double secondsLeft(const ProgressState& state);
/// One line of text: how many, about what, time left.
std::string progressText(const ProgressState& state);
/// The same behind a bar, at most `columns` wide.
std::string progressBar(const ProgressState& state, int columns);

/// Shows progress on standard error: a bar that is redrawn on a terminal, else a line now and then (each tenth of the way, or after ten
/// seconds of silence).
class Progress {
 public:
  enum class Style { Quiet, Lines, Bar };
  /// Bar where standard error is a terminal that can move its cursor, else lines.
  static Style styleForTerminal();

  explicit Progress(Style style) : style_(style) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const ProgressState& state);
  /// Takes the bar off the screen, so that a message can be written; show() draws it again.
  void clear();

 private:
  Style style_;
  bool drawn_ = false;
  uint32_t tenths_ = UINT32_MAX;
  double lastLine_s_ = 0;
};

}  // namespace rill::apps
