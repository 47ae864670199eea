#include "ui/imgui_host.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>

#include <cmath>
#include <cstdint>

namespace osteon {

ImGuiHost::ImGuiHost(GLFWwindow* window, float scale) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // the settings file is ours
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  set_scale(scale);
}

ImGuiHost::~ImGuiHost() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void ImGuiHost::set_scale(float scale) {
  if (std::abs(scale - scale_) < 1e-3f) return;
  const bool first = scale_ == 0;
  scale_ = scale;
  fonts_ = load_fonts(scale);
  apply_theme(scale);
  atlas_ready_ = false;
  if (first) return;  // the backend makes the texture with its first frame
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

// Where a pixel of the interface is one of the display, every glyph lies on whole texels: reading
// the nearest shows the same, and a processor draws it in less time.
void ImGuiHost::choose_atlas_filter() {
  const ImGuiIO& io = ImGui::GetIO();
  const bool exact = io.DisplayFramebufferScale.x == 1 && io.DisplayFramebufferScale.y == 1;
  const GLint filter = exact ? GL_NEAREST : GL_LINEAR;
  glBindTexture(GL_TEXTURE_2D,
                static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(io.Fonts->TexID)));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glBindTexture(GL_TEXTURE_2D, 0);
  atlas_ready_ = true;
}

void ImGuiHost::take_pointer(bool taken) {
  ImGuiIO& io = ImGui::GetIO();
  if (taken)
    io.ConfigFlags |= ImGuiConfigFlags_NoMouse;
  else
    io.ConfigFlags &= ~ImGuiConfigFlags_NoMouse;
}

void ImGuiHost::begin_frame(const std::vector<int>& pressed_keys) {
  ImGuiIO& io = ImGui::GetIO();
  for (const int key : short_keys_) io.KeysDown[key] = false;
  short_keys_.clear();
  for (const int key : pressed_keys) {
    if (key >= IM_ARRAYSIZE(io.KeysDown) || io.KeysDown[key]) continue;
    io.KeysDown[key] = true;
    short_keys_.push_back(key);
  }
  io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
  io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  if (!atlas_ready_) choose_atlas_filter();
  ImGui::NewFrame();
}

void ImGuiHost::end_frame() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace osteon
