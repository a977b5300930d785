// checkScene(): the field table and the rules, applied to a scene that was made in code.
#include <algorithm>

#include "core/words.hpp"
#include "model/rules.hpp"

namespace rill {
namespace {

/// Every function returns false after the first error; message() describes it.
class Checker {
 public:
  const std::string& message() const { return message_; }

  template <class Owner>
  bool object(const std::string& path, const Owner& owner) {
    constexpr auto choices = model::choicesOf<Owner>();
    std::array<std::vector<std::string_view>, choices.size()> chosen;
    bool ok = true;
    model::forEachField<Owner>([&](const auto& field) {
      using Value = typename std::remove_cvref_t<decltype(field)>::Value;
      if constexpr (model::kHasMember<Value>) {
        const Value* member = field.find(owner);
        constexpr bool kIsMesh = std::is_same_v<Owner, MeshShape> || std::is_same_v<Owner, MeshMouth>;
        if constexpr (kIsMesh && std::is_same_v<Value, std::filesystem::path>) return;  // a host has a mesh instead
        const auto choice =
            std::ranges::find_if(choices, [&](const auto& keys) { return std::ranges::find(keys, field.info.key) != keys.end(); });
        if (!ok || member == nullptr || (choice != choices.end() && !given(*member))) return;
        if (choice != choices.end()) chosen[static_cast<size_t>(choice - choices.begin())].push_back(field.info.key);
        ok = value(memberPath(path, field.info.key), field.info, *member);
      }
    });
    // The spacing that `particles` led to may be kept beside it (ParticleSet::spacing), so both may be given.
    if constexpr (std::is_same_v<Owner, FluidSettings>) chosen[0].resize(std::min<size_t>(chosen[0].size(), 1));
    for (size_t i = 0; i < choices.size(); ++i) ok = ok && accept(path, model::checkOneOf(choices[i], chosen[i]));
    return ok && accept(path, model::checkRules(owner));
  }

 private:
  bool accept(const std::string& path, const model::CheckResult& result) {
    if (!result) return true;
    std::string where = path;
    if (!result->keys.empty()) {
      const std::string& key = result->keys.front();
      where += (where.empty() || key.starts_with('[') ? "" : ".") + key;
    }
    message_ = where + ": " + result->text;
    return false;
  }

  /// Whether an alternative of `one_of` is given. A number is 0 if it is not.
  template <class T>
  static bool given(const T& value) {
    return value != T{};
  }
  template <class T>
  static bool given(const std::optional<T>& value) {
    return value.has_value();
  }
  static bool given(const std::string& text) { return !text.empty(); }
  template <class T>
  requires std::is_class_v<T>
  static bool given(const T&) { return true; }

  bool value(const std::string& path, const model::Info& info, double given) {
    return accept(path, model::checkNumber(info, given, false, shortestNumber(given)));
  }
  bool value(const std::string& path, const model::Info& info, uint64_t given) {
    return accept(path, model::checkNumber(info, static_cast<double>(given), true, std::to_string(given)));
  }
  bool value(const std::string& path, const model::Info& info, uint32_t given) { return value(path, info, uint64_t{given}); }
  bool value(const std::string&, const model::Info&, bool) { return true; }
  bool value(const std::string& path, const model::Info& info, SideMask given) {
    if (given >> info.words.size() == 0) return true;
    return accept(path,
                  model::Fault{"invalid bit mask " + std::to_string(given) + "; expected only the bits of " + quotedList(info.words)});
  }
  bool value(const std::string& path, const model::Info& info, const std::string& given) {
    return info.words.empty() || accept(path, model::checkChoice(info, given));
  }
  bool value(const std::string& path, const model::Info& info, const std::filesystem::path& given) {
    return (!info.required && given.empty()) || accept(path, model::checkFileName(given.string()));
  }
  bool value(const std::string& path, const model::Info& info, const std::pair<double, double>& given) {
    return value(elementPath(path, 0), info, given.first) && value(elementPath(path, 1), info, given.second);
  }
  bool value(const std::string&, const model::Info&, const std::pair<std::string, std::string>&) { return true; }
  bool value(const std::string& path, const model::Info& info, const Double3& given) { return components(path, info, given); }
  bool value(const std::string& path, const model::Info& info, const Quaternion& given) { return components(path, info, given); }
  template <class Vector>
  bool components(const std::string& path, const model::Info& info, const Vector& given) {
    for (size_t i = 0; i < std::ranges::size(given); ++i)
      if (!value(elementPath(path, i), info, given[i])) return false;
    return true;
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  bool value(const std::string& path, const model::Info& info, Enum given) {
    const auto number = static_cast<size_t>(given);
    if (number < info.words.size()) return true;
    return accept(path, model::Fault{"invalid enum value " + std::to_string(number) + "; expected the value of " + quotedList(info.words)});
  }
  template <model::Described Struct>
  bool value(const std::string& path, const model::Info&, const Struct& given) {
    return object(path, given);
  }
  template <class T>
  bool value(const std::string& path, const model::Info& info, const std::optional<T>& given) {
    return !given || value(path, info, *given);
  }
  template <class T>
  bool value(const std::string& path, const model::Info& info, const std::vector<T>& given) {
    if (!accept(path, model::checkLength(info, given.size()))) return false;
    for (size_t i = 0; i < given.size(); ++i)
      if (!object(elementPath(path, i), given[i])) return false;
    return accept(path, model::checkRules(given));
  }

  std::string message_;
};

}  // namespace

Expected<void> checkScene(const Scene& scene) {
  Checker checker;
  if (checker.object("", scene)) return {};
  const std::string name = scene.file.empty() ? scene.name : scene.file.string();
  return Error{ErrorKind::BadInput, (name.empty() ? "" : name + ": ") + checker.message()};
}

}  // namespace rill
