#pragma once
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rill::bench {

using Json = nlohmann::ordered_json;

/// A table of the text report.
struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::string note;  ///< printed below the table: explains the columns
};
/// Formats a table; columns of numbers are aligned right.
std::string tableText(const Table& table);

/// The same in Markdown, under a heading of the second level.
std::string tableMarkdown(const Table& table);

/// A curve or a scatter plot.
struct Series {
  enum class Style { Points, Lines, Both };
  std::string name;  ///< in the legend; empty: not listed
  Style style = Style::Both;
  std::vector<std::pair<double, double>> points;
  std::vector<std::string> labels;  ///< drawn beside the points; may be empty
  bool emphasized = false;          ///< larger points
};

/// One diagram. Points that are not finite, or not positive on a logarithmic axis, are left out; callers clamp points that must be shown.
struct Plot {
  std::string title, x, y;
  bool logX = false, logY = false;
  std::vector<Series> series;
  std::vector<std::string> rows = {};  ///< labels of y = 1, 2, ... from top to bottom; empty: y is numeric
};

/// The results of a suite.
struct Report {
  std::vector<Table> tables;
  std::vector<Plot> plots;
  Json results = Json::array();       ///< one object per case, with every sample
  std::vector<std::string> failures;  ///< failed checks: case, value found, value expected
};

/// {"median", "spread" ((max - min) / median), "samples"}.
Json sampleStatistics(std::span<const double> samples);
double median(std::vector<double> samples);  ///< NaN if empty

/// Formats a table cell with "%.*g"; "-" if not finite.
std::string number(double value, int digits = 3);
/// Formats a fraction as a percentage: "0.046 %".
std::string percent(double fraction, int digits = 3);

}  // namespace rill::bench
