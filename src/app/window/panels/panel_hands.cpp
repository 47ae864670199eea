#include <cmath>
#include <string>
#include <vector>

#include "ui/ui_widgets.h"
#include "window/panels/picture_words.h"

namespace osteon {
namespace {

constexpr ImU32 kNameGround = IM_COL32(0x15, 0x18, 0x1c, 0xb0);
constexpr ImU32 kNameLine = IM_COL32(0x15, 0x18, 0x1c, 0xff);

void draw_row(const HandRow& row) {
  const std::string name = row.name.empty() ? "Holds" : row.name;
  // What changes comes first: a long name is cut off.
  std::string what = row.runs ? "Running: " : "";
  if (!row.portal.empty()) what += "in " + row.portal + ": ";
  what += row.instrument;
  const std::string fits = ui::shortened(what, ImGui::GetContentRegionAvail().x * 0.68f);
  std::string help = fits == what ? "" : what + "\n";
  help += row.rests ? "Rests as if an assistant held it. Alt + wheel moves it along its shaft, "
                      "Alt + Q, E turns it about its shaft (a scope's light post), Alt + W, A, S, "
                      "D tilts it. A gamepad's sticks, triggers and bumpers do the same."
                    : "The instrument that this hand holds";
  ui::stat(name.c_str(), fits, help.c_str(),
           row.runs     ? color::kAccent
           : row.active ? color::kText
                        : color::kTextQuiet);
}

void draw_hand_buttons(const PanelContext& c) {
  const HandsModel& hands = c.model.hands;
  const float gap = c.px(4);
  const float w = (ImGui::GetContentRegionAvail().x - gap) / 2;
  const bool two = hands.rows.size() > 1;
  ImGui::BeginDisabled(!two && !hands.can_add);
  if (ImGui::Button(two ? "Change  (X)" : "2nd hand  (X)", {w, 0})) c.requests.hands.change = true;
  ImGui::EndDisabled();
  ui::tooltip(two ? "You move the other hand; this one rests where it is"
                  : "Adds a second hand. This restarts the run.");
  ImGui::SameLine(0, gap);
  if (ui::toggle_button("Tray  (T)", hands.tray.open, {w, 0})) c.requests.hands.toggle_tray = true;
  ui::tooltip(
      "All instruments, with pictures. Page Up, Page Down: previous, next; End: next size.");
  if (ImGui::Button("Mark  (K)", {w, 0})) c.requests.hands.mark = true;
  ui::tooltip("Marks this moment (bones, instruments, power) so that you can go back to it");
  ImGui::SameLine(0, gap);
  ImGui::BeginDisabled(hands.restore_points == 0);
  if (ImGui::Button("Undo  (U)", {w, 0})) c.requests.hands.undo = true;
  ImGui::EndDisabled();
  ui::tooltip(
      "Back to the last mark, or the start of the run; again: to the one before. Hands stay where "
      "they are; the force returns once they are free.");
}

void draw_portals(const PanelContext& c) {
  const HandsModel& hands = c.model.hands;
  if (!hands.can_bring || hands.portals.empty()) return;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  if (!ImGui::BeginCombo("##portal", "Bring to a portal  (G)")) return;
  for (std::size_t i = 0; i < hands.portals.size(); ++i)
    if (ImGui::Selectable(hands.portals[i].c_str())) c.requests.hands.portal = i;
  ImGui::EndCombo();
}

void draw_tip(const PanelContext& c) {
  const TipModel& tip = c.model.hands.tip;
  const auto& labels = tip.soft ? c.model.soft_labels : c.model.bone_labels;
  const std::size_t k = tip.soft ? *tip.soft : tip.bone.index;
  if (!tip.known || k >= labels.size()) return;
  ui::stat(("Tip to " + labels[k]).c_str(), ui::number(tip.distance_mm, 1) + " mm",
           "From the middle of the tip to the nearest surface of a bone, or of a ligament, "
           "meniscus, stump or patch of skin that is felt (before any cut), millimetres; negative "
           "inside");
  if (tip.depth_mm)
    ui::stat("In its hole", ui::number(*tip.depth_mm, 1) + " mm",
             "From the mouth of the hole to the tip, along the hole, by the bone as it was before "
             "any cut");
}

// From the middle of the bone to a name that had to give way.
void draw_leader(const PanelContext& c, const NameTag& tag, const UiRect& at) {
  const float edge = tag.y < at.y ? at.y : at.bottom();
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->AddLine({tag.x, tag.y}, {tag.x, edge}, kNameLine, c.px(1));
  draw->AddCircleFilled({tag.x, tag.y}, c.px(2), kNameLine);
}

}  // namespace

void draw_hands(const PanelContext& c) {
  if (!c.model.replay.on) {
    for (const HandRow& row : c.model.hands.rows) draw_row(row);
    draw_hand_buttons(c);
    draw_portals(c);
  }
  draw_tip(c);
}

void draw_tip_line(const PanelContext& c) {
  const TipModel& tip = c.model.hands.tip;
  if (!tip.drawn) return;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->AddLine({tip.x0, tip.y0}, {tip.x1, tip.y1}, IM_COL32(0xff, 0xff, 0xff, 0x90), c.px(1));
  draw->AddCircle({tip.x1, tip.y1}, c.px(3), IM_COL32(0xff, 0xff, 0xff, 0xb0), 12, c.px(1));
  const PictureWords words = tip_words(c);
  const ImVec2 at{words.at.x, words.at.y};
  const ui::WithFont small(c.fonts.small);
  draw->AddText({at.x + 1, at.y + 1}, IM_COL32(0, 0, 0, 0xc0), words.text.c_str());
  draw->AddText(at, color::kText, words.text.c_str());
}

void draw_bone_names(const PanelContext& c) {
  const ui::WithFont small(c.fonts.small);
  const std::vector<NameTag>& tags = c.model.hands.names;
  const std::vector<PictureWords> words = name_words(c);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const UiRect& r = words[i].at;
    if (words[i].text.empty()) continue;
    if (std::abs(r.y + r.h / 2 - tags[i].y) > c.px(1)) draw_leader(c, tags[i], r);
  }
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  for (const PictureWords& each : words) {
    if (each.text.empty()) continue;
    const UiRect& r = each.at;
    draw->AddRectFilled({r.x, r.y}, {r.right(), r.bottom()}, kNameGround, c.px(3));
    draw->AddText({r.x + c.px(4), r.y + c.px(1)}, color::kText, each.text.c_str());
  }
}

