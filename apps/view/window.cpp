#include "view/window.hpp"

#include <vulkan/vulkan.h>  // before GLFW, which then declares its Vulkan functions

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

namespace rill::view {
namespace {

std::string lastError() {
  const char* text = nullptr;
  return glfwGetError(&text) != GLFW_NO_ERROR && text ? text : "GLFW gives no reason";
}

std::string utf8(unsigned code) {
  std::string text;
  const auto add = [&](unsigned byte) { text.push_back(static_cast<char>(byte)); };
  if (code < 0x80) return add(code), text;
  if (code < 0x800) return add(0xC0 | code >> 6), add(0x80 | (code & 63)), text;
  if (code < 0x10000) return add(0xE0 | code >> 12), add(0x80 | (code >> 6 & 63)), add(0x80 | (code & 63)), text;
  return add(0xF0 | code >> 18), add(0x80 | (code >> 12 & 63)), add(0x80 | (code >> 6 & 63)), add(0x80 | (code & 63)), text;
}

}  // namespace

Expected<std::unique_ptr<Window>> Window::open(const std::string& title, uint32_t width, uint32_t height) {
  if (glfwInit() != GLFW_TRUE)
    return Error{ErrorKind::BadInput, "no display to open a window on (" + lastError() +
                                          "); expected DISPLAY or WAYLAND_DISPLAY to name one. Without a display use rill-capture, "
                                          "which writes images to files"};
  std::unique_ptr<Window> made(new Window);
  if (glfwVulkanSupported() != GLFW_TRUE)
    return Error{ErrorKind::NoDevice,
                 "found no Vulkan loader and driver that can draw to a window (Debian: libvulkan1 and mesa-vulkan-drivers)"};
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  made->window_ = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), title.c_str(), nullptr, nullptr);
  if (!made->window_) return Error{ErrorKind::BadInput, "cannot open a window: " + lastError()};
  made->title_ = title;
  made->listen();
  return made;
}

Window::~Window() {
  if (window_) glfwDestroyWindow(window_);
  glfwTerminate();
}

Window& Window::of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

void Window::listen() {
  glfwSetWindowUserPointer(window_, this);
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
    int width = 0, height = 0;
    glfwGetWindowSize(w, &width, &height);
    const Size pixels = of(w).framebuffer();  // positions are in window units
    if (width <= 0 || height <= 0) return;
    of(w).push({.kind = InputEvent::Kind::Move, .x = x * pixels.width / width, .y = y * pixels.height / height});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int modifiers) {
    of(w).push({.kind = InputEvent::Kind::Button, .code = button, .down = action == GLFW_PRESS, .modifiers = modifiers});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) { of(w).push({.kind = InputEvent::Kind::Wheel, .x = x, .y = y}); });
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int modifiers) {
    if (action != GLFW_REPEAT)
      of(w).push({.kind = InputEvent::Kind::Key, .code = key, .down = action == GLFW_PRESS, .modifiers = modifiers});
  });
  glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned code) { of(w).push({.kind = InputEvent::Kind::Text, .text = utf8(code)}); });
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
    if (count > 0) of(w).push({.kind = InputEvent::Kind::Drop, .text = paths[0]});
  });
  glfwSetWindowFocusCallback(
      window_, [](GLFWwindow* w, int focused) { of(w).push({.kind = InputEvent::Kind::Focus, .down = focused == GLFW_TRUE}); });
}

std::vector<const char*> Window::instanceExtensions() {
  uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  return {names, names + count};
}

bool Window::openDisplay() { return glfwInit() == GLFW_TRUE && glfwVulkanSupported() == GLFW_TRUE; }

void Window::closeDisplay() { glfwTerminate(); }

bool Window::presents(VkInstance instance, VkPhysicalDevice device, uint32_t queueFamily) {
  return glfwGetPhysicalDevicePresentationSupport(instance, device, queueFamily) == GLFW_TRUE;
}

Expected<VkSurfaceKHR> Window::surface(VkInstance instance) {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  if (glfwCreateWindowSurface(instance, window_, nullptr, &surface) != VK_SUCCESS)
    return Error{ErrorKind::NoDevice, "cannot create a Vulkan surface for the window: " + lastError()};
  return surface;
}

std::vector<InputEvent> Window::events(double seconds) {
  if (seconds > 0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
  return std::exchange(events_, {});
}

bool Window::closing() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }
void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }

Window::Size Window::framebuffer() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  if (minimized_ || glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE) return {};
  return {static_cast<uint32_t>(std::max(width, 0)), static_cast<uint32_t>(std::max(height, 0))};
}

float Window::contentScale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::clamp(std::max(x, y), 0.5f, 4.0f);
}

void Window::resize(uint32_t width, uint32_t height) { glfwSetWindowSize(window_, static_cast<int>(width), static_cast<int>(height)); }

void Window::minimize(bool minimized) {
  minimized_ = minimized;  // without a window manager the window stays visible
  if (minimized)
    glfwIconifyWindow(window_);
  else
    glfwRestoreWindow(window_);
}

void Window::setTitle(const std::string& title) {
  if (title == title_) return;
  title_ = title;
  glfwSetWindowTitle(window_, title.c_str());
}

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(window_);
  return text ? text : "";
}
void Window::setClipboard(const char* text) { glfwSetClipboardString(window_, text); }

}  // namespace rill::view
