#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstring>
#include <string>
#include <utility>

#include "osteon/render/renderer.h"

namespace osteon {
namespace {

constexpr const char* kTodo =
    "Install Mesa's libegl1 and libgl1-mesa-dri, or a graphics driver with EGL";

bool has_extension(const char* list, const char* name) {
  return list != nullptr && std::strstr(list, name) != nullptr;
}

/// A display that needs no screen, else the system's default one.
EGLDisplay open_display() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto get_platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (get_platform_display != nullptr &&
      has_extension(extensions, "EGL_MESA_platform_surfaceless")) {
    const EGLDisplay display = get_platform_display(
        EGL_PLATFORM_SURFACELESS_MESA, reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr);
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
  }
  const EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
  return EGL_NO_DISPLAY;
}

Error egl_error(const std::string& what) {
  char code[16];
  std::snprintf(code, sizeof code, "0x%x", static_cast<unsigned>(eglGetError()));
  return {what + " (EGL error " + code + ")", "OpenGL without a window", kTodo};
}

}  // namespace

struct OffscreenContext::Impl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLSurface surface = EGL_NO_SURFACE;
  EGLContext context = EGL_NO_CONTEXT;

  ~Impl() {
    // The display itself is shared by all contexts of the process and stays open.
    if (display == EGL_NO_DISPLAY) return;
    if (context != EGL_NO_CONTEXT && eglGetCurrentContext() == context)
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
  }
};

Result<OffscreenContext> OffscreenContext::create() {
  auto impl = std::make_unique<Impl>();
  impl->display = open_display();
  if (impl->display == EGL_NO_DISPLAY) return tl::unexpected(egl_error("no EGL display opens"));
  if (!eglBindAPI(EGL_OPENGL_API)) return tl::unexpected(egl_error("EGL has no desktop OpenGL"));
  const EGLint config_wanted[] = {EGL_SURFACE_TYPE,    EGL_PBUFFER_BIT, EGL_RED_SIZE, 8,
                                  EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,  EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(impl->display, config_wanted, &config, 1, &count) || count == 0)
    return tl::unexpected(egl_error("EGL has no configuration for off-screen OpenGL"));
  const EGLint context_wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                   3,
                                   EGL_CONTEXT_MINOR_VERSION,
                                   3,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                   EGL_NONE};
  impl->context = eglCreateContext(impl->display, config, EGL_NO_CONTEXT, context_wanted);
  if (impl->context == EGL_NO_CONTEXT)
    return tl::unexpected(egl_error("the driver gives no OpenGL 3.3"));
  const EGLint one_pixel[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
  impl->surface = eglCreatePbufferSurface(impl->display, config, one_pixel);
  if (!eglMakeCurrent(impl->display, impl->surface, impl->surface, impl->context))
    return tl::unexpected(egl_error("the OpenGL context cannot be used"));
  return OffscreenContext(std::move(impl));
}

OffscreenContext::OffscreenContext(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
OffscreenContext::~OffscreenContext() = default;
OffscreenContext::OffscreenContext(OffscreenContext&&) noexcept = default;
OffscreenContext& OffscreenContext::operator=(OffscreenContext&&) noexcept = default;

}  // namespace osteon
