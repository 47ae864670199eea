#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include <initializer_list>
#include <string>
#include <variant>

#include "window/panels/panels.h"

namespace osteon::test {

/// An ImGui context without a window: draws frames of a model and plays the user.
class UiFrame {
 public:
  /// A label, or the number of a row.
  using Part = std::variant<int, const char*>;

  explicit UiFrame(float width = 1280, float height = 720) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {width, height};
    fonts_ = load_fonts(1);
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
    apply_theme(1);
    model.width = width;
    model.height = height;
  }
  ~UiFrame() { ImGui::DestroyContext(); }
  UiFrame(const UiFrame&) = delete;
  UiFrame& operator=(const UiFrame&) = delete;

  UiModel model;

  UiRequests draw() {
    ImGui::GetIO().DeltaTime = 1.0f / 60;
    ImGui::NewFrame();
    const UiRequests requests = draw_ui(model, fonts_);
    ImGui::Render();
    return requests;
  }

  /// Requests of the frame in which the left button, pressed and released at `at`, acted.
  UiRequests click(ImVec2 at) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = at;
    draw();
    draw();
    io.MouseDown[0] = true;
    const UiRequests on_press = draw();
    io.MouseDown[0] = false;
    const UiRequests on_release = draw();
    return acted(on_press) ? on_press : on_release;
  }

  /// The same of what concerns views.
  ViewsRequests click_for_views(ImVec2 at) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = at;
    draw();
    draw();
    io.MouseDown[0] = true;
    draw();
    io.MouseDown[0] = false;
    return draw().views;
  }

  UiRequests press_key(int glfw_key, bool shift = false, bool ctrl = false) {
    ImGuiIO& io = ImGui::GetIO();
    draw();
    io.KeyShift = shift;
    io.KeyCtrl = ctrl;
    io.KeysDown[glfw_key] = true;
    const UiRequests requests = draw();
    io.KeysDown[glfw_key] = false;
    io.KeyShift = io.KeyCtrl = false;
    draw();
    return requests;
  }

  /// Where the widget of that name in that window is, by moving the pointer over the window until
  /// the widget answers; {-1, -1} when it is not there.
  ImVec2 find(const char* window, std::initializer_list<Part> path) {
    draw();
    draw();
    const ImGuiWindow* found = ImGui::FindWindowByName(window);
    if (!found) return {-1, -1};
    ImGuiID id = found->ID;
    for (const Part& part : path)
      id = std::holds_alternative<int>(part) ? ImHashData(&std::get<int>(part), sizeof(int), id)
                                             : ImHashStr(std::get<const char*>(part), 0, id);
    const ImRect area = found->Rect();
    for (float y = area.Min.y + 2; y < area.Max.y; y += 5)
      for (float x = area.Min.x + 2; x < area.Max.x; x += 10) {
        ImGui::GetIO().MousePos = {x, y};
        draw();
        if (ImGui::GetCurrentContext()->HoveredId == id) return {x, y};
      }
    return {-1, -1};
  }

  UiRequests click(const char* window, std::initializer_list<Part> path) {
    const ImVec2 at = find(window, path);
    return at.x < 0 ? UiRequests{} : click(at);
  }

  /// Screen rectangle of a window of the last frame; empty when it was not drawn.
  UiRect rect(const char* window) const {
    const ImGuiWindow* found = ImGui::FindWindowByName(window);
    if (!found || !found->WasActive) return {};
    return {found->Pos.x, found->Pos.y, found->Size.x, found->Size.y};
  }
  /// Name of the popup that is open; empty: none.
  std::string popup() const {
    const auto& open = ImGui::GetCurrentContext()->OpenPopupStack;
    return open.empty() || !open.back().Window ? std::string() : open.back().Window->Name;
  }
  bool shown(const char* window) const { return rect(window).w > 0; }
  const UiFonts& fonts() const { return fonts_; }

 private:
  // A press acts at once for some widgets (sliders, the timeline), a release for the rest.
  static bool acted(const UiRequests& r) {
    return r.view || r.preset || r.felt || !r.commands.empty() || r.device || r.seek_s || r.speed ||
           r.calibrate || r.mapping || r.learn_pedal || r.forget_pedal || r.toggle_checkup ||
           r.begin_checkup || r.begin_push_test || r.cancel_checkup || r.install_udev || r.copy ||
           r.patient.toggle || r.patient.order || r.patient.make || r.patient.stop ||
           r.dismiss_hint;
  }
  UiFonts fonts_;
};

/// A ready model with three bones.
inline UiModel small_model() {
  UiModel model;
  model.case_title = "Wrist, right";
  model.bone_labels = {"Scaphoid", "Lunate", "Capitate"};
  model.bone_felt = {Felt::kPieces, Felt::kPieces, Felt::kHull};
  model.view.bones.resize(3);
  model.hand.devices = {"Mouse and keyboard", "Demonstration (virtual hand)"};
  model.hand.status.cause = ForceOff::kNone;
  return model;
}

}  // namespace osteon::test
