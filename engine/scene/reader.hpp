#pragma once
// Reads JSON into the structs of a Scene by the table in model/fields.hpp. Reading stops at the first error.
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/words.hpp"
#include "model/rules.hpp"
#include "scene/overrides.hpp"

namespace rill {

/// The JSON value as messages show it: "found an array of length 2".
std::string foundText(const Json& json);

/// Reads one scene. Every function returns false after the first error; message() describes it.
class Reader {
 public:
  Reader(std::string_view name, const OverrideMarks& marks, std::filesystem::path folder)
      : name_(name), marks_(marks), folder_(std::move(folder)) {}

  const std::string& message() const { return message_; }

  /// Reads the version key alone, so that a newer scene is rejected for its version and not for an unknown key.
  bool version(const Json& root);

  /// Reads a JSON object into `owner`. Checks unknown keys, then each value, then the rules between keys.
  template <class Owner>
  bool object(const Json& json, const std::string& path, Owner& owner) {
    if (!json.is_object()) return fail(path, foundText(json) + ", expected an object");
    for (const auto& item : json.items()) {
      if (!known<Owner>(item.key())) return unknownKey(path, item.key(), item.value(), model::keysOf<Owner>());
    }
    bool ok = true;
    model::forEachField<Owner>([&](const auto& field) {
      if (ok) ok = member(json, path, field, owner);
    });
    if constexpr (std::is_same_v<Owner, Solid> || std::is_same_v<Owner, Fill> || std::is_same_v<Owner, MeshMouth>)
      normalize(owner.rotation);
    if constexpr (std::is_same_v<Owner, Keyframe>) normalize(owner.rotate);
    if constexpr (std::is_same_v<Owner, MeshShape>) ok = ok && loadMesh(path, owner, owner.two_sided);
    if constexpr (std::is_same_v<Owner, MeshMouth>) ok = ok && loadMesh(path, owner, true);
    for (const auto& keys : model::choicesOf<Owner>()) ok = ok && exactlyOne(json, path, keys);
    if constexpr (std::is_same_v<Owner, Scene>)
      if (ok && !emptyFluid_.empty()) return accept(emptyFluid_, model::emptyFluidName(owner));
    return ok && accept(path, model::checkRules(owner));
  }

 private:
  bool fail(const std::string& path, const std::string& text);
  /// On a fault, reports the first candidate key that an override has set, else the first candidate.
  bool accept(const std::string& path, const model::CheckResult& result);
  static void normalize(Quaternion& quaternion);
  /// Reads the file of a mesh, once for all solids, fills and mouths that have the same.
  template <class Owner>
  bool loadMesh(const std::string& path, Owner& shape, bool twoSided) {
    std::shared_ptr<const Mesh>& known = meshes_[{shape.file.string(), shape.scale, shape.up, twoSided}];
    if (!known && !readMeshOf(path, {.file = shape.file, .scale = shape.scale, .up = shape.up, .two_sided = twoSided}, known)) return false;
    shape.mesh = known;
    return true;
  }
  bool readMeshOf(const std::string& path, const MeshShape& shape, std::shared_ptr<const Mesh>& out);
  bool unknownKey(const std::string& path, const std::string& key, const Json& value, const std::vector<std::string_view>& keys);
  /// Whether the scene's version has the key.
  bool allowed(const std::string& path, const model::Info& info);
  bool exactlyOne(const Json& json, const std::string& path, std::span<const std::string_view> keys);

  template <class Owner>
  static bool known(std::string_view key) {
    bool found = false;
    model::forEachField<Owner>([&](const auto& field) { found = found || field.info.key == key; });
    return found;
  }

  template <class Owner, class Field>
  bool member(const Json& json, const std::string& path, const Field& field, Owner& owner) {
    if constexpr (model::kHasMember<typename Field::Value>) {
      const auto found = json.find(std::string(field.info.key));
      const std::string here = memberPath(path, field.info.key);
      if (found != json.end() && !allowed(here, field.info)) return false;
      if (found != json.end()) return value(*found, here, field.info, field.set(owner));
      if (field.info.required) return fail(here, "required key is missing: " + std::string(field.info.help));
    }
    return true;
  }

