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
// Those that edit text and move through it; all others are the viewer's own.
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

// A typeface that is read more easily than the one built in, where the system has it (Debian: fonts-dejavu-core).
constexpr const char* kFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                  "/usr/share/fonts/truetype/liberation2/LiberationSans-Regular.ttf",
                                  "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};
constexpr float kFontPixels = 15;

}  // namespace

Interface::Interface(float scale, std::function<std::string()> paste, std::function<void(const char*)> copy)
    : scale_(scale), paste_(std::move(paste)), copy_(std::move(copy)) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = io.LogFilename = nullptr;  // nothing is written beside the program
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
    io.Fonts->AddFontFromFileTTF(*found, kFontPixels * scale);
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

void Interface::feed(const InputEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  switch (event.kind) {
    case InputEvent::Kind::Move:
#if IMGUI_VERSION_NUM >= 18700
      io.AddMousePosEvent(static_cast<float>(event.x), static_cast<float>(event.y));
#else
      io.MousePos = ImVec2(static_cast<float>(event.x), static_cast<float>(event.y));
#endif
      break;
    case InputEvent::Kind::Button:
      if (event.code < 0 || event.code > 2) break;
#if IMGUI_VERSION_NUM >= 18700
      io.AddMouseButtonEvent(event.code, event.down);
#else
      down_[event.code] = event.down;
      pressed_[event.code] |= event.down;
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
      const bool control = event.modifiers & GLFW_MOD_CONTROL, shift = event.modifiers & GLFW_MOD_SHIFT;
      const auto row = std::ranges::find(kKeys, event.code, &KeyRow::glfw);
#if IMGUI_VERSION_NUM >= 18700
      io.AddKeyEvent(ImGuiMod_Ctrl, control);
      io.AddKeyEvent(ImGuiMod_Shift, shift);
      if (row != std::end(kKeys)) io.AddKeyEvent(static_cast<ImGuiKey>(row->imgui), event.down);
#else
      io.KeyCtrl = control;
      io.KeyShift = shift;
      if (row != std::end(kKeys)) io.KeysDown[row->glfw] = event.down;
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
      if (!event.down) std::ranges::fill(down_, false);
#endif
      break;
    case InputEvent::Kind::Drop:
      break;
  }
}

void Interface::begin(double seconds, uint32_t width, uint32_t height) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
  io.DeltaTime = static_cast<float>(std::clamp(seconds, 1e-4, 1.0));
#if IMGUI_VERSION_NUM < 18700
  for (int b = 0; b < 3; ++b) {
    io.MouseDown[b] = down_[b] || pressed_[b];
    pressed_[b] = false;
  }
#endif
  ImGui::NewFrame();
}

const ImDrawData& Interface::end() {
  ImGui::Render();
  return *ImGui::GetDrawData();
}

}  // namespace rill::view
