#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "support.hpp"

namespace rill::test {
namespace {

using nlohmann::json;

const std::filesystem::path kSceneFolder = std::filesystem::path(RILL_SOURCE_DIR) / "assets/scenes";

/// Validates `value` by the subset of JSON Schema draft-07 that the scene schema uses. Returns the first violation, or an empty string.
std::string violation(const json& schema, const json& value, const std::string& at = "") {
  static const std::set<std::string> known{
      "$schema",         "title",    "description", "default",     "type",    "properties", "additionalProperties",
      "required",        "oneOf",    "allOf",       "enum",        "const",   "pattern",    "minLength",
      "items",           "minItems", "maxItems",    "uniqueItems", "minimum", "maximum",    "exclusiveMinimum",
      "exclusiveMaximum"};
  for (const auto& [key, rule] : schema.items()) {
    if (!known.contains(key)) return at + ": the schema uses " + key;
  }
  const std::string type = schema.value("type", "");
  const bool whole = value.is_number() && value.get<double>() == std::floor(value.get<double>());
  if ((type == "object" && !value.is_object()) || (type == "array" && !value.is_array()) || (type == "string" && !value.is_string()) ||
      (type == "number" && !value.is_number()) || (type == "boolean" && !value.is_boolean()) || (type == "integer" && !whole))
    return at + ": type " + type;
  if (schema.contains("const") && value != schema["const"]) return at + ": const";
  if (schema.contains("enum") && std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
    return at + ": enum";
  if (schema.contains("oneOf")) {
    const auto valid = std::count_if(schema["oneOf"].begin(), schema["oneOf"].end(),
                                     [&](const json& choice) { return violation(choice, value, at).empty(); });
    if (valid != 1) return at + ": oneOf";
  }
  for (const json& part : schema.value("allOf", json::array())) {
    if (auto bad = violation(part, value, at); !bad.empty()) return bad;
  }
  if (value.is_number()) {
    const double v = value.get<double>();
    if (schema.contains("minimum") && v < schema["minimum"].get<double>()) return at + ": minimum";
    if (schema.contains("maximum") && v > schema["maximum"].get<double>()) return at + ": maximum";
    if (schema.contains("exclusiveMinimum") && v <= schema["exclusiveMinimum"].get<double>()) return at + ": exclusiveMinimum";
    if (schema.contains("exclusiveMaximum") && v >= schema["exclusiveMaximum"].get<double>()) return at + ": exclusiveMaximum";
  }
  if (value.is_string()) {
    const auto text = value.get<std::string>();
    if (schema.contains("pattern") && !std::regex_search(text, std::regex(schema["pattern"].get<std::string>()))) return at + ": pattern";
    if (text.size() < schema.value("minLength", 0U)) return at + ": minLength";
  }
  if (value.is_array()) {
    if (value.size() < schema.value("minItems", 0U) || value.size() > schema.value("maxItems", size_t{1} << 30))
      return at + ": number of items";
    if (schema.value("uniqueItems", false) && std::set<json>(value.begin(), value.end()).size() != value.size())
      return at + ": uniqueItems";
    for (size_t i = 0; schema.contains("items") && i < value.size(); ++i) {
      if (auto bad = violation(schema["items"], value[i], at + "/" + std::to_string(i)); !bad.empty()) return bad;
    }
  }
  if (value.is_object()) {
    for (const json& key : schema.value("required", json::array())) {
      if (!value.contains(key.get<std::string>())) return at + ": required " + key.get<std::string>();
    }
    for (const auto& [key, inner] : value.items()) {
      if (schema.contains("properties") && schema["properties"].contains(key)) {
        if (auto bad = violation(schema["properties"][key], inner, at + "/" + key); !bad.empty()) return bad;
      } else if (!schema.value("additionalProperties", true)) {
        return at + ": additional " + key;
      }
    }
  }
  return {};
}

json commented(const std::string& text) { return json::parse(text, nullptr, false, true); }

std::string fileText(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Schema, FileMatchesFieldTable) {
  const std::filesystem::path fresh = std::filesystem::path(RILL_BINARY_DIR) / "scene.schema.json";
  std::ofstream(fresh, std::ios::binary) << sceneSchema();
  EXPECT_TRUE(fileText(kSceneFolder / "scene.schema.json") == sceneSchema())
      << "the field table has changed; update the schema: cp " << fresh.string() << " assets/scenes/";
}

TEST(Schema, AcceptsEveryShippedScene) {
  const json schema = json::parse(sceneSchema());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kSceneFolder)) {
    if (entry.path().extension() != ".json" || entry.path().filename() == "scene.schema.json") continue;
    EXPECT_EQ(violation(schema, commented(fileText(entry.path()))), "") << entry.path();
  }
}

/// The schema and the parser accept the same scenes.
TEST(Schema, AgreesWithTheParser) {
  const json schema = json::parse(sceneSchema());
  const auto flow = [](const std::string& more) { return R"({"rill": "0.2", "fluid": {"spacing": 1}, )" + more + "}"; };
  const std::string texts[] = {withFluid(R"("spacing": 0.1)"),
                               withFluid(R"("particles": 100)"),
                               withFluid(""),
                               withFluid(R"("spacing": 0.1, "particles": 3)"),
                               withFluid(R"("spacing": 0)"),
                               withFluid(R"("particles": 0)"),
                               withFluid(R"("particles": 1.5)"),
                               withFluid(R"("spacing": 0.1, "viscosty": 1)"),
                               withFluid(R"("spacing": 1, "tensile_radius": 1)"),
                               withFluid(R"("spacing": 1, "smoothing_ratio": 4)"),
                               R"({"rill": "0.1"})",
                               R"({"rill": 0.1, "fluid": {"spacing": 1}})",
                               R"({"rill": "x", "fluid": {"spacing": 1}})",
                               with(R"("solver": {"time_step": "auto", "relaxation": 0.5})"),
                               with(R"("solver": {"time_step": "never"})"),
                               with(R"("solver": {"time_step": 0})"),
                               with(R"("solver": {"warm_start": 0.5, "kernel": "wendland", "neighbors": "grid"})"),
                               with(R"("solver": {"warm_start": 0.6})"),
                               with(R"("solver": {"kernel": "x"})"),
                               with(R"("domain": {"open": ["+y"]})"),
                               with(R"("domain": {"open": ["+y", "+y"]})"),
                               with(R"("domain": {"open": ["y"]})"),
                               with(R"("domain": {"open": []})"),
                               with(R"("gravity": [0, 1])"),
                               with(R"("gravity": [0, 1, 2, 3])"),
                               with(R"("seed": -1)"),
                               with(R"("seed": 18446744073709551615)"),
                               with(R"("fill": [{}])"),
                               with(R"("fill": [{"box": {}}, {"sphere": {}}])"),
                               with(R"("fill": [{"box": {}, "sphere": {}}])"),
                               with(R"("fill": [{"particles": {}}])"),
                               with(R"("solids": [{"box": {}, "rotation": [0, 0, 1]}])"),
                               with(R"("solids": [{"box": {}, "motion": [{"at": 0, "translate": [1, 2, 3]}]}])"),
                               with(R"("solids": [{"box": {}, "motion": [{"at": -1}]}])"),
                               with(R"("probes": [{"name": "", "front": "+x"}])"),
                               with(R"("probes": [{"name": "a", "front": "x"}])"),
                               with(R"("probes": [{"name": "a", "level": [0, 1]}])"),
                               with(R"("probes": [{"level": [0, 1]}])"),
                               flow(R"("emitters": [], "drains": [])"),
                               flow(R"("emitters": [{"disc": {}, "flow": 1}, {"rect": {"size": [1, 2]}, "speed": 2, "until": 3}])"),
                               flow(R"("emitters": [{"disc": {}}])"),
                               flow(R"("emitters": [{"flow": 1}])"),
                               flow(R"("emitters": [{"disc": {}, "rect": {}, "flow": 1}])"),
                               flow(R"("emitters": [{"disc": {}, "flow": 1, "speed": 1}])"),
                               flow(R"("emitters": [{"disc": {}, "flow": 0}])"),
                               flow(R"("emitters": [{"disc": {}, "flow": 1, "until": "auto"}])"),
                               flow(R"("emitters": [{"rect": {"size": [1]}, "flow": 1}])"),
                               flow(R"("emitters": [{"rect": {"size": [0, 1]}, "flow": 1}])"),
                               flow(R"("drains": [{"sphere": {}, "from": 1, "until": 2}])"),
                               flow(R"("drains": [{"box": {}, "sphere": {}}])"),
                               flow(R"("drains": [{"mesh": {}}])"),
                               flow(R"("domain": {"open": ["+y"], "open_removes": 1})"),
                               R"({"rill": "0.2", "fluid": {"spacing": 1, "capacity": 67108864}})",
                               R"({"rill": "0.2", "fluid": {"spacing": 1, "capacity": 67108865}})",
                               with(R"("camera": {"fov_y_deg": 0})"),
                               with(R"("look": {"surface": "planes"})"),
                               with(R"("look": {"preset": 3})"),
                               with(R"("extras": 3, "$schema": "x")"),
                               with(R"("title": 3)"),
                               with(R"("unknown": 3)")};
  for (const std::string& text : texts) {
    const std::string parsed = parseError(text), by_schema = violation(schema, commented(text));
    EXPECT_EQ(parsed == "accepted", by_schema.empty()) << text << "\n" << parsed << "\n" << by_schema;
  }
}

TEST(KeyTables, HaveARowForEveryKeyWithItsDefault) {
  const std::string tables = sceneKeyTables();
  for (const std::string row :
       {"| `viscosity` | Pa s | number, at least 0 | `0` |", "| `time_step` | s | `\"auto\"`, or number, above 0 | `\"auto\"` |",
        "| `jitter` | | number, from 0 to 0.5 | `0` |", "| `translate` | m | 3 numbers | `[0,0,0]` |", "| `file` | | text | required |",
        "| `rill` | | `\"MAJOR.MINOR\"` or `\"MAJOR.MINOR.PATCH\"` | required |",
        "| `kernel` | | `wendland`, `poly6_spiky` | `\"wendland\"` |", "| `spacing` | m | number, above 0 | |",
        "| `solids` | | list of objects, at most 4,096 | `[]` |", "| `seed` | | whole number, from 0 to 18446744073709551615 | `1` |",
        R"(sum of \|grad C\|^2;)", "### `fill[].box`, `solids[].box`, `drains[].box`\n", "| `size` | m | 2 numbers, above 0 | `[1,1]` |",
        "| `until` | s | number, above 0 | | time",
        "Exactly one of `disc`, `rect`, `mesh` is given. Exactly one of `flow`, `speed` is given.",
        "Exactly one of `spacing`, `particles` is given."}) {
    EXPECT_NE(tables.find(row), std::string::npos) << row << "\n" << tables;
  }
}

}  // namespace
}  // namespace rill::test
