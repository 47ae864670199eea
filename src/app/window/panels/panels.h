#pragma once

#include "ui/ui_layout.h"
#include "ui/ui_theme.h"
#include "window/ui_model.h"
#include "window/ui_requests.h"

namespace osteon {

/// Draws the whole interface of one frame with the current ImGui context (between NewFrame and
/// Render) and returns what the user asked for. Needs no window.
UiRequests draw_ui(const UiModel& model, const UiFonts& fonts);

/// What the parts below share.
struct PanelContext {
  const UiModel& model;
  const UiFonts& fonts;
  const UiLayout& layout;
  UiRequests& requests;
  float px(float units) const { return units * model.scale; }
};

void draw_top_bar(const PanelContext& c);
void draw_case_card(const PanelContext& c);
void draw_joint_section(const PanelContext& c);
void draw_soft_section(const PanelContext& c);
void draw_notes_section(const PanelContext& c);
void draw_notes(const PanelContext& c);  // in the picture
void draw_view_section(const PanelContext& c);
void draw_picture_section(const PanelContext& c);  // its light, and what is drawn beside bones
void draw_heat_legend(const PanelContext& c);      // where they are by how warm they became
void draw_felt_legend(const PanelContext& c);      // where bones are coloured by what is felt
void draw_hand_card(const PanelContext& c);
void draw_hands(const PanelContext& c);       // who holds what, within the hand card
void draw_tray(const PanelContext& c);        // of instruments
void draw_tip_line(const PanelContext& c);    // to the nearest bone, in the picture
void draw_bone_names(const PanelContext& c);  // in the picture
void read_hand_keys(const PanelContext& c);
void read_paging_keys(const PanelContext& c);  // through the tray
void draw_device_section(const PanelContext& c);
void draw_force_section(const PanelContext& c);
void draw_timeline(const PanelContext& c);
void draw_notices(const PanelContext& c);  // toasts, hint, probe hint, name tag
void draw_loading(const PanelContext& c);
void draw_browser(const PanelContext& c);  // of what can be opened
void draw_help(const PanelContext& c);
void draw_checkup(const PanelContext& c);
void draw_edit(const PanelContext& c);                             // of a bone's surface
void draw_patient(const PanelContext& c);                          // a new one
void draw_exercise_card(const PanelContext& c, UiLayout& layout);  // how far it is; gives way
void draw_exercise(const PanelContext& c);                         // course, briefing, result
void draw_xray_desk(const PanelContext& c, const UiRect& pane);    // of a large X-ray pane
void draw_panes(const PanelContext& c);  // names and messages of the picture's views
/// The chooser of what the picture shows: buttons side by side, or one that opens.
void draw_layout_chooser(const PanelContext& c, bool wide);
float layout_chooser_width(const PanelContext& c, bool wide);
void draw_observer_section(const PanelContext& c);
void draw_sound_section(const PanelContext& c);
void draw_water_section(const PanelContext& c);  // of a scope's picture, if one is on show
void draw_scope_camera_section(const PanelContext& c);
std::string film_label(const ScreenFilmModel& film);
void draw_film_button(const PanelContext& c);
void read_layout_keys(const PanelContext& c);
void read_shortcuts(const PanelContext& c);

}  // namespace osteon
