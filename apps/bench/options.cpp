#include "bench/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "bench/bench.hpp"
#include "core/words.hpp"
#include "rill/version.hpp"
#include "shared/usage.hpp"
#include "shared/words.hpp"

namespace rill::bench {
namespace {

struct Raw {
  std::string suite, json, plot, device, repeat, only;
  bool quick = false, quiet = false;
};

std::vector<std::string> suiteNames() {
  std::vector<std::string> names;
  for (const Suite& suite : suites()) names.emplace_back(suite.name);
  return names;
}

Expected<Options> judged(const Raw& raw, const CLI::App& app) {
  const auto given = [&](const char* name) { return app.count(name) > 0; };
  const std::vector<std::string> names = suiteNames();
  if (std::ranges::find(names, raw.suite) == names.end())
    return Error{ErrorKind::BadInput,
                 "there is no suite " + inQuotes(raw.suite) + apps::didYouMean(raw.suite, names) + "\nsuites: " + apps::joined(names)};
  Options options;
  options.suite = raw.suite;
  options.quick = raw.quick;
  options.quiet = raw.quiet;
  options.only = raw.only;
  options.device = raw.device;
  if (given("--device") && raw.device.empty())
    return Error{ErrorKind::BadInput, "--device: \"\" was given; expected part of a device's name, or its index"};
  if (given("--repeat")) {
    uint32_t repeat = 0;
    const auto [end, error] = std::from_chars(raw.repeat.data(), raw.repeat.data() + raw.repeat.size(), repeat);
    if (error != std::errc{} || end != raw.repeat.data() + raw.repeat.size() || repeat < 1 || repeat > 1000)
      return Error{ErrorKind::BadInput, "--repeat: " + inQuotes(raw.repeat) + " was given; expected a whole number from 1 to 1000"};
    options.repeat = repeat;
  } else if (raw.quick) {
    options.repeat = 1;
  }
  for (const auto& [name, text, file] : {std::tuple{"--json", &raw.json, &options.json}, std::tuple{"--plot", &raw.plot, &options.plot}})
    if (given(name)) {
      if (text->empty()) return Error{ErrorKind::BadInput, std::string(name) + ": \"\" was given; expected the name of a file"};
      *file = *text;
    }
  return options;
}

}  // namespace

Expected<apps::CommandLine<Options>> parseCommandLine(int count, const char* const* arguments) {
  Raw raw;
  CLI::App app("Measures Rill: time against error, experiments, cost of each feature, stress.");
  app.name("rill-bench");
  app.get_formatter()->column_width(30);
  app.add_option("SUITE", raw.suite, "which one, see below")->type_name("")->required();
  app.add_flag("--quick", raw.quick, "fewer and smaller cases, one sample of each time: under a minute, stability about two");
  app.add_option("--json", raw.json, "write every figure and sample; - is standard output")->type_name("FILE");
  app.add_option("--plot", raw.plot, "draw the suite's diagrams (needs gnuplot)")->type_name("FILE.svg");
  app.add_option("--only", raw.only, "run only the cases whose names contain this")->type_name("TEXT");
  app.add_option("--repeat", raw.repeat, "samples of each time, of which the median counts (default: 3, with --quick 1)")->type_name("N");
  app.add_option("--device", raw.device, "part of a device's name, or its index")->type_name("NAME");
  app.add_flag("--quiet", raw.quiet, "print nothing but errors and what failed");
  app.set_help_flag("-h,--help", "show this text");
  app.set_version_flag("--version", std::string("rill-bench ") + RILL_VERSION, "show the version");
  std::string footer = "Suites:\n";
  for (const Suite& suite : suites())
    footer +=
        "  " + std::string(suite.name) + std::string(12 - std::min<size_t>(suite.name.size(), 11), ' ') + std::string(suite.about) + "\n";
  footer +=
      "\nExamples:\n"
      "  rill-bench accuracy --quick --plot accuracy.svg\n"
      "      what each level of error costs, in under a minute\n"
      "  rill-bench stability --only random-17\n"
      "      one stress case alone\n"
      "\nExit codes: 0 done, 1 failed while running, 2 bad usage, 3 a case did not hold what the suite asserts,\n"
      "4 no usable Vulkan device; 130, 143, 129 after a signal (what was measured by then is written).";
  app.footer(footer);
  auto asked = apps::parsed(app, "rill-bench " RILL_VERSION, [&] { app.parse(count, arguments); });
  if (!asked) return asked.error();
  if (!asked->empty()) return apps::CommandLine<Options>{std::nullopt, std::move(*asked)};
  auto options = judged(raw, app);
  if (!options) return options.error();
  options->command = apps::commandText("rill-bench", count, arguments);
  return apps::CommandLine<Options>{std::move(*options), {}};
}

}  // namespace rill::bench
