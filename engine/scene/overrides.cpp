#include "scene/overrides.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/words.hpp"
#include "model/fields.hpp"

namespace rill {
namespace {

/// One step of a key path: a key, or an index.
struct Step {
  std::string key;
  std::optional<size_t> index;
};

Error invalidOverride(const Override& change, const std::string& why) { return {ErrorKind::BadInput, "--set " + change.key + ": " + why}; }

Expected<std::vector<Step>> stepsOf(const Override& change) {
  const auto malformed = [&](const std::string& what) {
    return invalidOverride(change, what + "; expected a key path such as fluid.viscosity, fill[0].jitter or fluids.oil.density");
  };
  std::vector<Step> steps;
  std::string_view rest = change.key;
  bool want_key = true;
  while (!rest.empty() || want_key) {
    if (want_key) {
      const size_t end = std::min(rest.find_first_of(".["), rest.size());
      const std::string_view key = rest.substr(0, end);
      if (key.empty()) return malformed("a key is empty");
      steps.push_back({std::string(key), {}});
      rest.remove_prefix(end);
      want_key = false;
    } else if (rest.front() == '.') {
      rest.remove_prefix(1);
      want_key = true;
    } else if (rest.front() == '[') {
      const size_t end = rest.find(']');
      const std::string_view digits = rest.substr(1, end == std::string_view::npos ? end : end - 1);
      size_t index = 0;
      const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), index);
      if (end == std::string_view::npos || digits.empty() || read.ec != std::errc() || read.ptr != digits.data() + digits.size()) {
        return malformed(inQuotes(digits) + " is not an index in brackets");
      }
      steps.push_back({{}, index});
      rest.remove_prefix(end + 1);
    } else {
      return malformed("unexpected " + inQuotes(rest) + " after an index");
    }
  }
  return steps;
}

/// The value as JSON, or as a string if it is a bare word.
Expected<Json> valueOf(const Override& change) {
  const size_t first = change.value.find_first_not_of(" \t\r\n");
  const char start = first == std::string::npos ? '\0' : change.value[first];
  Expected<Json> value = parseJsonText(change.value, "--set " + change.key);
  if (value) return value;
  const bool meant_as_json = start == '[' || start == '{' || start == '"';
  const bool too_large = value.error().message.find("out of range") != std::string::npos;
  const bool bad_text = value.error().message.find("UTF-") != std::string::npos;
  if (meant_as_json || too_large || bad_text) return value;
  return Json(change.value);
}

std::string nameOf(const std::string& path) { return path.empty() ? std::string("the scene") : path; }

/// Whether `key` is that of a list at the top of a scene.
bool isSceneList(std::string_view key) {
  bool list = false;
  model::forEachField<Scene>([&](const auto& field) {
    using Value = typename std::remove_cvref_t<decltype(field)>::Value;
    list = list || (model::kIsList<Value> && field.info.key == key);
  });
  return list;
}

/// The index of the entry of `list` that has this name.
Expected<size_t> entryNamed(const Json& list, const Override& change, const std::string& name, const std::string& path) {
  std::vector<std::string_view> names;
  for (size_t i = 0; i < list.size(); ++i) {
    const auto found = list[i].is_object() ? list[i].find("name") : list[i].end();
    if (!list[i].is_object() || found == list[i].end() || !found->is_string()) continue;
    names.push_back(found->get_ref<const std::string&>());
    if (names.back() == name) return i;
  }
  const std::string_view suggestion = nearestWord(name, names);
  return invalidOverride(change, "no entry of " + path + " is named " + inQuotes(name) + "; expected " +
                                     (names.empty() ? "an index, as in " + elementPath(path, 0)
                                                    : "one of " + quotedList(names) + ", or an index, as in " + elementPath(path, 0)) +
                                     (suggestion.empty() ? "" : "; did you mean " + inQuotes(suggestion) + "?"));
}

