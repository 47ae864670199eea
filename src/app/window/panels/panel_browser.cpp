#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

// The whole row can be clicked. Leaves the cursor where it was.
void draw_row(const PanelContext& c, const OpenEntry& entry, float height) {
  const ImVec2 at = ImGui::GetCursorPos();
  const bool chosen = ImGui::Selectable("###entry", false, 0, {0, height});
  if (chosen && entry.kind == OpenKind::kFolder) c.requests.browser.look_into = entry.path;
  if (chosen && entry.kind != OpenKind::kFolder) c.requests.browser.open = entry;
  ui::tooltip(entry.path.c_str());
  ImGui::SetCursorPos(at);
}

// A case with its picture; the place stays empty until there is one.
void draw_case(const PanelContext& c, const OpenEntry& entry, int i) {
  ImGui::PushID(i);
  const ImVec2 at = ImGui::GetCursorPos();
  const float w = ImGui::GetContentRegionAvail().x;
  const float picture_w = c.px(84), picture_h = c.px(56);
  draw_row(c, entry, picture_h);
  if (entry.picture != 0)
    ImGui::Image(reinterpret_cast<ImTextureID>(entry.picture), {picture_w, picture_h});
  const float text_x = at.x + picture_w + c.px(12), text_w = w - picture_w - c.px(12);
  ImGui::SetCursorPos({text_x, at.y + c.px(10)});
  ImGui::TextUnformatted(ui::shortened(entry.label, text_w).c_str());
  ImGui::SetCursorPos({text_x, at.y + c.px(29)});
  ui::text(color::kTextQuiet, ui::shortened(entry.about, text_w).c_str());
  ImGui::SetCursorPos({at.x, at.y + picture_h + c.px(4)});
  ImGui::PopID();
}

void draw_entry(const PanelContext& c, const OpenEntry& entry, int i) {
  ImGui::PushID(i);
  const ImVec2 at = ImGui::GetCursorPos();
  const float w = ImGui::GetContentRegionAvail().x;
  draw_row(c, entry, c.px(20));
  ImGui::SetCursorPos({at.x, at.y + c.px(2)});
  const std::string name = entry.kind == OpenKind::kFolder ? entry.label + "/" : entry.label;
  ImGui::TextUnformatted(ui::shortened(name, 0.58f * w).c_str());
  ImGui::SetCursorPos({at.x + 0.6f * w, at.y + c.px(2)});
  ui::text(color::kTextQuiet, ui::shortened(entry.about, 0.4f * w).c_str());
  ImGui::SetCursorPos({at.x, at.y + c.px(22)});
  ImGui::PopID();
}

void draw_known(const PanelContext& c) {
  ui::text(color::kTextQuiet, "Cases and recordings");
  ImGui::BeginChild("known", {0, 0}, true);
  int i = 0;
  for (const OpenEntry& entry : c.model.browser.known)
    entry.kind == OpenKind::kCase ? draw_case(c, entry, i++) : draw_entry(c, entry, i++);
  ImGui::EndChild();
}

// The desktop's chooser, where there is one: it knows the user's own places.
void draw_desktop_chooser(const PanelContext& c) {
  const BrowserModel& browser = c.model.browser;
  if (!browser.desktop_files) return;
  const float w = c.px(104);
  const float all = w + (browser.desktop_folders ? w + c.px(4) : 0);
  ImGui::SameLine(ImGui::GetContentRegionAvail().x - all);
  ImGui::BeginDisabled(browser.desktop_asks);
  if (ImGui::Button("Choose file ...", {w, 0})) c.requests.browser.desktop_file = true;
  ui::tooltip("In the desktop's own window. Several meshes make one case");
  if (browser.desktop_folders) {
    ImGui::SameLine(0, c.px(4));
    if (ImGui::Button("Folder ...", {w, 0})) c.requests.browser.desktop_folder = true;
    ui::tooltip("A folder, in the desktop's own window");
  }
  ImGui::EndDisabled();
}

void draw_folder(const PanelContext& c) {
  const BrowserModel& browser = c.model.browser;
  ui::text(color::kTextQuiet, "On this computer: case folders, recordings, meshes, scans");
  char text[1024];
  std::snprintf(text, sizeof text, "%s", browser.folder.c_str());
  const float up = c.px(48);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - up - c.px(4));
  if (ImGui::InputText("##path", text, sizeof text, ImGuiInputTextFlags_EnterReturnsTrue)) {
    const OpenEntry typed{OpenKind::kNothing, text, {}, text};
    c.requests.browser.open = typed;
  }
  ui::tooltip("A folder or file; Enter opens it");
  ImGui::SameLine(0, c.px(4));
  if (ImGui::Button("Up", {up, 0}))
    c.requests.browser.look_into = std::filesystem::path(browser.folder).parent_path().string();
  ImGui::BeginChild("files", {0, -ImGui::GetFrameHeightWithSpacing()}, true);
  if (!browser.problem.empty())
    ui::text(color::kAmber, ("This folder cannot be read: " + browser.problem).c_str());
  else if (browser.files.empty())
    ui::text(color::kTextQuiet, "Nothing here can be opened");
  int i = 0;
  for (const OpenEntry& entry : browser.files) draw_entry(c, entry, i++);
  ImGui::EndChild();
  bool mm = browser.in_millimetres;
  if (ImGui::Checkbox("Meshes are in millimetres", &mm)) c.requests.browser.in_millimetres = mm;
  ui::tooltip("Off: in metres");
  draw_desktop_chooser(c);
}

void draw_browser_footer(const PanelContext& c) {
  const BrowserModel& browser = c.model.browser;
  if (browser.importing) {
    ImGui::ProgressBar(static_cast<float>(browser.fraction), {c.px(200), 0}, "Importing");
    ImGui::SameLine();
    if (ImGui::Button("Stop")) c.requests.browser.stop_import = true;
    ImGui::SameLine();
  }
  if (ImGui::Button("New patient ...")) c.requests.patient.toggle = true;
  ui::tooltip("Makes a wrist or knee from measures (N)");
  ImGui::SameLine();
  if (ImGui::Button("Segment a scan ...")) c.requests.segment_scan = true;
  ui::tooltip("Makes a case from a CT scan by hand, in a window that replaces this one");
  ImGui::SameLine();
  if (ImGui::Button("Close  (O)")) c.requests.browser.toggle = true;
}

}  // namespace

void draw_browser(const PanelContext& c) {
  const UiRect& r = c.layout.picture;
  const float w = std::min(c.px(860), r.w - c.px(16)), h = std::min(c.px(520), r.h - c.px(16));
  ImGui::SetNextWindowPos({r.x + r.w / 2, r.y + r.h / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({w, h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(16), c.px(12)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, color::kPanel);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, 0);
  ImGui::Begin(
      "##browser", nullptr,
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  {
    const ui::WithFont strong(c.fonts.strong);
    ImGui::TextUnformatted("Open");
  }
  const float body = ImGui::GetContentRegionAvail().y - ImGui::GetFrameHeightWithSpacing();
  const float left = 0.46f * (w - c.px(40));
  ImGui::BeginChild("left", {left, body});
  draw_known(c);
  ImGui::EndChild();
  ImGui::SameLine(0, c.px(8));
  ImGui::BeginChild("right", {0, body});
  draw_folder(c);
  ImGui::EndChild();
  draw_browser_footer(c);
  ImGui::End();
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar();
}

}  // namespace osteon
