#include "bench/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bench/plot.hpp"

namespace rill::bench {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Table, AlignsNumbersRightAndWordsLeft) {
  const Table table{"Title", {"name", "ms"}, {{"a", "1.5"}, {"longer", "200"}, {"none", "-"}}, "a note"};
  EXPECT_EQ(tableText(table),
            "Title\n"
            "name     ms\n"
            "a       1.5\n"
            "longer  200\n"
            "none      -\n"
            "a note\n");
}

TEST(Table, CountsCharactersNotBytes) {
  const Table table{"T", {"a", "b"}, {{"é", "1"}, {"xy", "2"}}, ""};
  EXPECT_EQ(tableText(table), "T\na   b\né   1\nxy  2\n");
}

TEST(Table, FormatsWithoutRows) { EXPECT_EQ(tableText({"T", {"a", "b"}, {}, ""}), "T\na  b\n"); }

TEST(Median, ReturnsMiddleOrMeanOfMiddleTwo) {
  EXPECT_EQ(median({3}), 3);
  EXPECT_EQ(median({9, 1, 5}), 5);
  EXPECT_EQ(median({4, 1, 3, 100}), 3.5);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(SampleStatistics, ReportsMedianSpreadAndSamples) {
  const double samples[] = {4, 2, 3};
  const Json json = sampleStatistics(samples);
  EXPECT_EQ(json["median"], 3);
  EXPECT_DOUBLE_EQ(json["spread"], 2.0 / 3);
  EXPECT_EQ(json["samples"], Json({4, 2, 3}));
}

TEST(SampleStatistics, HandlesNoSamples) {
  const Json json = sampleStatistics({});
  EXPECT_EQ(json["spread"], 0);
  EXPECT_TRUE(json["samples"].empty());
  EXPECT_NE(json.dump().find("\"median\":null"), std::string::npos) << "JSON has no NaN: " << json.dump();
}

TEST(Number, RoundsToDigitsAndShowsDashForNonFinite) {
  EXPECT_EQ(number(1234.567, 3), "1.23e+03");
  EXPECT_EQ(number(0.00012345, 2), "0.00012");
  EXPECT_EQ(number(kNaN), "-");
  EXPECT_EQ(number(std::numeric_limits<double>::infinity()), "-");
  EXPECT_EQ(percent(0.00046), "0.046 %");
}

Plot plotOf(std::vector<std::pair<double, double>> points) {
  return {"It's a title", "x", "y", true, true, {{"it's", Series::Style::Both, std::move(points), {}}}};
}

TEST(PlotProgram, ContainsDataAndQuotedNames) {
  const Plot plot = plotOf({{1, 0.25}, {1000, 7}});
  const std::string program = plotProgram(std::span(&plot, 1));
  EXPECT_NE(program.find("1 0.25 "), std::string::npos) << program;
  EXPECT_NE(program.find("1000 7 "), std::string::npos) << program;
  EXPECT_NE(program.find("set title 'It''s a title'"), std::string::npos) << program;
  EXPECT_NE(program.find("title 'it''s'"), std::string::npos) << program;
  EXPECT_NE(program.find("set logscale x"), std::string::npos) << program;
}

TEST(PlotProgram, DrawsEmphasizedPointsLarger) {
  Plot plot = plotOf({{1, 2}});
  EXPECT_EQ(plotProgram(std::span(&plot, 1)).find(" ps 2"), std::string::npos);
  plot.series[0].emphasized = true;
  EXPECT_NE(plotProgram(std::span(&plot, 1)).find(" ps 2"), std::string::npos);
}

TEST(PlotProgram, EscapesQuotesAndLineBreaks) {
  Plot plot = plotOf({{1, 2}});
  plot.title = "a\nb'; system('x')";
  plot.series[0].labels = {"c\"d\\e\nf"};
  const std::string program = plotProgram(std::span(&plot, 1));
  EXPECT_NE(program.find("'a b''; system(''x'')'"), std::string::npos) << program;
  EXPECT_NE(program.find("\"c d e f\""), std::string::npos) << program;
}

TEST(PlotProgram, SkipsPointsOutsideLogarithmicAxes) {
  const Plot plot = plotOf({{0, 5}, {2, kNaN}, {3, -1}});
  const std::string program = plotProgram(std::span(&plot, 1));
  EXPECT_EQ(program.find("\nplot "), std::string::npos) << "gnuplot rejects a plot without points: " << program;
  EXPECT_NE(program.find("set multiplot next"), std::string::npos) << "its cell of the grid stays empty: " << program;
}

TEST(PlotProgram, LabelsRowsOfOneDiagramFromTop) {
  std::vector<Plot> plots(2, plotOf({{1, 1}}));
  plots[0].rows = {"first", "it's the second"};
  const std::string program = plotProgram(plots);
  EXPECT_NE(program.find("set yrange [2.5:0.5]\nset ytics ('first' 1, 'it''s the second' 2)"), std::string::npos) << program;
  EXPECT_LT(program.find("set ytics ('first'"), program.find("set ytics autofreq")) << program;
}

TEST(PlotProgram, ArrangesDiagramsInAGrid) {
  const std::vector<Plot> plots(3, plotOf({{1, 1}}));
  EXPECT_NE(plotProgram(plots).find("layout 2,2"), std::string::npos);
  EXPECT_NE(plotProgram(std::span(plots).first(1)).find("layout 1,1"), std::string::npos);
}

}  // namespace
}  // namespace rill::bench
