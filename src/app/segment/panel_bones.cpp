#include <algorithm>
#include <cstdio>
#include <string>

#include "segment/label_color.h"
#include "segment/segment_panels.h"
#include "ui/panel_ground.h"
#include "ui/ui_widgets.h"

namespace osteon {
namespace {

std::string volume_text(double cm3) { return ui::number(cm3, cm3 < 10 ? 2 : 1) + " cm\xc2\xb3"; }

std::string details_of(const SegmentBoneRow& bone) {
  std::string text = bone.name + "\n" + std::to_string(bone.voxels) + " voxels, " +
                     ui::number(bone.volume_cm3, 3) + " cm\xc2\xb3";
  if (bone.fma_id != 0) text += "\nFMA " + std::to_string(bone.fma_id);
  return text;
}

void draw_row(const SegmentContext& c, const SegmentBoneRow& bone) {
  ImGui::PushID(bone.label);
  const float row = ImGui::GetCursorPosY(), eye = c.px(18), h = c.px(20);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float side = c.px(12);
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 0.5f * (h - side)},
                                            {at.x + side, at.y + 0.5f * (h + side)},
                                            label_color(bone.label), c.px(3));
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + side + c.px(8));
  const float left = ImGui::GetCursorPosX();
  const float width = ImGui::GetContentRegionAvail().x - eye;
  if (ImGui::Selectable("##row", c.model.chosen == bone.label, 0, {width, h}))
    c.requests.choose = bone.label;
  ui::tooltip(details_of(bone).c_str());
  const std::string volume = volume_text(bone.volume_cm3);
  const float volume_w = ImGui::CalcTextSize(volume.c_str()).x;
  const float text_y = row + 0.5f * (h - ImGui::GetTextLineHeight());
  ImGui::SetCursorPos({left, text_y});
  ui::text(bone.shown ? color::kText : color::kTextQuiet,
           ui::shortened(bone.name, width - volume_w - c.px(14)).c_str());
  ImGui::SetCursorPos({left + width - volume_w - c.px(4), text_y});
  ui::text(color::kTextQuiet, volume.c_str());
  ImGui::SetCursorPos({left + width, row + 0.5f * (h - eye)});
  if (ui::eye_button("eye", bone.shown, eye)) c.requests.toggle_shown = bone.label;
  ui::tooltip(bone.shown ? "Hide it" : "Show it");
  ImGui::SetCursorPosY(row + h);
  ImGui::PopID();
}

void draw_empty_list(const SegmentContext& c) {
  ImGui::PushTextWrapPos(0);
  ui::text(color::kTextQuiet,
           "No bones yet. Let Osteon find them, or take the Grow tool and click on one.");
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, c.px(4)});
}

void draw_list(const SegmentContext& c, float height) {
  ImGui::BeginChild("list", {0, height});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {c.px(8), c.px(1)});
  if (c.model.bones.empty()) draw_empty_list(c);
  for (const SegmentBoneRow& bone : c.model.bones) draw_row(c, bone);
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

void draw_name_menu(const SegmentContext& c, const SegmentBoneRow& bone) {
  ImGui::SetNextWindowSizeConstraints({c.px(180), 0}, {c.px(220), c.px(360)});
  if (!ImGui::BeginPopup("names")) return;
  for (const std::string& name : c.model.known_names) {
    const bool used = std::any_of(c.model.bones.begin(), c.model.bones.end(),
                                  [&](const SegmentBoneRow& b) { return b.name == name; });
    if (ImGui::MenuItem(name.c_str(), nullptr, false, !used))
      c.requests.rename = NewName{bone.label, name};
  }
  ImGui::EndPopup();
}

/// The field shows the bone's own name until the user types in it.
void draw_name_field(const SegmentContext& c, const SegmentBoneRow& bone) {
  char text[64];
  std::snprintf(text, sizeof text, "%s", bone.name.c_str());
  const float button = ImGui::GetFrameHeight();
  ImGui::PushID(bone.label);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - c.px(4));
  const bool entered =
      ImGui::InputText("##name", text, sizeof text,
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  if ((entered || ImGui::IsItemDeactivatedAfterEdit()) && bone.name != text)
    c.requests.rename = NewName{bone.label, text};
  ui::tooltip(
      "Name of the chosen bone. A known name also sets its number in the Foundational Model of "
      "Anatomy");
  ImGui::SameLine(0, c.px(4));
  if (ImGui::ArrowButton("##names", ImGuiDir_Down)) ImGui::OpenPopup("names");
  ui::tooltip("Known names of bones");
  draw_name_menu(c, bone);
  ImGui::PopID();
}

