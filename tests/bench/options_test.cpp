// Parsing of the rill-bench command line.
#include "bench/options.hpp"

#include <gtest/gtest.h>

#include "bench/bench.hpp"
#include "support/scoped_variable.hpp"

namespace rill::bench {
namespace {

Expected<apps::CommandLine<Options>> parsed(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "rill-bench");
  return parseCommandLine(static_cast<int>(arguments.size()), arguments.data());
}

void expectBadInput(const std::vector<const char*>& arguments, const std::vector<std::string>& words) {
  const auto line = parsed(arguments);
  ASSERT_FALSE(line) << "expected an error";
  EXPECT_EQ(line.error().kind, ErrorKind::BadInput);
  for (const std::string& word : words)
    EXPECT_NE(line.error().message.find(word), std::string::npos) << word << " is not in: " << line.error().message;
}

TEST(Options, HasDefaults) {
  const auto line = parsed({"sort"});
  ASSERT_TRUE(line) << line.error().message;
  ASSERT_TRUE(line->options);
  EXPECT_EQ(line->options->suite, "sort");
  EXPECT_EQ(line->options->repeat, 3u);
  EXPECT_FALSE(line->options->quick);
  EXPECT_FALSE(line->options->json);
}

TEST(Options, QuickDefaultsToOneSample) {
  EXPECT_EQ(parsed({"sort", "--quick"})->options->repeat, 1u);
  EXPECT_EQ(parsed({"sort", "--quick", "--repeat", "5"})->options->repeat, 5u);
}

TEST(Options, ParsesFilesAndNames) {
  const auto line = parsed({"sort", "--json", "a b.json", "--plot", "p.svg", "--only", "random", "--device", "0"});
  ASSERT_TRUE(line) << line.error().message;
  EXPECT_EQ(line->options->json, "a b.json");
  EXPECT_EQ(line->options->plot, "p.svg");
  EXPECT_EQ(line->options->only, "random");
  EXPECT_EQ(line->options->device.name, "0");
  EXPECT_EQ(line->options->command, "rill-bench sort --json 'a b.json' --plot p.svg --only random --device 0");
}

TEST(Options, TakesDeviceFromVariable) {
  const test::ScopedVariable variable("RILL_DEVICE", "radeon");
  EXPECT_EQ(parsed({"sort"})->options->device.name, "radeon");
  EXPECT_EQ(parsed({"sort", "--device", "0"})->options->device.name, "0");
}

TEST(Options, ErrorsNameOptionAndValue) {
  expectBadInput({}, {"SUITE"});
  expectBadInput({"srot"}, {"\"srot\"", "did you mean \"sort\"?", "speed"});
  expectBadInput({"sort", "--qick"}, {"\"--qick\"", "did you mean \"--quick\"?"});
  for (const char* bad : {"0", "-1", "2.5", "x", "", "1001", "99999999999999999999"})
    expectBadInput({"sort", "--repeat", bad}, {"--repeat", std::string("\"") + bad + "\"", "1 to 1000"});
  expectBadInput({"sort", "--json", ""}, {"--json", "name of a file"});
  expectBadInput({"sort", "--device", ""}, {"--device", "index"});
}

TEST(Options, HelpListsEverySuite) {
  const auto line = parsed({"--help"});
  ASSERT_TRUE(line) << line.error().message;
  EXPECT_FALSE(line->options);
  for (const Suite& suite : suites()) {
    EXPECT_NE(line->text.find("  " + std::string(suite.name) + " "), std::string::npos) << suite.name;
    EXPECT_NE(line->text.find(suite.description), std::string::npos) << suite.name;
  }
}

}  // namespace
}  // namespace rill::bench
