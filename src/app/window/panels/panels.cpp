#include "window/panels/panels.h"

namespace osteon {

UiRequests draw_ui(const UiModel& model, const UiFonts& fonts) {
  UiRequests requests;
  const bool ready = model.phase == UiPhase::kReady;
  UiLayout layout =
      make_layout(model.width, model.height, model.scale, model.panels_open, model.left_card);
  const PanelContext c{model, fonts, layout, requests};
  read_shortcuts(c);
  if (model.panels_open) {
    draw_top_bar(c);
    if (ready) {
      draw_exercise_card(c, layout);
      draw_case_card(c);
      draw_hand_card(c);
      draw_timeline(c);
    }
  }
  if (ready) draw_panes(c);
  if (ready) draw_tip_line(c);
  if (ready) draw_bone_names(c);
  if (ready) draw_notes(c);
  if (ready && !model.panels_open) draw_exercise_card(c, layout);
  if (ready) draw_felt_legend(c);
  if (ready) draw_heat_legend(c);
  if (ready) draw_edit(c);
  if (!ready) draw_loading(c);
  draw_notices(c);
  if (model.help_open) draw_help(c);
  if (model.checkup.open && ready) draw_checkup(c);
  if (model.patient.open && ready) draw_patient(c);
  if (ready || model.exercise.page != ExercisePage::kOpening) draw_exercise(c);
  if (model.browser.open) draw_browser(c);
  if (model.hands.tray.open && ready) draw_tray(c);
  return requests;
}

}  // namespace osteon
