#include "shared/usage.hpp"

#include "core/words.hpp"
#include "shared/words.hpp"

namespace rill::apps {
namespace {

std::string usageMessage(const CLI::App& app, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) return error.what();
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (std::string extra : app.remaining()) {
    if (const size_t equals = extra.find('='); extra.starts_with("--") && equals != std::string::npos) extra.resize(equals);
    if (extra.starts_with("-")) return "unknown option " + inQuotes(extra) + didYouMean(extra, known);
    return "unexpected argument " + inQuotes(extra);
  }
  return error.what();
}

}  // namespace

Expected<std::string> parsed(CLI::App& app, const std::string& version, const std::function<void()>& parse) {
  try {
    parse();
  } catch (const CLI::CallForVersion&) { return version + "\n"; } catch (const CLI::CallForHelp&) {
    return app.help();
  } catch (const CLI::ParseError& error) {
    return Error{ErrorKind::BadInput, usageMessage(app, error) + "\ntry " + app.get_name() + " --help"};
  }
  return std::string();
}

std::string commandText(std::string_view program, int count, const char* const* arguments) {
  std::string text(program);
  for (int i = 1; i < count; ++i) text += " " + shellQuoted(arguments[i]);
  return text;
}

}  // namespace rill::apps
