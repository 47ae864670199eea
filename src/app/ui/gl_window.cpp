#include "ui/gl_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace osteon {

struct GlWindow::State {
  std::vector<std::string> dropped;
  std::vector<int> pressed;
  int x = 0, y = 0, width = 0, height = 0;  // before full screen
  int framebuffer_w = 0, framebuffer_h = 0, window_w = 0, window_h = 0;
};

namespace {

std::string last_glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

void set_hints() {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  // The scene brings its own depth; a processor would clear this one for each picture.
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
}

// Makes a size fit what the first screen leaves for windows. A size is for 96 dots an inch.
void fit_screen(int& width, int& height) {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (!monitor) return;
  int x = 0, y = 0, room_w = 0, room_h = 0;
  glfwGetMonitorWorkarea(monitor, &x, &y, &room_w, &room_h);
  float scale_x = 1, scale_y = 1;
  glfwGetMonitorContentScale(monitor, &scale_x, &scale_y);
  if (room_w > 0 && scale_x > 0) width = std::min(width, static_cast<int>(room_w / scale_x));
  if (room_h > 0 && scale_y > 0) height = std::min(height, static_cast<int>(room_h / scale_y));
}

}  // namespace

Result<GlWindow> GlWindow::create(const WindowOptions& options) {
  if (glfwInit() != GLFW_TRUE)
    return fail("no window can be opened (" + last_glfw_error() + ")", "display",
                "Run it on a desktop, or use `osteon demo`, which needs no display");
  set_hints();
  GlWindow made;
  int width = options.width, height = options.height;
  if (options.within_screen) fit_screen(width, height);
  made.window_ = glfwCreateWindow(width, height, options.title.c_str(), nullptr, options.beside);
  made.beside_ = options.beside != nullptr;
  if (!made.window_) {
    const std::string why = last_glfw_error();
    if (!options.beside) glfwTerminate();
    return fail("the window could not be opened (" + why + ")", "display",
                "Osteon needs OpenGL 3.3: update the graphics driver");
  }
  made.state_ = std::make_unique<State>();
  glfwSetWindowUserPointer(made.window_, made.state_.get());
  glfwSetDropCallback(made.window_, [](GLFWwindow* window, int count, const char** paths) {
    auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
    state.dropped.insert(state.dropped.end(), paths, paths + count);
  });
  glfwSetKeyCallback(made.window_, [](GLFWwindow* window, int key, int, int action, int mods) {
    auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
    if (action != GLFW_PRESS || key < 0) return;
    // Ctrl may be up again before the picture in which the key is seen.
    if (mods & GLFW_MOD_CONTROL) state.pressed.push_back(GLFW_KEY_LEFT_CONTROL);
    if (mods & GLFW_MOD_SHIFT) state.pressed.push_back(GLFW_KEY_LEFT_SHIFT);
    state.pressed.push_back(key);
  });
  glfwSetWindowSizeLimits(made.window_, 640, 400, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwMakeContextCurrent(made.window_);
  glfwSwapInterval(options.wait_for_display ? 1 : 0);
  made.follow_size();
  return made;
}

// Asking a display server waits for it, on a busy computer for milliseconds; sizes are asked for
// many times a picture.
void GlWindow::follow_size() const {
  glfwGetFramebufferSize(window_, &state_->framebuffer_w, &state_->framebuffer_h);
  glfwGetWindowSize(window_, &state_->window_w, &state_->window_h);
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int width, int height) {
    auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
    state.framebuffer_w = width;
    state.framebuffer_h = height;
  });
  glfwSetWindowSizeCallback(window_, [](GLFWwindow* window, int width, int height) {
    auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
    state.window_w = width;
    state.window_h = height;
  });
}

GlWindow::GlWindow(GlWindow&& other) noexcept
    : window_(std::exchange(other.window_, nullptr)),
      beside_(other.beside_),
      state_(std::move(other.state_)) {}

GlWindow& GlWindow::operator=(GlWindow&& other) noexcept {
  std::swap(window_, other.window_);
  std::swap(beside_, other.beside_);
  std::swap(state_, other.state_);
  return *this;
}

GlWindow::~GlWindow() {
  if (!window_) return;
  glfwDestroyWindow(window_);
  if (!beside_) glfwTerminate();
}

bool GlWindow::should_close() const { return glfwWindowShouldClose(window_) != 0; }

void GlWindow::framebuffer_size(int& width, int& height) const {
  width = state_->framebuffer_w;
  height = state_->framebuffer_h;
}

float GlWindow::content_scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return x > 0 ? x : 1;
}

double GlWindow::pixel_ratio() const {
  const State& s = *state_;
  return s.window_w > 0 ? static_cast<double>(s.framebuffer_w) / s.window_w : 1.0;
}

// GLFW for Wayland lacks the function.
std::string GlWindow::name_for_desktop() const {
  using NumberOf = unsigned long (*)(GLFWwindow*);
  const auto number_of = reinterpret_cast<NumberOf>(::dlsym(RTLD_DEFAULT, "glfwGetX11Window"));
  const unsigned long number = number_of ? number_of(window_) : 0;
  char name[32];
  std::snprintf(name, sizeof name, "x11:%lx", number);
  return number == 0 ? std::string() : name;
}

void GlWindow::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

void GlWindow::toggle_fullscreen() {
  State& s = *state_;
  if (glfwGetWindowMonitor(window_)) {
    glfwSetWindowMonitor(window_, nullptr, s.x, s.y, s.width, s.height, GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  if (!mode) return;
  glfwGetWindowPos(window_, &s.x, &s.y);
  glfwGetWindowSize(window_, &s.width, &s.height);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void GlWindow::poll() const { glfwPollEvents(); }

void GlWindow::swap() const { glfwSwapBuffers(window_); }

std::vector<int> GlWindow::take_pressed_keys() { return std::exchange(state_->pressed, {}); }

void GlWindow::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }

void GlWindow::stay_open() { glfwSetWindowShouldClose(window_, GLFW_FALSE); }

std::vector<std::string> GlWindow::take_dropped_files() {
  return std::exchange(state_->dropped, {});
}

}  // namespace osteon
