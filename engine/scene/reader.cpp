#include "scene/reader.hpp"

#include <cmath>
#include <limits>

#include "rill/version.hpp"
#include "scene/mesh_file.hpp"

namespace rill {
namespace {

/// Whether a key of type T may have the value, by its kind: an object, a list or anything else.
template <class T>
bool mayHold(const Json& value) {
  if constexpr (model::kIsList<T>) return value.is_array();
  return value.is_object() == !std::is_void_v<typename model::Inner<T>::Type>;
}

/// A place in a scene where a key could have been meant.
struct KeyPlace {
  std::string path;  ///< dotted; empty: not found
  size_t depth = std::numeric_limits<size_t>::max();
  bool fits = false;  ///< the value that was given
};

/// Finds the outermost place of `key` in Owner, which is at `path`; the first of several.
template <class Owner>
void findKey(std::string_view key, const Json& value, const std::string& path, size_t depth, KeyPlace& found) {
  model::forEachField<Owner>([&](const auto& field) {
    using Value = typename std::remove_cvref_t<decltype(field)>::Value;
    using Inner = typename model::Inner<Value>::Type;
    const std::string here = memberPath(path, field.info.key);
    if (field.info.key == key && depth < found.depth) found = {here, depth, mayHold<Value>(value)};
    if constexpr (!std::is_void_v<Inner>) findKey<Inner>(key, value, model::kIsList<Value> ? here + "[]" : here, depth + 1, found);
  });
}

/// The path of another place that a key and its value may be meant for, or an empty one.
std::string otherPlace(std::string_view key, const Json& value) {
  KeyPlace found;
  findKey<Scene>(key, value, "", 0, found);
  return found.fits ? found.path : "";
}

/// The numbers of "MAJOR.MINOR[.PATCH]", each clamped to a billion; empty for other text.
std::vector<uint32_t> versionNumbers(std::string_view text) {
  constexpr uint32_t kMaxNumber = 1'000'000'000;
  std::vector<uint32_t> numbers;
  bool digit = false;
  for (const char c : text) {
    if (c >= '0' && c <= '9') {
      if (!digit) numbers.push_back(0);
      numbers.back() = numbers.back() >= kMaxNumber / 10 ? kMaxNumber : numbers.back() * 10 + static_cast<uint32_t>(c - '0');
      digit = true;
    } else if (c == '.' && digit) {
      digit = false;
    } else {
      return {};
    }
  }
  if (!digit || numbers.size() < 2 || numbers.size() > 3) return {};
  numbers.resize(3, 0);
  return numbers;
}

}  // namespace

std::string foundText(const Json& json) {
  switch (json.type()) {
    case Json::value_t::null:
      return "found null";
    case Json::value_t::boolean:
      return json.get<bool>() ? "found true" : "found false";
    case Json::value_t::string:
      return "found the string " + inQuotes(json.get_ref<const std::string&>());
    case Json::value_t::array:
      return "found an array of length " + grouped(json.size());
    case Json::value_t::object:
      return "found an object";
    case Json::value_t::number_unsigned:
      return "found " + std::to_string(json.get<uint64_t>());
    case Json::value_t::number_integer:
      return "found " + std::to_string(json.get<int64_t>());
    case Json::value_t::number_float:
      return "found " + shortestNumber(json.get<double>());
    default:
      return "found a value of unknown type";
  }
}

bool Reader::fail(const std::string& path, const std::string& text) {
  if (!message_.empty()) return false;
  if (const OverrideMarks::Mark* mark = marks_.find(path)) {
    message_ = "--set " + mark->key + ": " + (mark->key == path ? "" : path + ": ") + text;
  } else {
    message_ = name_ + ": " + (path.empty() ? "" : path + ": ") + text;
  }
  return false;
}

bool Reader::accept(const std::string& path, const model::CheckResult& result) {
  if (!result) return true;
  const auto whole = [&](const std::string& key) { return path + (path.empty() || key.starts_with('[') ? "" : ".") + key; };
  for (const std::string& key : result->keys) {
    if (marks_.find(whole(key))) return fail(whole(key), result->text);
  }
  return fail(result->keys.empty() ? path : whole(result->keys.front()), result->text);
}

/// Files may hold quaternions of any non-zero length.
void Reader::normalize(Quaternion& quaternion) {
  const double length = std::hypot(std::hypot(quaternion.x, quaternion.y, quaternion.z), quaternion.w);
  for (size_t i = 0; i < 4 && length > 0; ++i) quaternion[i] /= length;
}

bool Reader::readMeshOf(const std::string& path, const MeshShape& shape, std::shared_ptr<const Mesh>& out) {
  auto data = readMesh(shape.file);
  if (!data) return fail(memberPath(path, "file"), data.error().message);
  for (Double3& v : data->vertices) {
    if (shape.up == UpAxis::Z) v = {v.x, v.z, -v.y};
    for (double& x : v) x *= shape.scale;
  }
  if (shape.up == UpAxis::Z)
    for (Float3& n : data->normals) n = {n.x, n.z, -n.y};
  auto mesh = Mesh::create(*std::move(data), shape.two_sided);
  if (!mesh) return fail(memberPath(path, "file"), shape.file.string() + ": " + mesh.error().message);
  out = *std::move(mesh);
  return true;
}

bool Reader::allowed(const std::string& path, const model::Info& info) {
  if (info.since.empty() || versionNumbers(version_) >= versionNumbers(info.since)) return true;
  return fail(path, "the scene says \"rill\": " + inQuotes(version_) + "; the key needs \"rill\": " + inQuotes(info.since));
}

bool Reader::unknownKey(const std::string& path, const std::string& key, const Json& value, const std::vector<std::string_view>& keys) {
  std::string text = "unknown key; ";
  const std::string_view suggestion = nearestWord(key, keys);
  const std::string other = suggestion.empty() ? otherPlace(key, value) : std::string();
  if (!suggestion.empty()) {
    text += "did you mean " + inQuotes(suggestion) + "?";
  } else if (!other.empty()) {
    text += "did you mean " + inQuotes(other) + (other.find('.') == std::string::npos ? ", at the top of the scene?" : "?");
  } else {
    text += "expected one of " + quotedList(keys);
  }
  return fail(memberPath(path, key), text);
}

bool Reader::exactlyOne(const Json& json, const std::string& path, std::span<const std::string_view> keys) {
  std::vector<std::string_view> given;
  for (const std::string_view key : keys) {
    if (json.contains(std::string(key))) given.push_back(key);
  }
  const model::CheckResult result = model::checkOneOf(keys, given);
  if (!result || given.empty()) return accept(path, result);
  const std::string reported = marks_.find(memberPath(path, given[0])) ? memberPath(path, given[0]) : memberPath(path, given[1]);
  return fail(marks_.find(reported) ? reported : path, result->text);
}

bool Reader::version(const Json& root) {
  const std::string path = "rill";
  const auto found = root.find(path);
  const std::string expected = "expected the minimum Rill version, for example \"0.1\"";
  if (found == root.end()) return fail(path, "missing; " + expected);
  std::string given;
  if (!text(*found, path, given)) return false;
  const std::vector<uint32_t> needed = versionNumbers(given);
  if (needed.empty()) return fail(path, "found " + inQuotes(given) + ", " + expected);
  if (needed > versionNumbers(model::kSceneVersion))
    return fail(path, "the scene needs Rill " + given + " or later; this is Rill " RILL_VERSION ", which reads scenes up to " +
                          std::string(model::kSceneVersion));
  version_ = given;
  return true;
}

}  // namespace rill
