#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace rill::apps {

/// The progress of work that is counted.
struct ProgressState {
  std::string_view unit;  ///< of counting, "frame"
  uint32_t done = 0, total = 0;
  std::string about;     ///< details of the last unit, "t 0.033 s"
  double elapsed_s = 0;  ///< wall time since the start
};

/// "1 h 02 min", "3 min 05 s", "12 s".
std::string formatDuration(double seconds);
/// Estimated wall time left, from the mean time per unit so far.
double secondsLeft(const ProgressState& state);
/// One line of text: count, details, time left.
std::string progressText(const ProgressState& state);
/// The same after a bar, at most `columns` wide.
std::string progressBar(const ProgressState& state, int columns);

/// Shows progress on standard error: on a terminal a bar that is redrawn, else a line at each tenth of the work and at
/// least every ten seconds.
class Progress {
 public:
  enum class Style { Quiet, Lines, Bar };
  /// Bar where standard error is a terminal with cursor control, else Lines.
  static Style styleForTerminal();

  explicit Progress(Style style) : style_(style) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const ProgressState& state);
  /// Erases the bar so that a message can be written; show() draws it again.
  void clear();

 private:
  Style style_;
  bool drawn_ = false;
  uint32_t tenths_ = UINT32_MAX;
  double lastLine_s_ = 0;
};

}  // namespace rill::apps
