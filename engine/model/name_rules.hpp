#pragma once
// The rules of names: unique among entries of a list, and known where another key refers to one.
#include <algorithm>
#include <unordered_map>

#include "core/words.hpp"
#include "model/rules.hpp"

namespace rill::model {

/// `list`: the key of the entries. Unless names are `required`, some may be empty.
template <class Named>
CheckResult uniqueNames(const std::vector<Named>& entries, std::string_view list, bool required) {
  std::unordered_map<std::string_view, size_t> seen;
  for (size_t i = 0; i < entries.size(); ++i) {
    const std::string& name = entries[i].name;
    const std::string here = memberPath(elementPath("", i), "name");
    if (name.empty() && !required) continue;
    if (name.empty()) return Fault{"found an empty name, expected a unique name", {here}};
    const auto [first, fresh] = seen.emplace(name, i);
    if (!fresh)
      return Fault{inQuotes(name) + " is also the name of " + elementPath(list, first->second) + "; expected unique names", {here}};
  }
  return {};
}

/// `known`: all names of that kind. `path`: of the key that names one.
inline CheckResult knownName(const std::string& wanted, const std::vector<std::string_view>& known, const std::string& kind,
                             const std::string& one, const std::string& path) {
  if (std::ranges::find(known, wanted) != known.end()) return {};
  const std::string_view suggestion = nearestWord(wanted, known);
  return Fault{"no " + kind + " is named " + inQuotes(wanted) + "; expected " +
                   (known.empty() ? "the name of " + one + ", but no " + kind + " has one" : "one of " + quotedList(known)) +
                   (suggestion.empty() ? "" : "; did you mean " + inQuotes(suggestion) + "?"),
               {path}};
}

}  // namespace rill::model
