#include "bench/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace rill::bench {
namespace {

/// Counts UTF-8 characters; wide and combining characters do not occur in reports.
size_t width(const std::string& text) {
  return static_cast<size_t>(std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xC0) != 0x80; }));
}

bool startsWithNumber(const std::string& text) {
  return text.empty() || text == "-" || std::isdigit(static_cast<unsigned char>(text[0])) ||
         (text.size() > 1 && (text[0] == '-' || text[0] == '+') && std::isdigit(static_cast<unsigned char>(text[1])));
}

}  // namespace

std::string tableText(const Table& table) {
  const size_t columns = table.columns.size();
  std::vector<size_t> widths(columns);
  std::vector<bool> right(columns, true);
  for (size_t c = 0; c < columns; ++c) {
    widths[c] = width(table.columns[c]);
    for (const auto& row : table.rows) {
      widths[c] = std::max(widths[c], width(row[c]));
      right[c] = right[c] && startsWithNumber(row[c]);
    }
  }
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (size_t c = 0; c < columns; ++c) {
      const std::string gap(widths[c] - width(cells[c]), ' ');
      text += (c ? "  " : "") + (right[c] ? gap + cells[c] : cells[c] + gap);
    }
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text + "\n";
  };
  std::string text = table.title + "\n" + line(table.columns);
  for (const auto& row : table.rows) text += line(row);
  if (!table.note.empty()) text += table.note + "\n";
  return text;
}

std::string tableMarkdown(const Table& table) {
  const auto line = [](const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) {
      text += " ";
      for (const char c : cell) text += c == '|' ? std::string("\\|") : c == '\n' ? std::string("<br>") : std::string(1, c);
      text += " |";
    }
    return text + "\n";
  };
  std::string text = "## " + table.title + "\n\n" + line(table.columns) + line(std::vector<std::string>(table.columns.size(), "---"));
  for (const auto& row : table.rows) text += line(row);
  if (!table.note.empty()) text += "\n" + table.note + "\n";
  return text;
}

double median(std::vector<double> samples) {
  if (samples.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  if (samples.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(samples.begin(), middle)) / 2;
}

Json sampleStatistics(std::span<const double> samples) {
  Json json;
  const double middle = median({samples.begin(), samples.end()});
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
  json["median"] = middle;
  json["spread"] = samples.empty() ? 0 : (*high - *low) / middle;
  json["samples"] = std::vector<double>(samples.begin(), samples.end());
  return json;
}

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string percent(double fraction, int digits) { return std::isfinite(fraction) ? number(100 * fraction, digits) + " %" : "-"; }

}  // namespace rill::bench