// No letters: they work while a word is typed into the tray, too.
void read_paging_keys(const PanelContext& c) {
  constexpr int kPageUp = 266, kPageDown = 267, kEnd = 269;  // GLFW's numbers
  if (c.model.replay.on || ImGui::GetIO().KeyAlt) return;
  if (ImGui::IsKeyPressed(kPageUp, false)) c.requests.hands.step = -1;
  if (ImGui::IsKeyPressed(kPageDown, false)) c.requests.hands.step = 1;
  if (ImGui::IsKeyPressed(kEnd, false)) c.requests.hands.next_size = true;
}

void read_hand_keys(const PanelContext& c) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
  HandsRequests& requests = c.requests.hands;
  if (pressed('L')) requests.toggle_names = true;
  if (c.model.replay.on || io.KeyAlt) return;
  if (pressed('X')) requests.change = true;
  if (pressed('T')) requests.toggle_tray = true;
  if (pressed('G') && c.model.hands.can_bring && !c.model.hands.portals.empty())
    requests.portal = c.model.hands.next_portal;
  if (pressed('K')) requests.mark = true;
  if (pressed('U')) requests.undo = true;
  if (pressed('Z')) requests.upright = true;
  if (pressed('Y')) {
    c.requests.exercise.as_expert = true;
    c.requests.exercise.to_expert = io.KeyShift;
  } else if (io.KeyShift && ImGui::IsKeyDown('Y')) {
    constexpr double kLongest_s = 0.25;  // of a picture: no leap after a slow one
    c.requests.exercise.along_expert_s = std::min(static_cast<double>(io.DeltaTime), kLongest_s);
  }
  read_paging_keys(c);
}

}  // namespace osteon
