#include "view/interface.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace rill::view {
namespace {

#if IMGUI_VERSION_NUM >= 18700
constexpr ImGuiKey kKeypadEnter = ImGuiKey_KeypadEnter;
#else
constexpr ImGuiKey_ kKeypadEnter = ImGuiKey_KeyPadEnter;
#endif

struct KeyRow {
  int glfw;
  int imgui;
};
// Keys of text fields; all others are handled by the viewer.
constexpr KeyRow kKeys[] = {{GLFW_KEY_TAB, ImGuiKey_Tab},
                            {GLFW_KEY_LEFT, ImGuiKey_LeftArrow},
                            {GLFW_KEY_RIGHT, ImGuiKey_RightArrow},
                            {GLFW_KEY_UP, ImGuiKey_UpArrow},
                            {GLFW_KEY_DOWN, ImGuiKey_DownArrow},
                            {GLFW_KEY_HOME, ImGuiKey_Home},
                            {GLFW_KEY_END, ImGuiKey_End},
                            {GLFW_KEY_DELETE, ImGuiKey_Delete},
                            {GLFW_KEY_BACKSPACE, ImGuiKey_Backspace},
                            {GLFW_KEY_ENTER, ImGuiKey_Enter},
                            {GLFW_KEY_KP_ENTER, kKeypadEnter},
                            {GLFW_KEY_ESCAPE, ImGuiKey_Escape},
                            {GLFW_KEY_A, ImGuiKey_A},
                            {GLFW_KEY_C, ImGuiKey_C},
                            {GLFW_KEY_V, ImGuiKey_V},
                            {GLFW_KEY_X, ImGuiKey_X},
                            {GLFW_KEY_Z, ImGuiKey_Z}};

// Fonts that are more legible than the built-in one, if installed (Debian: fonts-dejavu-core).
constexpr const char* kFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                  "/usr/share/fonts/truetype/liberation2/LiberationSans-Regular.ttf",
                                  "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};
constexpr float kFontPixels = 15;
// Latin, Greek, Cyrillic, punctuation, arrows and mathematical signs.
constexpr ImWchar kLetters[] = {0x20, 0x17f, 0x370, 0x3ff, 0x400, 0x4ff, 0x2010, 0x205e, 0x2190, 0x21ff, 0x2200, 0x22ff, 0};

}  // namespace

Interface::Interface(float scale, std::function<std::string()> paste, std::function<void(const char*)> copy)
    : scale_(scale), paste_(std::move(paste)), copy_(std::move(copy)) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = io.LogFilename = nullptr;  // write no files
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
#if IMGUI_VERSION_NUM < 18700
  for (const KeyRow& row : kKeys) io.KeyMap[row.imgui] = row.glfw;
#endif
  io.ClipboardUserData = this;
  io.GetClipboardTextFn = [](void* self) {
    auto& interface = *static_cast<Interface*>(self);
    interface.pasted_ = interface.paste_();
    return interface.pasted_.c_str();
  };
  io.SetClipboardTextFn = [](void* self, const char* text) { static_cast<Interface*>(self)->copy_(text); };

  std::error_code ignored;
  const auto found = std::ranges::find_if(kFonts, [&](const char* file) { return std::filesystem::is_regular_file(file, ignored); });
  if (found != std::end(kFonts)) {
    io.Fonts->AddFontFromFileTTF(*found, kFontPixels * scale, nullptr, kLetters);
  } else {
    ImFontConfig config;
    config.SizePixels = 13 * scale;
    io.Fonts->AddFontDefault(&config);
  }
  setTheme(theme_);
}

Interface::~Interface() { ImGui::DestroyContext(); }

void Interface::setTheme(Theme theme) {
  theme_ = theme;
  ImGuiStyle style;
  if (theme == Theme::Dark)
    ImGui::StyleColorsDark(&style);
  else
    ImGui::StyleColorsLight(&style);
  style.WindowRounding = 4;
  style.FrameRounding = 3;
  style.GrabRounding = 3;
  style.ScrollbarSize = 11;
  style.WindowBorderSize = 0;
  style.FrameBorderSize = theme == Theme::Light ? 1.0f : 0.0f;
  style.ItemSpacing = ImVec2(6, 5);
  style.Colors[ImGuiCol_WindowBg].w = style.Colors[ImGuiCol_PopupBg].w = 1;
  style.ScaleAllSizes(scale_);
  ImGui::GetStyle() = style;
}

