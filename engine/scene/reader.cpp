#include "scene/reader.hpp"

#include <algorithm>
#include <cmath>

#include "rill/version.hpp"
#include "scene/mesh_file.hpp"

namespace rill {
namespace {

namespace fs = std::filesystem;

/// Whether a string spells NaN or an infinity, for which JSON has no numbers.
bool isNonFiniteWord(std::string_view text) {
  std::string word;
  for (const char c : text) {
    if (c != '+' && c != '-') word += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  }
  return word == "nan" || word == "inf" || word == "infinity";
}

/// The first dotted path in the scene whose last key is `key`, or an empty one.
template <class Owner>
std::string pathOfKey(std::string_view key, const std::string& path) {
  std::string found;
  model::forEachField<Owner>([&](const auto& field) {
    using Value = typename std::remove_cvref_t<decltype(field)>::Value;
    using Inner = typename model::Inner<Value>::Type;
    if (!found.empty()) return;
    const std::string here = memberPath(path, field.info.key);
    if (field.info.key == key) {
      found = here;
    } else if constexpr (!std::is_void_v<Inner>) {
      found = pathOfKey<Inner>(key, model::kIsList<Value> ? here + "[]" : here);
    }
  });
  return found;
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

bool Reader::loadMesh(const std::string& path, MeshShape& shape) {
  std::shared_ptr<const Mesh>& known = meshes_[{shape.file.string(), shape.scale, shape.up, shape.two_sided}];
  if (!known && !readMeshOf(path, shape, known)) return false;
  shape.mesh = known;
  return true;
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

bool Reader::unknownKey(const std::string& path, const std::string& key, const std::vector<std::string_view>& keys) {
  std::string text = "unknown key; ";
  const std::string_view suggestion = nearestWord(key, keys);
  const std::string other = suggestion.empty() ? pathOfKey<Scene>(key, "") : std::string();
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

bool Reader::number(const Json& json, const std::string& path, const model::Info& info, bool whole, double& out) {
  if (json.is_string() && isNonFiniteWord(json.get_ref<const std::string&>())) {
    return fail(path, foundText(json) + ", which is not finite; expected " + model::expectedNumber(info, whole));
  }
  if (!json.is_number()) return fail(path, foundText(json) + ", expected " + model::expectedNumber(info, whole));
  const double value = json.get<double>();
  if (whole && std::isfinite(value) && value != std::floor(value))
    return fail(path, foundText(json) + ", expected " + model::expectedNumber(info, whole));
  if (!accept(path, model::checkNumber(info, value, whole, foundText(json).substr(6)))) return false;
  out = value;
  return true;
}

bool Reader::numbers(const Json& json, const std::string& path, const model::Info& info, std::string_view shape, std::span<double> out) {
  const auto expected = [&] {
    return ", expected " + std::to_string(out.size()) + " numbers " + std::string(shape) + model::unitText(info);
  };
  if (!json.is_array() || json.size() != out.size()) return fail(path, foundText(json) + expected());
  for (size_t i = 0; i < out.size(); ++i) {
    if (!number(json[i], elementPath(path, i), info, false, out[i])) return false;
  }
  return true;
}

bool Reader::pair(const Json& json, const std::string& path, const model::Info& info, std::string_view shape,
                  std::pair<double, double>& out) {
  double both[2] = {0, 0};
  if (!numbers(json, path, info, shape, both)) return false;
  out = {both[0], both[1]};
  return true;
}

bool Reader::text(const Json& json, const std::string& path, std::string& out) {
  const OverrideMarks::Mark* mark = marks_.valueAt(path);
  if (json.is_string()) {
    out = json.get<std::string>();
  } else if (mark != nullptr) {
    out = mark->text;  // --set title=2024: any override value is accepted as a string
  } else {
    return fail(path, foundText(json) + ", expected a string");
  }
  return true;
}

bool Reader::word(const Json& json, const std::string& path, const model::Info& info, size_t& out) {
  if (!json.is_string()) return fail(path, foundText(json) + ", expected one of " + quotedList(info.words));
  const std::string& given = json.get_ref<const std::string&>();
  out = static_cast<size_t>(std::ranges::find(info.words, given) - info.words.begin());
  return accept(path, model::checkChoice(info, given));
}

bool Reader::value(const Json& json, const std::string& path, const model::Info&, std::pair<std::string, std::string>& out) {
  if (!json.is_array() || json.size() != 2) return fail(path, foundText(json) + ", expected 2 names");
  return text(json[0], elementPath(path, 0), out.first) && text(json[1], elementPath(path, 1), out.second);
}

bool Reader::value(const Json& json, const std::string& path, const model::Info& info, uint32_t& out) {
  double value = 0;
  if (!number(json, path, info, true, value)) return false;
  out = static_cast<uint32_t>(value);
  return true;
}

bool Reader::value(const Json& json, const std::string& path, const model::Info& info, uint64_t& out) {
  double value = 0;
  if (!number(json, path, info, true, value)) return false;
  constexpr double kTooLarge = 18446744073709551616.0;  // 2^64: the bound 2^64 - 1 as a double
  if (json.is_number_unsigned()) {
    out = json.get<uint64_t>();
  } else if (value < kTooLarge) {
    out = static_cast<uint64_t>(value);
  } else {
    return fail(path, foundText(json).substr(6) + " is out of range; expected " + model::expectedNumber(info, true));
  }
  return true;
}

bool Reader::value(const Json& json, const std::string& path, const model::Info&, bool& out) {
  if (!json.is_boolean()) return fail(path, foundText(json) + ", expected true or false");
  out = json.get<bool>();
  return true;
}

bool Reader::value(const Json& json, const std::string& path, const model::Info& info, std::string& out) {
  if (info.words.empty()) return text(json, path, out);
  size_t index = 0;
  if (!word(json, path, info, index)) return false;
  out = std::string(info.words[index]);
  return true;
}

bool Reader::value(const Json& json, const std::string& path, const model::Info& info, SideMask& out) {
  if (!json.is_array()) return fail(path, foundText(json) + ", expected a list of some of " + quotedList(info.words));
  out = 0;
  for (size_t i = 0; i < json.size(); ++i) {
    size_t index = 0;
    if (!word(json[i], elementPath(path, i), info, index)) return false;
    const auto bit = static_cast<SideMask>(1U << index);
    if ((out & bit) != 0) return fail(elementPath(path, i), inQuotes(info.words[index]) + " is given twice; expected each once");
    out = static_cast<SideMask>(out | bit);
  }
  return true;
}

bool Reader::value(const Json& json, const std::string& path, const model::Info& info, std::optional<double>& out) {
  if (json.is_string() && !info.unset.empty()) {
    const std::string& given = json.get_ref<const std::string&>();
    if (given == info.unset) {
      out.reset();
      return true;
    }
    if (!isNonFiniteWord(given))
      return fail(path, foundText(json) + ", expected " + inQuotes(info.unset) + " or " + model::expectedNumber(info, false));
  }
  return number(json, path, info, false, out.emplace());
}

bool Reader::value(const Json& json, const std::string& path, const model::Info&, fs::path& out) {
  std::string given;
  if (!text(json, path, given)) return false;
  if (!accept(path, model::checkFileName(given))) return false;
  // Paths in overrides are relative to the current directory, like other paths on a command line.
  const fs::path given_path = (marks_.find(path) ? fs::path() : folder_) / fs::path(given);
  std::error_code trouble;
  const fs::path whole = fs::absolute(given_path, trouble);
  const fs::path file = (trouble ? given_path : whole).lexically_normal();
  const fs::file_status status = fs::status(file, trouble);
  if (!fs::exists(status)) return fail(path, inQuotes(given) + ": no such file (looked for " + file.string() + ")");
  if (!fs::is_regular_file(status)) return fail(path, inQuotes(given) + ": not a regular file; expected a file");
  out = file;
  return true;
}

}  // namespace rill
