// The JSON Schema and the Markdown tables of the scene's keys, both from model/fields.hpp.
#include "core/words.hpp"
#include "rill/scene_io.hpp"
#include "scene/field_json.hpp"
#include "scene/reader.hpp"

namespace rill {
namespace {

// JSON Schema.

template <class Owner>
OrderedJson objectSchema();

void addRange(OrderedJson& schema, const model::Range& range) {
  if (range.hasLow()) schema[range.low_open ? "exclusiveMinimum" : "minimum"] = tidyNumber(range.low);
  if (range.hasHigh()) schema[range.high_open ? "exclusiveMaximum" : "maximum"] = tidyNumber(range.high);
}

OrderedJson numberSchema(const model::Info& info, std::string_view type) {
  OrderedJson schema{{"type", type}};
  addRange(schema, info.range);
  return schema;
}

OrderedJson arraySchema(const OrderedJson& items, size_t least, size_t most) {
  return {{"type", "array"}, {"items", items}, {"minItems", least}, {"maxItems", most}};
}

/// A vector of 3 numbers, or of the 4 of a quaternion.
template <class T>
inline constexpr bool kIsVector = std::is_same_v<T, Double3> || std::is_same_v<T, std::optional<Double3>> || std::is_same_v<T, Quaternion>;

template <class T>
inline constexpr bool kIsPair = std::is_same_v<T, std::pair<double, double>> || std::is_same_v<T, std::optional<std::pair<double, double>>>;

template <class T>
inline constexpr bool kIsNamePair = std::is_same_v<T, std::pair<std::string, std::string>>;

/// The type of a key's value, by the type of its member.
template <class T>
OrderedJson typeSchema(const model::Info& info) {
  using Inner = typename model::Inner<T>::Type;
  if constexpr (std::is_same_v<T, model::Ignored>) {
    return OrderedJson::object();
  } else if constexpr (std::is_same_v<T, model::Version>) {
    return {{"type", "string"}, {"pattern", "^[0-9]+\\.[0-9]+(\\.[0-9]+)?$"}};
  } else if constexpr (std::is_same_v<T, bool>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::is_same_v<T, double>) {
    return numberSchema(info, "number");
  } else if constexpr (std::is_same_v<T, uint32_t> || std::is_same_v<T, uint64_t>) {
    OrderedJson schema = numberSchema(info, "integer");
    if (schema.contains("maximum") && schema["maximum"].is_number_float()) schema["maximum"] = std::numeric_limits<uint64_t>::max();
    return schema;
  } else if constexpr (std::is_same_v<T, std::optional<double>>) {
    if (info.unset.empty()) return numberSchema(info, "number");
    return {{"oneOf", OrderedJson::array({{{"const", info.unset}}, numberSchema(info, "number")})}};
  } else if constexpr (kIsPair<T>) {
    return arraySchema(numberSchema(info, "number"), 2, 2);
  } else if constexpr (kIsNamePair<T>) {
    return arraySchema({{"type", "string"}}, 2, 2);
  } else if constexpr (kIsVector<T>) {
    constexpr size_t kSize = std::is_same_v<T, Quaternion> ? 4 : 3;
    return arraySchema(numberSchema(info, "number"), kSize, kSize);
  } else if constexpr (std::is_same_v<T, SideMask>) {
    OrderedJson schema = arraySchema({{"enum", info.words}}, 0, info.words.size());
    schema["uniqueItems"] = true;
    return schema;
  } else if constexpr (model::kIsList<T>) {
    OrderedJson schema{{"type", "array"}, {"items", objectSchema<Inner>()}};
    if (info.most > 0) schema["maxItems"] = info.most;
    return schema;
  } else if constexpr (!std::is_void_v<Inner>) {
    return objectSchema<Inner>();
  } else if (!info.words.empty()) {
    return {{"enum", info.words}};
  } else {
    OrderedJson schema{{"type", "string"}};
    if (info.required || info.namesFluid || std::is_same_v<T, std::filesystem::path>) schema["minLength"] = 1;
    return schema;
  }
}

/// What a scene must say to use the key.
std::string sinceText(const model::Info& info) { return info.since.empty() ? "" : ". Needs \"rill\": \"" + std::string(info.since) + "\""; }

/// Help with the unit in front: "m/s^2: [x, y, z]".
std::string description(const model::Info& info) {
  return (info.unit.empty() ? "" : std::string(info.unit) + ": ") + std::string(info.help) + sinceText(info);
}

template <class Owner>
OrderedJson objectSchema() {
  OrderedJson properties = OrderedJson::object(), required = OrderedJson::array();
  model::forEachField<Owner>([&](const auto& field) {
    using T = typename std::remove_cvref_t<decltype(field)>::Value;
    OrderedJson schema{{"description", description(field.info)}};
    schema.update(typeSchema<T>(field.info));
    schema["description"] = description(field.info);  // of the key, not of the struct
    if constexpr (model::kHasMember<T>) {
      const Owner defaults{};
      const T* given = field.find(defaults);
      const OrderedJson value = given ? defaultJson(field.info, *given) : OrderedJson();
      if (!value.is_null()) schema["default"] = value;
    }
    if (field.info.required) required.push_back(field.info.key);
    properties[std::string(field.info.key)] = std::move(schema);
  });
  OrderedJson schema{{"description", model::Table<Owner>::about}, {"type", "object"}, {"properties", std::move(properties)}};
  if (!required.empty()) schema["required"] = std::move(required);
  OrderedJson choices = OrderedJson::array();
  for (const auto& keys : model::choicesOf<Owner>()) {
    OrderedJson one_of = OrderedJson::array();
    for (const std::string_view key : keys) one_of.push_back({{"required", OrderedJson::array({key})}});
    choices.push_back({{"oneOf", std::move(one_of)}});
  }
  if (choices.size() == 1) schema.update(choices[0]);
  if (choices.size() > 1) schema["allOf"] = std::move(choices);
  schema["additionalProperties"] = false;
  return schema;
}

// The tables of keys.

std::string code(std::string_view text) {
  std::string out("`");
  out += text;
  return out += '`';
}

/// A cell's text: a bar would end the cell.
std::string inCell(std::string_view text) {
  std::string out;
  for (const char c : text) (out += c == '|' ? "\\" : "") += c;
  return out;
}

std::string withRange(std::string_view type, const model::Range& range) {
  const std::string text = model::rangeText(range);
  return std::string(type) + (text.empty() ? "" : ", " + text);
}

/// The type and the range of one key's value, for people.
template <class T>
std::string valuesText(const model::Info& info) {
  std::string words;
  for (const std::string_view word : info.words) (words += words.empty() ? "" : ", ") += code(word);
  if constexpr (std::is_same_v<T, model::Ignored>) {
    return "anything";
  } else if constexpr (std::is_same_v<T, model::Version>) {
    return "`\"MAJOR.MINOR\"` or `\"MAJOR.MINOR.PATCH\"`";
  } else if constexpr (std::is_same_v<T, bool>) {
    return "`true` or `false`";
  } else if constexpr (std::is_same_v<T, double>) {
    return withRange("number", info.range);
  } else if constexpr (std::is_same_v<T, uint32_t> || std::is_same_v<T, uint64_t>) {
    return withRange("whole number", info.range);
  } else if constexpr (std::is_same_v<T, std::optional<double>>) {
    return (info.unset.empty() ? "" : code(inQuotes(info.unset)) + ", or ") + withRange("number", info.range);
  } else if constexpr (kIsPair<T>) {
    return withRange("2 numbers", info.range);
  } else if constexpr (kIsNamePair<T>) {
    return "2 names";
  } else if constexpr (kIsVector<T>) {
    return withRange(std::string(std::is_same_v<T, Quaternion> ? "4" : "3") + " numbers", info.range);
  } else if constexpr (std::is_same_v<T, SideMask>) {
    return "list of " + words;
  } else if constexpr (model::kIsList<T>) {
    return std::string("list of objects") + (info.most > 0 ? ", at most " + grouped(info.most) : "");
  } else if constexpr (model::Described<typename model::Inner<T>::Type>) {
    return "object";
  } else {
    return words.empty() ? "text" : words;
  }
}

/// The keys of one kind of object, and the places in a scene that have such an object.
struct KeySection {
  std::string_view about;
  std::vector<std::string> paths;
  std::string text;
};

/// Adds the section of the object at `path`, and those of the objects inside it; an object that is described already gets one more path.
template <class Owner>
void addSection(const std::string& path, std::vector<KeySection>& out) {
  for (KeySection& known : out) {
    if (known.about != model::Table<Owner>::about) continue;
    known.paths.push_back(path);
    return;
  }
  std::string text(model::Table<Owner>::about);
  text += '.';
  for (const auto& keys : model::choicesOf<Owner>()) {
    std::string choice;
    for (const std::string_view key : keys) (choice += choice.empty() ? "" : ", ") += code(key);
    text += " Exactly one of " + choice + " is given.";
  }
  text += "\n\n| key | unit | value | default | meaning |\n| --- | --- | --- | --- | --- |\n";
  model::forEachField<Owner>([&](const auto& field) {
    using T = typename std::remove_cvref_t<decltype(field)>::Value;
    std::string fallback = field.info.required ? "required" : "";
    if constexpr (model::kHasMember<T>) {
      const Owner defaults{};
      const T* given = field.find(defaults);
      const OrderedJson value = given ? defaultJson(field.info, *given) : OrderedJson();
      if (!value.is_null() && !field.info.required) fallback = code(value.dump());
    }
    const std::string cells[] = {code(field.info.key), std::string(field.info.unit), valuesText<T>(field.info), fallback,
                                 std::string(field.info.help) + sinceText(field.info)};
    for (const std::string& cell : cells) (text += "| ") += inCell(cell) + (cell.empty() ? "" : " ");
    text += "|\n";
  });
  out.push_back({model::Table<Owner>::about, {path}, std::move(text)});
  model::forEachField<Owner>([&](const auto& field) {
    using T = typename std::remove_cvref_t<decltype(field)>::Value;
    using Inner = typename model::Inner<T>::Type;
    const std::string inside = (path.empty() ? "" : path + ".") + std::string(field.info.key) + (model::kIsList<T> ? "[]" : "");
    if constexpr (!std::is_void_v<Inner>) addSection<Inner>(inside, out);
  });
}

}  // namespace

std::string sceneSchema() {
  OrderedJson schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Rill scene"}};
  schema.update(objectSchema<Scene>());
  return schema.dump(1) + "\n";
}

std::string sceneKeyTables() {
  std::vector<KeySection> sections;
  addSection<Scene>("", sections);
  std::string out;
  for (const KeySection& section : sections) {
    std::string title;
    for (const std::string& path : section.paths) (title += title.empty() ? "" : ", ") += path.empty() ? "Top level" : code(path);
    out += (out.empty() ? "### " : "\n### ") + title + "\n\n" + section.text;
  }
  return out;
}

}  // namespace rill
