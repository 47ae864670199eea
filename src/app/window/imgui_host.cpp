#include "window/imgui_host.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <cmath>

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
  if (first) return;  // the backend makes the texture with its first frame
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
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
  ImGui::NewFrame();
}

void ImGuiHost::end_frame() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace osteon
