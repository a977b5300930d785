#include "bench/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "bench/bench.hpp"
#include "core/words.hpp"
#include "rill/version.hpp"
#include "shared/device_option.hpp"
#include "shared/option_text.hpp"
#include "shared/pipeline_cache_folder.hpp"
#include "shared/usage.hpp"
#include "shared/words.hpp"

namespace rill::bench {
namespace {

struct Raw {
  std::string suite, json, plot, report, budget, device, repeat, only;
  bool quick = false, quiet = false;
};

std::vector<std::string> suiteNames() {
  std::vector<std::string> names;
  for (const Suite& suite : suites()) names.emplace_back(suite.name);
  return names;
}

Expected<uint32_t> wholeNumber(const std::string& name, const std::string& text, uint32_t least, uint32_t most, const char* unit) {
  const auto value = apps::numberIn<uint32_t>(text);
  if (value && *value >= least && *value <= most) return *value;
  return Error{ErrorKind::BadInput, name + ": found " + inQuotes(text) + ", expected a whole number" + unit + " from " +
                                        std::to_string(least) + " to " + std::to_string(most)};
}

Expected<Options> validated(const Raw& raw, const CLI::App& app) {
  const auto given = [&](const char* name) { return app.count(name) > 0; };
  const std::vector<std::string> names = suiteNames();
  if (std::ranges::find(names, raw.suite) == names.end())
    return Error{ErrorKind::BadInput,
                 "unknown suite " + inQuotes(raw.suite) + apps::didYouMean(raw.suite, names) + "\nSuites: " + apps::joined(names)};
  Options options;
  options.suite = raw.suite;
  options.quick = raw.quick;
  options.quiet = raw.quiet;
  options.only = raw.only;
  auto device = apps::deviceOption(given("--device") ? std::optional(raw.device) : std::nullopt);
  if (!device) return device.error();
  options.device = std::move(*device);
  if (given("--repeat")) {
    const auto repeat = wholeNumber("--repeat", raw.repeat, 1, 1000, "");
    if (!repeat) return repeat.error();
    options.repeat = *repeat;
  } else if (raw.quick) {
    options.repeat = 1;
  }
  if (given("--budget")) {
    const auto budget = wholeNumber("--budget", raw.budget, 10, 3600, " of seconds");
    if (!budget) return budget.error();
    if (raw.suite != "device")
      return Error{ErrorKind::BadInput, "--budget: the suite " + raw.suite + " has none; expected the suite device"};
    options.budget_s = *budget;
  } else if (raw.quick) {
    options.budget_s = 60;
  }
  for (const auto& [name, text, file] : {std::tuple{"--json", &raw.json, &options.json}, std::tuple{"--plot", &raw.plot, &options.plot},
                                         std::tuple{"--report", &raw.report, &options.report}})
    if (given(name)) {
      if (text->empty()) return Error{ErrorKind::BadInput, std::string(name) + ": found \"\", expected the name of a file"};
      *file = *text;
    }
  return options;
}

}  // namespace

Expected<apps::CommandLine<Options>> parseCommandLine(int count, const char* const* arguments) {
  Raw raw;
  CLI::App app("Measures the accuracy, speed and stability of Rill.");
  app.name("rill-bench");
  app.get_formatter()->column_width(30);
  app.add_option("SUITE", raw.suite, "the suite to run, see below")->type_name("")->required();
  app.add_flag("--quick", raw.quick, "run fewer and smaller cases with one sample per time: about a minute a suite");
  app.add_option("--json", raw.json, "write all results and samples as JSON; - writes to standard output")->type_name("FILE");
  app.add_option("--plot", raw.plot, "draw the diagrams of the suite as SVG (requires gnuplot)")->type_name("FILE.svg");
  app.add_option("--report", raw.report, "write the tables as Markdown; - writes to standard output")->type_name("FILE.md");
  app.add_option("--budget", raw.budget, "time of the suite device (default: 480; with --quick: 60)")->type_name("SECONDS");
  app.add_option("--only", raw.only, "run only the cases whose name contains TEXT")->type_name("TEXT");
  app.add_option("--repeat", raw.repeat, "measure each time N times and report the median (default: 3; with --quick: 1)")->type_name("N");
  app.add_option("--device", raw.device, apps::kDeviceHelp)->type_name("NAME");
  app.add_flag("--quiet", raw.quiet, "print only errors and failed checks");
  app.set_help_flag("-h,--help", "print this help");
  app.set_version_flag("--version", std::string("rill-bench ") + RILL_VERSION, "print the version");
  std::string footer = "Suites:\n";
  for (const Suite& suite : suites())
    footer += "  " + std::string(suite.name) + std::string(12 - std::min<size_t>(suite.name.size(), 11), ' ') +
              std::string(suite.description) + "\n";
  footer +=
      "\nExamples:\n"
      "  rill-bench device --report report.md\n"
      "      what this device computes and how fast, in at most eight minutes, for an issue\n"
      "  rill-bench accuracy --quick --plot accuracy.svg\n"
      "      run time against error for a few solver settings, in under a minute\n"
      "  rill-bench stability --only random-17\n"
      "      a single stress case\n"
      "  rill-bench speed --only particles-100k --json speed.json\n"
      "      the cost per particle and pass at 100,000 particles, with every sample\n"
      "\nExit codes: 0 success, 1 runtime error, 2 invalid usage, 3 a check of the suite failed, 4 no usable Vulkan device;\n"
      "130, 143 or 129 after a signal (results measured until then are written).\n";
  footer += apps::kPipelineCacheHelp;
  app.footer(footer);
  auto answer = apps::parsed(app, "rill-bench " RILL_VERSION, [&] { app.parse(count, arguments); });
  if (!answer) return answer.error();
  if (!answer->empty()) return apps::CommandLine<Options>{std::nullopt, std::move(*answer)};
  auto options = validated(raw, app);
  if (!options) return options.error();
  options->command = apps::commandText("rill-bench", count, arguments);
  return apps::CommandLine<Options>{std::move(*options), {}};
}

}  // namespace rill::bench
