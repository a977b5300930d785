// Fields for the keys of the scene, from the parser's table: name, unit, range, default, help.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/words.hpp"
#include "model/fields.hpp"
#include "view/panels/board.hpp"

namespace rill::view {
namespace {

/// The shortest text that the parser reads as the same number.
std::string text(double value) {
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return {digits, end};
}

/// A field for a key of the scene. A change is requested when the drag ends.
class KeyField {
 public:
  KeyField(Board& board, std::string_view group, const model::Info& info)
      : board_(board), info_(info), key_(group.empty() ? std::string(info.key) : std::string(group) + "." + std::string(info.key)) {
    ImGui::PushID(key_.c_str());
    ImGui::SetNextItemWidth(width());
  }
  ~KeyField() {
    if (ImGui::IsItemHovered()) showTooltip();
    ImGui::SameLine();
    if (isChanged()) {
      if (ImGui::SmallButton("x")) board_.requests.reset = key_;
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("restore the value of the file");
      ImGui::SameLine();
    }
    ImGui::TextUnformatted(label().c_str());
    if (ImGui::IsItemHovered()) showTooltip();
    ImGui::PopID();
  }
  KeyField(const KeyField&) = delete;
  KeyField& operator=(const KeyField&) = delete;

  void draw(double value) {
    hold({value});
    const double low = info_.range.hasLow() ? info_.range.low : -1e9, high = info_.range.hasHigh() ? info_.range.high : 1e9;
    // A wide or unbounded range changes by a fiftieth of the value per pixel.
    const double part = value_[0] != 0 ? std::abs(value_[0]) : 0.1;
    const double speed = isWideRange() ? part / 50 : (high - low) / 300;
    ImGui::DragScalar("##value", ImGuiDataType_Double, value_.begin(), static_cast<float>(speed), &low, &high, "%.5g",
                      ImGuiSliderFlags_AlwaysClamp);
    edited(text(value_[0]));
  }
  void draw(uint32_t value) { whole(value); }
  void draw(uint64_t value) { whole(value); }
  void draw(const std::optional<double>& value) {
    bool automatic = !value;
    const ImGuiStyle& style = ImGui::GetStyle();
    const float row = width(), word = style.ItemInnerSpacing.x + ImGui::CalcTextSize("auto").x;
    const float besideBox = row - ImGui::GetFrameHeight() - style.ItemSpacing.x;
    const bool named = automatic || besideBox - word >= 1.5f * narrowest();  // else the number needs the place of the word
    if (ImGui::Checkbox(named ? "auto###auto" : "###auto", &automatic)) request(automatic ? "\"auto\"" : text(middle()));
    if (automatic) return;
    if (!named && ImGui::IsItemHovered()) ImGui::SetTooltip("auto");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(std::max(besideBox - (named ? word : 0), narrowest()));
    draw(value.value_or(0));
  }
  void draw(const std::string& value) { choice(value); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void draw(const Enum& value) { choice(std::string(info_.words[static_cast<size_t>(value)])); }
  void draw(const Double3& value) {
    hold(value);
    ImGui::SetNextItemWidth(ImGui::GetWindowContentRegionMax().x * 0.5f);
    ImGui::DragScalarN("##value", ImGuiDataType_Double, value_.begin(), 3, 0.05f, nullptr, nullptr, "%.3g");
    edited("[" + text(value_[0]) + ", " + text(value_[1]) + ", " + text(value_[2]) + "]");
  }

 private:
  bool isLive() const { return board_.session.isLive(key_); }
  bool isChanged() const { return board_.session.isChanged(key_); }
  std::string unit() const { return info_.unit.empty() ? "" : " [" + std::string(info_.unit) + "]"; }
  std::string label() const { return std::string(info_.key) + unit() + (isLive() ? "" : " *"); }
  static float narrowest() { return 2 * ImGui::GetFontSize(); }
  /// Of the field; less where the label is long, so that the panel shows all of it.
  float width() const {
    const ImGuiStyle& style = ImGui::GetStyle();
    float beside = ImGui::CalcTextSize(label().c_str()).x + style.ItemSpacing.x;
    if (isChanged()) beside += ImGui::CalcTextSize("x").x + 2 * style.FramePadding.x + style.ItemSpacing.x;
    const float end = ImGui::GetWindowContentRegionMax().x, room = end - ImGui::GetCursorPosX() - beside;
    return std::max(std::min(0.42f * end, room), narrowest());
  }
  void showTooltip() const {
    std::string about = key_ + unit() + ": " + std::string(info_.help);
    if (!isLive()) about += "\nA change restarts the scene.";
    if (info_.words.empty()) about += "\nDrag it, or double-click to type.";
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextUnformatted(about.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  bool isWideRange() const {
    return !(info_.range.hasLow() && info_.range.hasHigh()) || info_.range.high > 100 * std::max(info_.range.low, 0.1);
  }
  double middle() const {
    return info_.range.hasHigh() ? 0.5 * (std::max(info_.range.low, 0.0) + info_.range.high) : info_.unit == "s" ? 0.002 : 0.02;
  }
  void whole(uint64_t value) {
    hold({static_cast<double>(value)});
    uint64_t number = static_cast<uint64_t>(value_[0]);
    const uint64_t low = static_cast<uint64_t>(std::max(info_.range.low, 0.0));
    const uint64_t high = info_.range.hasHigh() ? static_cast<uint64_t>(info_.range.high) : UINT32_MAX;
    ImGui::DragScalar("##value", ImGuiDataType_U64, &number, std::max(0.1f, static_cast<float>(value) / 100), &low, &high, nullptr,
                      ImGuiSliderFlags_AlwaysClamp);
    value_[0] = static_cast<double>(number);
    edited(std::to_string(number));
  }
  void choice(const std::string& value) {
    if (!ImGui::BeginCombo("##value", value.c_str())) return;
    for (const std::string_view word : info_.words)
      if (ImGui::Selectable(std::string(word).c_str(), word == value)) request(inQuotes(word));
    ImGui::EndCombo();
  }
  /// Shows the numbers of the scene, or those that are being dragged.
  void hold(const Double3& scene) { value_ = board_.held.key == key_ ? board_.held.value : scene; }
  void edited(std::string json) {
    if (ImGui::IsItemDeactivatedAfterEdit()) request(std::move(json));
    if (ImGui::IsItemActive())
      board_.held = {key_, value_};
    else if (board_.held.key == key_)
      board_.held = {};
  }
  void request(std::string json) { board_.requests.change = Override{key_, std::move(json)}; }

  Board& board_;
  const model::Info& info_;
  std::string key_;
  Double3 value_{};
};

template <class Value>
inline constexpr bool kDrawn = std::is_same_v<Value, double> || std::is_same_v<Value, uint32_t> || std::is_same_v<Value, uint64_t> ||
                               std::is_same_v<Value, std::optional<double>> || std::is_same_v<Value, Double3> || std::is_enum_v<Value>;

template <class Owner>
void group(Board& board, const char* name, const Owner& owner) {
  if (!ImGui::TreeNodeEx(name, ImGuiTreeNodeFlags_DefaultOpen | ImGuiTreeNodeFlags_SpanAvailWidth)) return;
  model::forEachField<Owner>([&](const auto& field) {
    using Value = typename std::decay_t<decltype(field)>::Value;
    if constexpr (model::kHasMember<Value> && (kDrawn<Value> || std::is_same_v<Value, std::string>)) {
      if (std::is_same_v<Value, std::string> && field.info.words.empty()) return;
      if (field.info.key == "particles") return;  // given by the spacing
      KeyField(board, name, field.info).draw(owner.*(field.member));
    }
  });
  ImGui::TreePop();
}

/// What is poured and thrown.
void pouredChoice(Board& board, const std::vector<ResolvedFluid>& fluids) {
  const size_t known = fluidIndex(board.session.scene(), board.settings.poured), chosen = known < fluids.size() ? known : 0;
  ImGui::SetNextItemWidth(ImGui::GetWindowContentRegionMax().x * 0.42f);
  if (ImGui::BeginCombo("poured, thrown", fluids[chosen].name.c_str())) {
    for (size_t k = 0; k < fluids.size(); ++k) {
      ImGui::PushID(static_cast<int>(k));
      if (ImGui::Selectable(fluids[k].name.c_str(), k == chosen)) board.settings.poured = fluids[k].name;
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("the fluid of the tap (key T) and of balls that are thrown (Space)");
}

/// The materials of several fluids. What a fluid does not give is shown as that of `fluid`.
void fluidsGroup(Board& board, const Scene& scene) {
  if (scene.fluids.empty()) return;
  const std::vector<ResolvedFluid> fluids = resolvedFluids(scene);
  pouredChoice(board, fluids);
  for (size_t k = 0; k < fluids.size(); ++k) {
    const std::string path = elementPath("fluids", k);
    constexpr ImGuiTreeNodeFlags kFlags = ImGuiTreeNodeFlags_DefaultOpen | ImGuiTreeNodeFlags_SpanAvailWidth;
    if (!ImGui::TreeNodeEx(path.c_str(), kFlags, "%s", fluids[k].name.c_str())) continue;
    model::forEachField<FluidMaterial>([&](const auto& field) {
      if (field.info.key == "density") KeyField(board, path, field.info).draw(fluids[k].density);
      if (field.info.key == "viscosity") KeyField(board, path, field.info).draw(fluids[k].viscosity);
      if (field.info.key == "surface_tension")
        KeyField(board, path, field.info).draw(scene.fluids[k].surface_tension.value_or(scene.fluid.surface_tension));
      if (field.info.key == "yield_stress") KeyField(board, path, field.info).draw(fluids[k].yieldStress);
      if (field.info.key == "flow_index") KeyField(board, path, field.info).draw(fluids[k].flowIndex);
    });
    ImGui::TreePop();
  }
}

}  // namespace

void parameterPanel(Board& board) {
  const Scene& scene = board.session.scene();
  ImGui::TextDisabled("* restarts the scene");
  model::forEachField<Scene>([&](const auto& field) {
    using Value = typename std::decay_t<decltype(field)>::Value;
    if constexpr (std::is_same_v<Value, Double3>) KeyField(board, "", field.info).draw(scene.*(field.member));
  });
  group(board, "fluid", scene.fluid);
  fluidsGroup(board, scene);
  group(board, "solver", scene.solver);
  group(board, "look", scene.look);
}

}  // namespace rill::view
