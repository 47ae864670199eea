#include <algorithm>
#include <cmath>
#include <string>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

// A wrist lies on its palm under the tube.
const char* front_name(const PanelContext& c) { return c.model.is_knee ? "AP" : "PA"; }

std::string turn_words(const PanelContext& c, const CArmTurn& turn) {
  if (turn == CArmTurn{}) return front_name(c);
  if (turn == CArmTurn{kMostOrbit_deg, 0}) return "Lateral";
  const std::string orbit = ui::number(turn.orbit_deg, 0) + "\xC2\xB0";
  return turn.tilt_deg == 0 ? orbit : orbit + ", tilt " + ui::number(turn.tilt_deg, 0) + "\xC2\xB0";
}

void draw_trigger(const PanelContext& c, float width) {
  const bool on = c.model.views.shooting;
  ImGui::BeginDisabled(!c.model.views.can_shoot);
  if (ui::accent_button(on ? "Exposing ...###shoot" : "Take a picture  (B)###shoot", {width, 0}))
    c.requests.views.shoot = true;
  ImGui::EndDisabled();
  ui::tooltip("One pulse of X-rays through the scene as it stands");
}

void draw_turn(const PanelContext& c, float width) {
  CArmTurn turn = c.model.views.xray.turn;
  const CArmTurn front, side{kMostOrbit_deg, 0};
  const float gap = c.px(4), w = std::floor((width - gap) / 2);
  if (ui::toggle_button(front_name(c), turn == front, {w, 0})) c.requests.views.xray.turn = front;
  ui::tooltip("The source in front of a knee, over the back of a hand");
  ImGui::SameLine(0, gap);
  if (ui::toggle_button("Lateral", turn == side, {w, 0})) c.requests.views.xray.turn = side;
  ui::tooltip("The source on the outer side, where the thumb is");
  ImGui::PushItemWidth(width);
  bool changed = ui::slider("Orbit", &turn.orbit_deg, -kMostOrbit_deg, kMostOrbit_deg,
                            "%.0f\xC2\xB0", "Turns the C-arm about the limb's long axis");
  changed |= ui::slider("Tilt", &turn.tilt_deg, -kMostTilt_deg, kMostTilt_deg, "%.0f\xC2\xB0",
                        "Tilts the source upwards in the picture");
  ImGui::PopItemWidth();
  if (changed)
    c.requests.views.xray.turn = CArmTurn{std::round(turn.orbit_deg), std::round(turn.tilt_deg)};
}

void draw_dose(const PanelContext& c) {
  const XrayTally& total = c.model.views.xray.total;
  ui::stat("Pictures", std::to_string(total.dose.shots), "Taken since the examination began");
  ui::stat("Beam", ui::number(total.dose.seconds, 2) + " s", "Time of X-rays");
  ui::stat("Air kerma", dose_words(total.dose.air_kerma_mgy),
           "Of all pictures, at 750 mm from the focus");
  ui::stat("KAP", ui::number(total.dose.kerma_area_mgy_cm2, 1) + " mGy cm\xC2\xB2",
           "Air kerma times the area of the beam, of all pictures");
  for (std::size_t h = 0; h < total.hands; ++h)
    ui::stat(total.hands == 1 ? "Hand" : ("Hand " + std::to_string(h + 1)).c_str(),
             dose_words(total.hands_mgy[h]),
             "Air kerma in the middle of the hand that holds an instrument: of the beam, where the "
             "hand is in it, and scattered by the patient");
}

std::string shot_words(const PanelContext& c, const ShotModel& shot) {
  return "Picture " + std::to_string(shot.number) + ": " + turn_words(c, shot.turn) + ", " +
         ui::number(shot.exposure.kv, 0) + " kV, " + ui::number(shot.exposure.mas, 2) + " mAs, " +
         dose_words(shot.dose.air_kerma_mgy) + ", at " + ui::clock_time(shot.time_s);
}