void draw_chosen(const SegmentContext& c) {
  const auto bone =
      std::find_if(c.model.bones.begin(), c.model.bones.end(),
                   [&](const SegmentBoneRow& b) { return b.label == c.model.chosen; });
  const bool none = bone == c.model.bones.end();
  if (none)
    ui::text(color::kTextQuiet, "Choose a bone to name it");
  else
    draw_name_field(c, *bone);
  const float gap = c.px(4);
  const float w = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  if (ImGui::Button("New", {w, 0})) c.requests.add = true;
  ui::tooltip("A new bone without voxels, to paint or grow (N)");
  ImGui::SameLine(0, gap);
  ImGui::BeginDisabled(none);
  if (ImGui::Button("Remove", {w, 0})) c.requests.remove = c.model.chosen;
  ui::tooltip("Deletes the chosen bone's voxels and name; can be undone");
  ImGui::SameLine(0, gap);
  const bool all = std::all_of(c.model.bones.begin(), c.model.bones.end(),
                               [](const SegmentBoneRow& b) { return b.shown; });
  if (ImGui::Button(all ? "Alone###alone" : "Show all###alone", {w, 0}))
    (all ? c.requests.hide_others : c.requests.show_all) = true;
  ImGui::EndDisabled();
  ui::tooltip(all ? "Hides every other bone" : "Shows every bone");
}

void draw_history(const SegmentContext& c) {
  const SegmentModel& m = c.model;
  const float gap = c.px(4);
  const float w = (ImGui::GetContentRegionAvail().x - gap) / 2;
  ImGui::BeginDisabled(m.undo_steps == 0);
  if (ImGui::Button("Undo", {w, 0})) c.requests.undo = true;
  ImGui::EndDisabled();
  ui::tooltip(("Ctrl + Z" + (m.undo_what.empty() ? "" : ": " + m.undo_what)).c_str());
  ImGui::SameLine(0, gap);
  ImGui::BeginDisabled(m.redo_steps == 0);
  if (ImGui::Button("Redo", {w, 0})) c.requests.redo = true;
  ImGui::EndDisabled();
  ui::tooltip(("Ctrl + Shift + Z" + (m.redo_what.empty() ? "" : ": " + m.redo_what)).c_str());
}

void draw_finish(const SegmentContext& c) {
  const float width = ImGui::GetContentRegionAvail().x;
  const bool empty = c.model.bones.empty();
  ImGui::BeginDisabled(c.model.job.has_value());
  if (empty ? ui::accent_button("Find the bones", {width, 0})
            : ImGui::Button("Find the bones again", {width, 0}))
    c.requests.suggest = true;
  ui::tooltip(
      "Finds bones as `osteon import ct` does, with names if the scan shows a wrist. Replaces what "
      "is drawn; can be undone");
  ImGui::BeginDisabled(empty);
  if (!empty ? ui::accent_button("Save as a case", {width, 0})
             : ImGui::Button("Save as a case", {width, 0}))
    c.requests.save = true;
  ImGui::EndDisabled();
  ImGui::EndDisabled();
  ui::tooltip(("Draws the surfaces and writes " + c.model.out + "  (Ctrl + S)").c_str());
  if (c.model.saved) {
    if (ImGui::Button("Open in the simulator", {width, 0})) c.requests.open_case = true;
    ui::tooltip("Closes this window and opens the saved case (Ctrl + O)");
    return;
  }
  const ui::WithFont small(c.fonts.small);
  ui::text_within(color::kTextQuiet, "to " + c.model.out, width);
}

}  // namespace

void draw_bone_card(const SegmentContext& c) {
  const UiRect& r = c.layout.bones;
  ImGui::SetNextWindowPos({r.x, r.y});
  ImGui::SetNextWindowSize({r.w, r.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(12), c.px(8)});
  begin_panel("##bones", kSideCard | ImGuiWindowFlags_NoScrollbar);
  ImGui::PopStyleVar(3);
  {
    const ui::WithFont strong(c.fonts.strong);
    ImGui::TextUnformatted("Bones");
  }
  // The list takes what the rest leaves.
  const float rest = 5 * ImGui::GetFrameHeightWithSpacing() + c.px(48);
  draw_list(c, std::max(c.px(60), ImGui::GetContentRegionAvail().y - rest));
  ImGui::Dummy({0, c.px(2)});
  draw_chosen(c);
  ImGui::Dummy({0, c.px(2)});
  draw_history(c);
  draw_finish(c);
  ImGui::End();
}

}  // namespace osteon
