#include "window/controllers/views/observer_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <span>
#include <vector>

namespace osteon {
namespace {

constexpr double kEvery_s = 1.0 / 30;
constexpr int kWidth = 960, kHeight = 600;

struct Area {
  int x = 0, y = 0, w = 0, h = 0;
  bool holds(int px, int py) const { return px >= x && py >= y && px < x + w && py < y + h; }
};

Area area_of(GLFWwindow* window) {
  Area area;
  glfwGetWindowPos(window, &area.x, &area.y);
  glfwGetWindowSize(window, &area.w, &area.h);
  return area;
}

std::span<GLFWmonitor* const> monitors() {
  int count = 0;
  GLFWmonitor** const first = glfwGetMonitors(&count);
  return {first, static_cast<std::size_t>(std::max(count, 0))};
}

// Without what bars of the desktop cover.
std::vector<Area> work_areas() {
  std::vector<Area> areas;
  for (GLFWmonitor* monitor : monitors()) {
    Area& area = areas.emplace_back();
    glfwGetMonitorWorkarea(monitor, &area.x, &area.y, &area.w, &area.h);
  }
  return areas;
}

// A screen that was unplugged a moment ago is listed until the next events are read. GLFW 3.3 ends
// the program when it is asked for that one's work area; place and mode may be asked for.
std::vector<Area> screens() {
  std::vector<Area> areas;
  for (GLFWmonitor* monitor : monitors()) {
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    if (!mode) continue;
    Area& area = areas.emplace_back();
    glfwGetMonitorPos(monitor, &area.x, &area.y);
    area.w = mode->width;
    area.h = mode->height;
  }
  return areas;
}

bool shows_middle(const Area& screen, const Area& window) {
  return screen.holds(window.x + window.w / 2, window.y + window.h / 2);
}

void put(GLFWwindow* window, const Area& area) {
  glfwSetWindowPos(window, area.x, area.y);
  glfwSetWindowSize(window, area.w, area.h);
}

}  // namespace

Result<std::unique_ptr<ObserverWindow>> ObserverWindow::open(const GlWindow& first,
                                                             bool& own_screen) {
  WindowOptions options;
  options.width = kWidth;
  options.height = kHeight;
  options.title = "Osteon, observer's window";
  options.wait_for_display = false;  // the first window waits
  options.beside = first.handle();
  auto window = GlWindow::create(options);
  if (!window) return tl::unexpected(window.error());
  const Area of_first = area_of(first.handle());
  own_screen = false;
  for (const Area& screen : work_areas()) {
    if (own_screen || screen.w <= 0 || shows_middle(screen, of_first)) continue;
    put(window->handle(), screen);
    own_screen = true;
  }
  return std::unique_ptr<ObserverWindow>(new ObserverWindow(first, std::move(*window)));
}

ObserverWindow::ObserverWindow(const GlWindow& first, GlWindow window)
    : first_(first), window_(std::move(window)) {
  glGenFramebuffers(1, &framebuffer_);
  glfwMakeContextCurrent(first_.handle());
}

ObserverWindow::~ObserverWindow() {
  glfwMakeContextCurrent(window_.handle());
  glDeleteFramebuffers(1, &framebuffer_);
  glfwMakeContextCurrent(first_.handle());
}

bool ObserverWindow::due(double now_s) const {
  return now_s - shown_s_ >= kEvery_s && glfwGetWindowAttrib(window_.handle(), GLFW_ICONIFIED) == 0;
}

void ObserverWindow::show(const ShownImage& picture, double now_s) {
  shown_s_ = now_s;
  glFinish();  // the picture is drawn before another context reads it
  glfwMakeContextCurrent(window_.handle());
  int width = 0, height = 0;
  window_.framebuffer_size(width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                         picture.texture(), 0);
  glBlitFramebuffer(0, 0, picture.width(), picture.height(), 0, 0, width, height,
                    GL_COLOR_BUFFER_BIT, GL_LINEAR);
  window_.swap();
  glfwMakeContextCurrent(first_.handle());
}

bool ObserverWindow::came_back() {
  const std::vector<Area> all = screens();
  const Area now = area_of(window_.handle());
  const bool seen = std::any_of(all.begin(), all.end(),
                                [&](const Area& screen) { return shows_middle(screen, now); });
  if (seen || all.empty()) return false;
  put(window_.handle(), {all[0].x + 40, all[0].y + 40, kWidth, kHeight});
  return true;
}

}  // namespace osteon