void draw_thumbnail(const PanelContext& c, std::size_t place, float side) {
  const XrayModel& xray = c.model.views.xray;
  const ShotModel& shot = xray.shots[place];
  ImGui::PushID(shot.number);
  if (ImGui::InvisibleButton("shot", {side, side})) c.requests.views.xray.show = place;
  const bool hovered = ImGui::IsItemHovered();
  ui::tooltip(shot_words(c, shot).c_str());
  const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (shot.thumbnail != 0)
    draw->AddImage(reinterpret_cast<ImTextureID>(shot.thumbnail), lo, hi);
  else
    draw->AddRectFilled(lo, hi, color::kField);
  const bool shown = place == xray.shown;
  draw->AddRect(lo, hi,
                shown     ? color::kAccent
                : hovered ? color::kText
                          : color::kLine,
                0, 0, c.px(shown ? 2 : 1));
  const ui::WithFont small(c.fonts.small);
  const std::string label = std::to_string(shot.number) + "  " + turn_words(c, shot.turn);
  const float line = ImGui::GetTextLineHeight();
  draw->AddRectFilled({lo.x + 1, hi.y - line - c.px(3)}, {hi.x - 1, hi.y - 1},
                      IM_COL32(0x10, 0x12, 0x15, 0xc8));
  draw->AddText({lo.x + c.px(4), hi.y - line - c.px(2)}, shown ? color::kText : color::kTextQuiet,
                ui::shortened(label, side - c.px(6)).c_str());
  ImGui::PopID();
}

// The newest first.
void draw_strip(const PanelContext& c, bool beside) {
  const XrayModel& xray = c.model.views.xray;
  ImGui::BeginChild("strip", {0, 0}, false, beside ? 0 : ImGuiWindowFlags_HorizontalScrollbar);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float gap = c.px(6);
  const float side = beside ? std::floor((room.x - gap) / 2)
                            : std::max(c.px(40), room.y - ImGui::GetStyle().ScrollbarSize);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, gap});
  for (std::size_t k = 0; k < xray.shots.size(); ++k) {
    if (k > 0 && (!beside || k % 2 == 1)) ImGui::SameLine(0, gap);
    draw_thumbnail(c, xray.shots.size() - 1 - k, side);
  }
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

void draw_again(const PanelContext& c, float width) {
  ImGui::BeginDisabled(c.model.views.xray.total.dose.shots == 0);
  if (ImGui::Button("New examination", {width, 0})) c.requests.views.xray.begin_again = true;
  ImGui::EndDisabled();
  ui::tooltip("Forgets the pictures and sets the dose to zero");
}

void draw_column(const PanelContext& c) {
  const float width = ImGui::GetContentRegionAvail().x;
  draw_trigger(c, width);
  draw_turn(c, width);
  ImGui::Dummy({0, c.px(2)});
  draw_dose(c);
  draw_again(c, width);
  ImGui::Dummy({0, c.px(2)});
  draw_strip(c, true);
}

void draw_row(const PanelContext& c, bool strip_below) {
  const float gap = c.px(12), all = ImGui::GetContentRegionAvail().x;
  const float part = strip_below ? std::floor((all - gap) / 2) : c.px(160);
  const float high = strip_below ? c.px(116) : 0;
  ImGui::BeginChild("turn", {part, high});
  draw_trigger(c, part);
  draw_turn(c, part);
  ImGui::EndChild();
  ImGui::SameLine(0, gap);
  ImGui::BeginChild("dose", {part, high});
  draw_dose(c);
  draw_again(c, part);
  ImGui::EndChild();
  if (!strip_below) ImGui::SameLine(0, gap);
  draw_strip(c, false);
}

}  // namespace

void draw_xray_desk(const PanelContext& c, const UiRect& pane) {
  const XrayPlaces places = xray_places(pane, c.model.scale);
  ImGui::SetNextWindowPos({places.desk.x, places.desk.y});
  ImGui::SetNextWindowSize({places.desk.w, places.desk.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(8), c.px(8)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, color::kPanel);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, 0);
  ImGui::Begin("##xray", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  places.beside ? draw_column(c) : draw_row(c, places.strip_below);
  ImGui::End();
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar();
}

}  // namespace osteon