std::vector<InputEvent> Interface::next() {
  using Kind = InputEvent::Kind;
  std::vector<InputEvent> taken;
  for (; !waiting_.empty(); waiting_.pop_front()) {
    const InputEvent& event = waiting_.front();
    const bool later = std::ranges::any_of(taken, [&](const InputEvent& before) {
      if (event.kind == Kind::Move) return before.kind == Kind::Button;
      if (event.kind == Kind::Key && before.kind == Kind::Text) return true;
      return (event.kind == Kind::Button || event.kind == Kind::Key) && before.kind == event.kind && before.code == event.code;
    });
    if (later) break;
    taken.push_back(event);
  }
  return taken;
}

void Interface::send(const InputEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  const auto modify = [&](bool control, bool shift) {
#if IMGUI_VERSION_NUM >= 18700
    io.AddKeyEvent(ImGuiMod_Ctrl, control);
    io.AddKeyEvent(ImGuiMod_Shift, shift);
#else
    io.KeyCtrl = control;
    io.KeyShift = shift;
#endif
  };
  // On X11 the event of a modifier key has the modifiers from before it.
  const auto held = [&](int modifier, int left, int right) {
    const bool own = event.kind == InputEvent::Kind::Key && (event.code == left || event.code == right);
    return own ? event.down : (event.modifiers & modifier) != 0;
  };
  switch (event.kind) {
    case InputEvent::Kind::Move:
#if IMGUI_VERSION_NUM >= 18700
      io.AddMousePosEvent(static_cast<float>(event.x), static_cast<float>(event.y));
#else
      io.MousePos = ImVec2(static_cast<float>(event.x), static_cast<float>(event.y));
#endif
      break;
    case InputEvent::Kind::Button:
      modify(event.modifiers & GLFW_MOD_CONTROL, event.modifiers & GLFW_MOD_SHIFT);
      if (event.code < 0 || event.code > 2) break;
#if IMGUI_VERSION_NUM >= 18700
      io.AddMouseButtonEvent(event.code, event.down);
#else
      io.MouseDown[event.code] = event.down;
#endif
      break;
    case InputEvent::Kind::Wheel:
#if IMGUI_VERSION_NUM >= 18700
      io.AddMouseWheelEvent(static_cast<float>(event.x), static_cast<float>(event.y));
#else
      io.MouseWheelH += static_cast<float>(event.x);
      io.MouseWheel += static_cast<float>(event.y);
#endif
      break;
    case InputEvent::Kind::Key: {
      modify(held(GLFW_MOD_CONTROL, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
             held(GLFW_MOD_SHIFT, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT));
      const auto row = std::ranges::find(kKeys, event.code, &KeyRow::glfw);
      if (row == std::end(kKeys)) break;
#if IMGUI_VERSION_NUM >= 18700
      io.AddKeyEvent(static_cast<ImGuiKey>(row->imgui), event.down);
#else
      io.KeysDown[row->glfw] = event.down;
#endif
      break;
    }
    case InputEvent::Kind::Text:
      io.AddInputCharactersUTF8(event.text.c_str());
      break;
    case InputEvent::Kind::Focus:
#if IMGUI_VERSION_NUM >= 18700
      io.AddFocusEvent(event.down);
#else
      if (!event.down) std::ranges::fill(io.MouseDown, false);
#endif
      break;
    case InputEvent::Kind::Drop:
      break;
  }
}

std::vector<InputEvent> Interface::begin(double seconds, uint32_t width, uint32_t height) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
  io.DeltaTime = static_cast<float>(std::clamp(seconds, 1e-4, 1.0));
  io.MouseDoubleClickTime = std::max(0.3f, 5 * io.DeltaTime);  // press, release, press, release: one frame each
  std::vector<InputEvent> taken = next();
  for (const InputEvent& event : taken) send(event);
  ImGui::NewFrame();
  return taken;
}

const ImDrawData& Interface::end() {
  ImGui::Render();
  return *ImGui::GetDrawData();
}

}  // namespace rill::view
