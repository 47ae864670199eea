#include <algorithm>
#include <array>
#include <cstring>
#include <string>

#include "ui/ui_widgets.h"
#include "window/panels/picture_words.h"

namespace osteon {
namespace {

constexpr std::size_t kNoteBytes = 501;  // with the end

void edit_text(const PanelContext& c, const NoteRow& row) {
  static_assert(kNoteBytes > 1);
  std::array<char, kNoteBytes> text{};
  std::memcpy(text.data(), row.text.data(), std::min(row.text.size(), kNoteBytes - 1));
  ImGui::SetNextItemWidth(-1);
  if (ImGui::IsWindowAppearing() || !ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();
  const bool entered =
      ImGui::InputText("##text", text.data(), text.size(),
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  if (entered || ImGui::IsItemDeactivated()) c.requests.notes.text = std::string(text.data());
}

void draw_menu(const PanelContext& c, std::size_t i, const NoteRow& row) {
  if (!ImGui::BeginPopup("note")) return;
  ImGui::PushTextWrapPos(c.px(260));
  ui::text(color::kText, row.text.c_str());
  if (!row.where.empty()) ui::text(color::kTextQuiet, row.where.c_str());
  ImGui::PopTextWrapPos();
  ImGui::BeginDisabled(!c.model.notes.can_edit);
  if (ImGui::MenuItem("Change the text")) c.requests.notes.edit = i;
  if (ImGui::MenuItem("Move it")) c.requests.notes.move = i;
  if (ImGui::MenuItem("Remove it")) c.requests.notes.remove = i;
  ImGui::EndDisabled();
  ImGui::EndPopup();
}

void draw_note(const PanelContext& c, std::size_t i) {
  const NotesModel& notes = c.model.notes;
  const NoteRow& row = notes.rows[i];
  ImGui::PushID(static_cast<int>(i));
  if (notes.editing == i && notes.can_edit) {
    edit_text(c, row);
  } else {
    const float width = ImGui::GetContentRegionAvail().x;
    const std::string line = std::to_string(i + 1) + "  " + row.text;
    if (ImGui::Selectable(ui::shortened(line, width - c.px(4)).c_str(), false, 0,
                          {width, c.px(18)}))
      ImGui::OpenPopup("note");
    ui::tooltip(row.text.c_str());
    draw_menu(c, i, row);
  }
  ImGui::PopID();
}

void draw_note_buttons(const PanelContext& c) {
  const NotesModel& notes = c.model.notes;
  if (notes.placing) {
    ImGui::PushTextWrapPos(0);
    ui::text(color::kText, "Click on a bone to place the note.");
    ImGui::PopTextWrapPos();
    if (ImGui::Button("Cancel", {-1, 0})) c.requests.notes.stop_placing = true;
    return;
  }
  ImGui::BeginDisabled(!notes.can_edit);
  if (ImGui::Button("Add a note", {-1, 0})) c.requests.notes.add = true;
  ImGui::EndDisabled();
  if (notes.saves_itself || !notes.changed) return;
  ImGui::BeginDisabled(notes.saving || !notes.can_edit);
  if (ui::accent_button(notes.saving ? "Saving" : "Save as a case", {-1, 0}))
    c.requests.notes.save = true;
  ImGui::EndDisabled();
  ui::tooltip("A built-in case cannot store notes: this saves a copy of it with them");
}

}  // namespace

void draw_notes_section(const PanelContext& c) {
  const NotesModel& notes = c.model.notes;
  if (!ui::section(c.fonts, "Notes", !notes.rows.empty() || notes.placing)) return;
  ImGui::PushID("notes");
  for (std::size_t i = 0; i < notes.rows.size(); ++i) draw_note(c, i);
  bool shown = notes.shown;
  if (!notes.rows.empty() &&
      ui::switch_row("In the picture", &shown, "Shows the notes at their positions"))
    c.requests.notes.toggle_shown = true;
  draw_note_buttons(c);
  ImGui::PopID();
}

// A dot at its place, its words beside.
void draw_notes(const PanelContext& c) {
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const ui::WithFont small(c.fonts.small);
  const std::vector<PictureWords> words = note_words(c);
  std::size_t next = 0;
  for (const NoteRow& row : c.model.notes.rows) {
    if (!row.drawn) continue;
    const PictureWords& each = words[next++];
    if (each.text.empty()) continue;
    const UiRect& r = each.at;
    draw->AddLine({row.x, row.y}, {r.x > row.x ? r.x : r.right(), r.y + r.h / 2}, color::kAccent,
                  c.px(1));
    draw->AddCircleFilled({row.x, row.y}, c.px(3.5f), color::kAccent);
    draw->AddCircle({row.x, row.y}, c.px(3.5f), IM_COL32(0x15, 0x18, 0x1c, 0xff), 0, c.px(1));
    draw->AddRectFilled({r.x, r.y}, {r.right(), r.bottom()}, IM_COL32(0x15, 0x18, 0x1c, 0xd8),
                        c.px(3));
    draw->AddText({r.x + c.px(6), r.y + c.px(3)}, color::kText, each.text.c_str());
  }
}

}  // namespace osteon