/// The value at the path `steps`, created if it is missing. An entry of a list is given by its index or its name.
Expected<Json*> walk(Json& root, const Override& change, const std::vector<Step>& steps, OverrideMarks& marks, std::string& path) {
  Json* node = &root;
  for (size_t i = 0; i < steps.size(); ++i) {
    const Step& step = steps[i];
    bool fresh = false;
    if (step.index) {
      if (!node->is_array()) return invalidOverride(change, nameOf(path) + " is not a list; expected a key without an index");
      if (*step.index > node->size()) {
        return invalidOverride(change, nameOf(path) + " has " + grouped(node->size()) + (node->size() == 1 ? " entry" : " entries") +
                                           " in the scene; expected an index of at most " + grouped(node->size()) +
                                           " (one more adds an entry)");
      }
      fresh = *step.index == node->size();
      if (fresh) node->push_back(nullptr);
      node = &(*node)[*step.index];
      path = elementPath(path, *step.index);
    } else if (node->is_array()) {
      const auto index = entryNamed(*node, change, step.key, path);
      if (!index) return index.error();
      node = &(*node)[*index];
      path = elementPath(path, *index);
    } else {
      if (!node->is_object()) return invalidOverride(change, nameOf(path) + " is not an object; expected a key path of the scene");
      if (i == 0 && steps.size() > 1 && !steps[1].index && !node->contains(step.key) && isSceneList(step.key))
        return invalidOverride(change, "the scene has no " + inQuotes(step.key) + "; expected an index, as in " + elementPath(step.key, 0) +
                                           " (which adds an entry)");
      const auto [entry, made] = node->emplace(step.key, nullptr);
      fresh = made;
      node = &*entry;
      path = memberPath(path, step.key);
    }
    if (fresh) {
      marks.set(path, {change.key, {}});
      if (i + 1 < steps.size()) *node = steps[i + 1].index ? Json::array() : Json::object();
    }
  }
  return node;
}

/// `spacing` and `particles` are alternatives: setting one removes the other.
void removeAlternative(Json& root, const std::vector<Step>& steps) {
  if (steps.size() != 2 || steps[0].key != "fluid") return;
  if (steps[1].key == "spacing") root["fluid"].erase("particles");
  if (steps[1].key == "particles") root["fluid"].erase("spacing");
}

}  // namespace

const OverrideMarks::Mark* OverrideMarks::find(std::string_view path) const {
  while (!path.empty()) {
    if (const auto found = marks_.find(path); found != marks_.end()) return &found->second;
    const size_t parent = path.find_last_of(".[");
    path = path.substr(0, parent == std::string_view::npos ? 0 : parent);
  }
  return nullptr;
}

const OverrideMarks::Mark* OverrideMarks::valueAt(const std::string& path) const {
  const auto found = marks_.find(path);
  return found != marks_.end() && !found->second.text.empty() ? &found->second : nullptr;
}

Expected<Override> parseOverride(std::string_view text) {
  const size_t equals = text.find('=');
  if (equals == std::string_view::npos)
    return Error{ErrorKind::BadInput, "--set " + std::string(text) + ": no '='; expected KEY=VALUE, as in fluid.viscosity=0.1"};
  if (equals == 0)
    return Error{ErrorKind::BadInput, "--set " + std::string(text) + ": no key before '='; expected KEY=VALUE, as in fluid.viscosity=0.1"};
  return Override{std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

Expected<void> applyOverrides(Json& root, std::span<const Override> overrides, OverrideMarks& marks) {
  for (const Override& change : overrides) {
    const auto steps = stepsOf(change);
    if (!steps) return steps.error();
    auto value = valueOf(change);
    if (!value) return value.error();
    std::string path;
    const auto place = walk(root, change, *steps, marks, path);
    if (!place) return place.error();
    **place = std::move(*value);
    marks.set(path, {change.key, change.value});
    removeAlternative(root, *steps);
  }
  return {};
}

}  // namespace rill
