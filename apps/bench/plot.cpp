// Diagrams are drawn by gnuplot from a generated script with inline data.
#include "bench/plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/words.hpp"
#include "shared/atomic_file.hpp"
#include "shared/temporary_folder.hpp"

namespace rill::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 720, kHeight = 480;  // pixels per diagram
constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999933"};

/// A single-quoted gnuplot string.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c == '\n' ? ' ' : c);
  return out + "'";
}

std::string yAxisCommands(const std::vector<std::string>& rows) {
  if (rows.empty()) return "set yrange [*:*]\nset ytics autofreq\n";
  std::string tics;
  for (size_t row = 0; row < rows.size(); ++row) tics += (row ? ", " : "") + quoted(rows[row]) + " " + std::to_string(row + 1);
  return "set yrange [" + std::to_string(rows.size()) + ".5:0.5]\nset ytics (" + tics + ")\n";
}

bool isDrawable(const Plot& plot, const std::pair<double, double>& point) {
  return std::isfinite(point.first) && std::isfinite(point.second) && (!plot.logX || point.first > 0) && (!plot.logY || point.second > 0);
}

/// Tics at 1, 2 and 5 of each decade: ranges below two decades would have too few tics otherwise.
std::string logTics() {
  std::string tics;
  for (int decade = -6; decade <= 6; ++decade)
    for (const char* digit : {"1", "2", "5"}) tics += (tics.empty() ? "(" : ", ") + std::string(digit) + "e" + std::to_string(decade);
  return tics + ")";
}

}  // namespace

Expected<void> checkPlotter() {
  if (std::system("gnuplot --version >/dev/null 2>&1") == 0) return {};
  return Error{ErrorKind::BadInput, "--plot: gnuplot was not found (Debian and Ubuntu: apt-get install gnuplot-nox)"};
}

std::string plotProgram(std::span<const Plot> plots) {
  const int columns = plots.size() > 1 ? 2 : 1,
            rows = static_cast<int>((plots.size() + static_cast<size_t>(columns) - 1) / static_cast<size_t>(columns));
  std::ostringstream out;
  out << "set terminal svg noenhanced size " << columns * kWidth << "," << std::max(1, rows) * kHeight
      << " font 'sans,12' background rgb 'white'\n"
      << "set multiplot layout " << std::max(1, rows) << "," << columns << "\n"
      << "set grid lc rgb '#dddddd'\nset key outside below height 1\nset format '%g'\n";
  for (size_t p = 0; p < plots.size(); ++p) {
    const Plot& plot = plots[p];
    out << "set title " << quoted(plot.title) << "\nset xlabel " << quoted(plot.x) << "\nset ylabel " << quoted(plot.y) << "\n";
    // Extending axes to whole decades would leave too little room for point labels.
    const bool labeled = std::ranges::any_of(plot.series, [](const Series& one) { return !one.labels.empty(); });
    out << (labeled ? "set autoscale fix\nset offsets graph 0.06, graph 0.16, graph 0.08, graph 0.08\n"
                    : "set autoscale\nset offsets 0,0,0,0\n");
    out << "set xtics " << (labeled && plot.logX ? logTics() : "autofreq") << "\n";
    out << (plot.logX ? "set logscale x\n" : "unset logscale x\n") << (plot.logY ? "set logscale y\n" : "unset logscale y\n");
    out << yAxisCommands(plot.rows);
    if (labeled && plot.logY) out << "set ytics " << logTics() << "\n";
    std::string curves;
    for (size_t s = 0; s < plot.series.size(); ++s) {
      const Series& series = plot.series[s];
      const std::string block = "$d" + std::to_string(p) + "_" + std::to_string(s);
      size_t written = 0;
      out << block << " << EOD\n";
      for (size_t k = 0; k < series.points.size(); ++k) {
        if (!isDrawable(plot, series.points[k])) continue;
        std::string label = k < series.labels.size() ? series.labels[k] : "";
        for (char& c : label)
          if (c == '"' || c == '\\' || c == '\n') c = ' ';
        out << shortestNumber(series.points[k].first) << " " << shortestNumber(series.points[k].second) << " \"" << label << "\"\n";
        ++written;
      }
      out << "EOD\n";
      if (written == 0) continue;
      const std::string color = kColors[s % std::size(kColors)];
      const char* with = series.style == Series::Style::Points ? "points" : series.style == Series::Style::Lines ? "lines" : "linespoints";
      curves += (curves.empty() ? "plot " : ", ") + block + " using 1:2 with " + with + " pt " + std::to_string(s % 13 + 4) +
                (series.emphasized ? " ps 2" : "") + " lw 1.5 lc rgb '" + color + "' " +
                (series.name.empty() ? std::string("notitle") : "title " + quoted(series.name));
      if (!series.labels.empty())
        curves += ", " + block + " using 1:2:3 with labels offset 0.6,0.6 left font ',9' tc rgb '" + color + "' notitle";
    }
    out << (curves.empty() ? std::string("set multiplot next") : curves) << "\n";
  }
  out << "unset multiplot\n";
  return out.str();
}

Expected<void> writePlots(const fs::path& file, std::span<const Plot> plots) {
  auto folder = apps::TemporaryFolder::make();
  if (!folder) return folder.error();
  const fs::path program = folder->path() / "plot.gp", drawn = folder->path() / "plot.svg", errors = folder->path() / "errors";
  std::ofstream(program) << plotProgram(plots);
  const std::string command = "gnuplot '" + program.string() + "' >'" + drawn.string() + "' 2>'" + errors.string() + "'";
  const int status = std::system(command.c_str());
  const auto content = [](const fs::path& from) {
    std::ostringstream text;
    text << std::ifstream(from, std::ios::binary).rdbuf();
    return text.str();
  };
  const std::string svg = content(drawn), message = content(errors);
  if (status != 0 || svg.find("</svg>") == std::string::npos)
    return Error{ErrorKind::Io, file.string() + ": gnuplot failed: " + message.substr(0, 400)};
  return apps::writeFile(file, svg);
}

}  // namespace rill::bench
