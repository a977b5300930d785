#pragma once
// A GLFW window: surface, size, input events.
#include <memory>
#include <string>
#include <vector>

#include "rill/device.hpp"
#include "view/input.hpp"

struct GLFWwindow;

namespace rill::view {

class Window {
 public:
  struct Size {
    uint32_t width = 0, height = 0;  ///< pixels; 0 while it is minimized
  };

  /// Only one at a time. BadInput where there is no display.
  static Expected<std::unique_ptr<Window>> open(const std::string& title, uint32_t width, uint32_t height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  static std::vector<const char*> instanceExtensions();
  /// For a list of devices without a window: instanceExtensions() and presents() may be called until closeDisplay(). False where there is
  /// no display.
  static bool openDisplay();
  static void closeDisplay();
  static bool presents(VkInstance instance, VkPhysicalDevice device, uint32_t queueFamily);
  Expected<VkSurfaceKHR> surface(VkInstance instance);

  /// Events since the last call; waits up to `seconds` for one.
  std::vector<InputEvent> events(double seconds);
  bool closing() const;
  void close();
  Size framebuffer() const;
  float contentScale() const;  ///< scale of text and buttons; 1 at standard resolution
  void resize(uint32_t width, uint32_t height);
  void minimize(bool minimized);
  void setTitle(const std::string& title);
  std::string clipboard() const;
  void setClipboard(const char* text);

 private:
  Window() = default;
  void listen();
  void push(InputEvent event) { events_.push_back(std::move(event)); }
  static Window& of(GLFWwindow* window);

  GLFWwindow* window_ = nullptr;
  std::vector<InputEvent> events_;
  bool minimized_ = false;  ///< set by minimize()
  std::string title_;
};

}  // namespace rill::view
