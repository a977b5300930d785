// Values of keys by type: numbers, vectors, words, lists of sides, file names.
#include <algorithm>
#include <cmath>

#include "scene/reader.hpp"

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

}  // namespace

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
  if (info.words.empty()) {
    if (!text(json, path, out)) return false;
    if (info.namesFluid && out.empty() && emptyFluid_.empty()) emptyFluid_ = path;
    return true;
  }
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
