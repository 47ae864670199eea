#include "window/panels/panel_exercise_knee.h"

#include <algorithm>
#include <string>
#include <vector>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

void draw_loads(const PanelContext& c, const ExaminedKneeModel& exam) {
  double pull_n = exam.pull_n, pivot = 100 * exam.pivot_share;
  const std::string pivot_help =
      "Of " + ui::number(exam.full_valgus_nm, 0) + " Nm valgus and " +
      ui::number(exam.full_internal_nm, 0) +
      " Nm inwards. Load it below 15 degrees, then bend it to 30 or more";
  if (ui::slider("Lachman", &pull_n, 0, exam.full_n, "%.0f N",
                 "Your pull on the tibia to the front. Pull with all of it at 20 to 40 degrees"))
    c.requests.exercise.pull_n = pull_n;
  if (ui::slider("Pivot shift", &pivot, 0, 100, "%.0f %%", pivot_help.c_str()))
    c.requests.exercise.pivot_share = pivot / 100;
  const std::string load = exam.now_share > 0 ? ui::number(100 * exam.now_share, 0) + " %"
                                              : ui::number(exam.now_n, 0) + " N";
  ui::stat("Tibia forward", ui::number(exam.front_mm, 1) + " mm at " + load,
           exam.grafted ? "From where it rests, held by the graft as it was fixed"
                        : "From where it rests; no ligament or graft holds it");
  ui::stat("Intact knee", ui::number(exam.other_mm, 1) + " mm", "The same load on the other side");
}

// What the hands do to the tibia, and how far it goes.
void draw_exam(const PanelContext& c) {
  const ExaminedKneeModel& exam = c.model.exercise.knee.exam;
  if (!exam.shown) return;
  if (!exam.problem.empty()) return ui::wrapped_text(color::kAmber, exam.problem);
  if (exam.computing)
    return ui::text(color::kTextQuiet, "How the knee gives is being computed ...");
  // Where the knee is not tested the place is left to what is.
  if (exam.may)
    draw_loads(c, exam);
  else
    ui::wrapped_text(color::kTextQuiet, "Bend it to " + ui::number(exam.most_deg, 0) +
                                            " degrees or less to test Lachman and pivot shift.");
  const auto found = [](const char* name, const std::optional<double>& mm) {
    ui::stat(name, mm ? ui::number(*mm, 1) + " mm more" : "not done",
             "Side difference where the tibia went farthest; 3 mm or less is a good graft");
  };
  found("Lachman found", exam.lachman_mm);
  found("Pivot found", exam.pivot_mm);
}

void draw_isometry(const PanelContext& c, const BentKneeModel& knee) {
  if (knee.between_mm.size() < 2) return;
  const auto [least, most] = std::minmax_element(knee.between_mm.begin(), knee.between_mm.end());
  std::vector<float> lengths(knee.between_mm.begin(), knee.between_mm.end());
  const auto low = static_cast<float>(*least - 1), high = static_cast<float>(*most + 1);
  ImGui::PlotLines("##isometry", lengths.data(), static_cast<int>(lengths.size()), 0, nullptr, low,
                   high, {ImGui::GetContentRegionAvail().x, c.px(56)});
  const std::string change = ui::number(*most - *least, 1) + " mm from " +
                             ui::number(knee.flexion_deg.front(), 0) + " to " +
                             ui::number(knee.flexion_deg.back(), 0) + " degrees";
  ui::wrapped_text(color::kTextQuiet, "Graft's length changes by " + change);
}

}  // namespace

void draw_exercise_knee(const PanelContext& c) {
  const BentKneeModel& knee = c.model.exercise.knee;
  if (!knee.shown) return;
  ImGui::Separator();
  double flexion_deg = knee.wanted_deg, tension_n = knee.tension_n;
  if (ui::slider("Knee", &flexion_deg, knee.least_deg, knee.most_deg, "%.0f degrees",
                 "How far the knee is bent. From straight to bent and back is a cycle"))
    c.requests.exercise.bend_deg = flexion_deg;
  if (knee.placed) {
    if (ui::slider("Graft's tail", &tension_n, 0, 150, "%.0f N",
                   "The pull on the graft below the tibia, while the knee is bent and the screw "
                   "goes in"))
      c.requests.exercise.tension_n = tension_n;
    ui::stat("Cycles", std::to_string(knee.cycles), "How often it was stretched out and bent");
    draw_isometry(c, knee);
  }
  draw_exam(c);
}

}  // namespace osteon
