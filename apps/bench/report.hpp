#pragma once
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rill::bench {

using Json = nlohmann::ordered_json;

/// A table for people.
struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::string note;  ///< below it: what a column means
};
/// Columns as wide as they need to be; numbers to the right.
std::string tableText(const Table& table);

/// A curve or a cloud of points.
struct Series {
  enum class Style { Points, Lines, Both };
  std::string name;  ///< in the key; empty: not listed
  Style style = Style::Both;
  std::vector<std::pair<double, double>> points;
  std::vector<std::string> labels;  ///< beside the points; may be empty
  bool emphasized = false;          ///< larger points
};

/// One diagram. Points that are not finite, or not positive on a logarithmic axis, are drawn on the axis' far edge by whoever fills it.
struct Plot {
  std::string title, x, y;
  bool logX = false, logY = false;
  std::vector<Series> series;
  std::vector<std::string> rows = {};  ///< names of y = 1, 2, ..., drawn from the top down; empty: y is a number
};

/// What a suite found.
struct Report {
  std::vector<Table> tables;
  std::vector<Plot> plots;
  Json results = Json::array();       ///< an object a case, every sample in it
  std::vector<std::string> failures;  ///< cases that did not hold what the suite asserts, each with its figure
};

/// {"median", "spread" (largest less smallest, over the median), "samples"}.
Json sampled(std::span<const double> samples);
double median(std::vector<double> samples);  ///< NaN of none

/// A figure in a table: "%.*g".
std::string number(double value, int digits = 3);
/// A fraction as per cent: "0.046 %".
std::string percent(double fraction, int digits = 3);

}  // namespace rill::bench