  // Readers of a value, selected by the type of the member that it sets.
  bool number(const Json& json, const std::string& path, const model::Info& info, bool whole, double& out);
  bool numbers(const Json& json, const std::string& path, const model::Info& info, std::string_view shape, std::span<double> out);
  bool pair(const Json& json, const std::string& path, const model::Info& info, std::string_view shape, std::pair<double, double>& out);
  bool word(const Json& json, const std::string& path, const model::Info& info, size_t& out);
  bool text(const Json& json, const std::string& path, std::string& out);

  bool value(const Json& json, const std::string& path, const model::Info& info, double& out) {
    return number(json, path, info, false, out);
  }
  bool value(const Json& json, const std::string& path, const model::Info& info, uint32_t& out);
  bool value(const Json& json, const std::string& path, const model::Info& info, uint64_t& out);
  bool value(const Json& json, const std::string& path, const model::Info& info, bool& out);
  bool value(const Json& json, const std::string& path, const model::Info& info, std::string& out);
  bool value(const Json& json, const std::string& path, const model::Info& info, SideMask& out);
  bool value(const Json& json, const std::string& path, const model::Info& info, std::optional<double>& out);
  bool value(const Json& json, const std::string& path, const model::Info& info, std::pair<double, double>& out) {
    return pair(json, path, info, "[width, height]", out);
  }
  bool value(const Json& json, const std::string& path, const model::Info& info, std::optional<std::pair<double, double>>& out) {
    return pair(json, path, info, "[x, z]", out.emplace());
  }
  bool value(const Json& json, const std::string& path, const model::Info& info, std::pair<std::string, std::string>& out);
  bool value(const Json& json, const std::string& path, const model::Info& info, std::filesystem::path& out);
  bool value(const Json& json, const std::string& path, const model::Info& info, Double3& out) {
    return numbers(json, path, info, info.parts, out);
  }
  bool value(const Json& json, const std::string& path, const model::Info& info, std::optional<Double3>& out) {
    return value(json, path, info, out.emplace());
  }
  bool value(const Json& json, const std::string& path, const model::Info& info, Quaternion& out) {
    return numbers(json, path, info, "[x, y, z, w]", out);
  }

  template <class Enum>
  requires std::is_enum_v<Enum>
  bool value(const Json& json, const std::string& path, const model::Info& info, Enum& out) {
    size_t index = 0;
    if (!word(json, path, info, index)) return false;
    out = static_cast<Enum>(index);
    return true;
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  bool value(const Json& json, const std::string& path, const model::Info& info, std::optional<Enum>& out) {
    return value(json, path, info, out.emplace());
  }
  template <model::Described Struct>
  bool value(const Json& json, const std::string& path, const model::Info&, Struct& out) {
    return object(json, path, out);
  }
  template <model::Described Struct>
  bool value(const Json& json, const std::string& path, const model::Info&, std::optional<Struct>& out) {
    return object(json, path, out.emplace());
  }
  template <model::Described Struct>
  bool value(const Json& json, const std::string& path, const model::Info& info, std::vector<Struct>& out) {
    if (!json.is_array()) return fail(path, foundText(json) + ", expected a list of objects");
    if (!accept(path, model::checkLength(info, json.size()))) return false;
    out.reserve(json.size());
    for (size_t i = 0; i < json.size(); ++i) {
      if (!object(json[i], elementPath(path, i), out.emplace_back())) return false;
    }
    return accept(path, model::checkRules(out));
  }

  std::string name_;
  const OverrideMarks& marks_;
  std::filesystem::path folder_;
  std::string version_ = "0";                                                                    // as the scene gives it
  std::map<std::tuple<std::string, double, UpAxis, bool>, std::shared_ptr<const Mesh>> meshes_;  // by file, scale, up, two_sided
  std::string emptyFluid_;  // path of the first key that gives a fluid's name as ""
  std::string message_;
};

}  // namespace rill
