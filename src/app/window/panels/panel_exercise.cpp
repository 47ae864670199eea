#include <algorithm>
#include <cmath>
#include <string>

#include "ui/label.h"
#include "ui/ui_widgets.h"
#include "window/panels/panel_exercise_knee.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

constexpr ImGuiWindowFlags kExerciseWindow =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;

void strong(const PanelContext& c, const std::string& words) {
  const ui::WithFont font(c.fonts.strong);
  ui::wrapped_text(color::kText, words);
}

void quiet_heading(const PanelContext& c, const char* words) {
  ImGui::Dummy({0, c.px(4)});
  ui::text(color::kTextQuiet, words);
}

// "path_mm" -> "Path", "peak_force_n" -> "Peak force": the unit stands behind the number.
std::string measure_label(const ExerciseModel::Measure& measure) {
  std::string name = measure.name;
  std::string unit = "_" + measure.unit;
  std::transform(unit.begin(), unit.end(), unit.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  std::replace(unit.begin(), unit.end(), ' ', '_');
  std::replace(unit.begin(), unit.end(), '/', '_');
  if (name.ends_with(unit)) name.resize(name.size() - unit.size());
  return label_of(name);
}

std::string amount(double value, const std::string& unit) {
  return ui::number(value, std::abs(value) < 10 ? 2 : 0) + (unit.empty() ? "" : " " + unit);
}

void draw_course(const PanelContext& c) {
  const ExerciseModel& model = c.model.exercise;
  ui::wrapped_text(
      color::kTextQuiet,
      "Each judges what you touch, how hard and for how long. Your attempts stay on this "
      "computer.");
  if (!model.problem.empty()) ui::wrapped_text(color::kAmber, model.problem);
  ImGui::BeginChild("cards", {0, -ImGui::GetFrameHeightWithSpacing()});
  for (std::size_t i = 0; i < model.cards.size(); ++i) {
    const ExerciseModel::Card& card = model.cards[i];
    ImGui::PushID(static_cast<int>(i));
    ImGui::Dummy({0, c.px(6)});
    const float button_w = c.px(88);
    const float text_w = ImGui::GetContentRegionAvail().x - button_w - c.px(12);
    ImGui::BeginGroup();
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + text_w);
    {
      const ui::WithFont font(c.fonts.strong);
      ui::text(color::kText, card.title.c_str());
    }
    ImGui::PopTextWrapPos();
    ui::text_within(color::kTextQuiet, card.played.empty() ? "not tried yet" : card.played, text_w);
    ImGui::EndGroup();
    ui::tooltip(card.text.c_str());
    ImGui::SameLine(ImGui::GetCursorPosX() + text_w + c.px(12));
    if (ImGui::Button("Choose", {button_w, 0})) c.requests.exercise.choose = i;
    ImGui::PopID();
  }
  ImGui::EndChild();
  if (ImGui::Button("Close  (J)", {-1, 0})) c.requests.exercise.toggle = true;
}

void draw_stage_rows(const PanelContext& c) {
  for (const ExerciseModel::Stage& stage : c.model.exercise.stages) {
    if (!stage.in_part) continue;
    strong(c, stage.title);
    ui::wrapped_text(color::kTextQuiet, stage.instruction);
  }
}

void draw_faults(const PanelContext& c, bool with_time) {
  for (const ExerciseModel::Fault& fault : c.model.exercise.faults) {
    std::string line = fault.title + " (" + fault.severity + ")";
    if (!fault.where.empty()) line += ", " + fault.where;
    if (with_time) line = ui::clock_time(fault.at_s, false) + "  " + line;
    ui::wrapped_text(with_time ? color::kAmber : color::kText, line);
    ui::wrapped_text(color::kTextQuiet, fault.consequence);
  }
}

void draw_patient_choice(const PanelContext& c) {
  const auto& seed = c.model.exercise.seed;
  bool random = seed.has_value();
  if (ui::switch_row("Another patient", &random,
                     "The number determines side, measures and findings. Generating a new patient "
                     "takes a minute."))
    c.requests.exercise.seed =
        random ? std::optional<std::uint64_t>(1) : std::optional<std::uint64_t>();
  if (!seed) return;
  std::uint64_t number = *seed;
  ImGui::SetNextItemWidth(c.px(128));
  if (ImGui::InputScalar("##number", ImGuiDataType_U64, &number)) c.requests.exercise.seed = number;
  ImGui::SameLine(0, c.px(8));
  if (ImGui::Button("Next")) c.requests.exercise.seed = *seed + 1;
}

// The first or the last stage of the part that is played.
void draw_stage_choice(const PanelContext& c, const char* words, const char* help, bool first) {
  const auto& stages = c.model.exercise.stages;
  const auto is_in = [](const ExerciseModel::Stage& stage) { return stage.in_part; };
  const auto from = std::find_if(stages.begin(), stages.end(), is_in);
  const auto to = std::find_if(stages.rbegin(), stages.rend(), is_in);
  if (from == stages.end()) return;
  const ExerciseModel::Stage& chosen = first ? *from : *to;
  ui::text(color::kTextQuiet, words);
  ImGui::PushID(words);
  ImGui::SetNextItemWidth(-1);
  const bool chooses = ImGui::BeginCombo("##stage", chosen.title.c_str());
  ui::tooltip(help);
  for (auto stage = stages.begin(); chooses && stage != stages.end(); ++stage) {
    const bool fits = first ? stage->can_begin : stage >= from;
    if (!fits || !ImGui::Selectable(stage->title.c_str(), stage->name == chosen.name)) continue;
    const bool ends_before = first && stage > to.base() - 1;
    c.requests.exercise.part = {first ? stage->name : from->name,
                                first && !ends_before ? to->name : stage->name};
  }
  if (chooses) ImGui::EndCombo();
  ImGui::PopID();
}

void draw_part_choice(const PanelContext& c) {
  const auto& stages = c.model.exercise.stages;
  const auto can = [](const ExerciseModel::Stage& stage) { return stage.can_begin; };
  if (std::count_if(stages.begin(), stages.end(), can) < 2) return;
  draw_stage_choice(c, "Begin with",
                    "A virtual expert does the stages before it on this patient. The first time "
                    "that takes a minute or more.",
                    true);
  draw_stage_choice(c, "End after", "The attempt is over once this stage is done", false);
  if (c.model.exercise.parted)
    ui::wrapped_text(color::kTextQuiet,
                     "A part is judged by its errors; only a whole attempt is "
                     "scored.");
}

void draw_opening(const PanelContext& c) {
  const ExerciseModel& model = c.model.exercise;
  if (model.opening.empty()) return ui::text(color::kTextQuiet, "Opening the patient ...");
  ui::text_within(color::kTextQuiet, model.opening + " ...", ImGui::GetContentRegionAvail().x);
  ImGui::ProgressBar(static_cast<float>(model.opened), {-1, c.px(6)}, "");
}

void draw_briefing(const PanelContext& c) {
  const ExerciseModel& model = c.model.exercise;
  const bool opening = model.page == ExercisePage::kOpening;
  // What went wrong is told whole: its end says what to do.
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float told_h =
      model.problem.empty()
          ? line
          : std::min(6 * line, ImGui::CalcTextSize(model.problem.c_str(), nullptr, false,
                                                   ImGui::GetContentRegionAvail().x)
                                       .y +
                                   ImGui::GetStyle().ItemSpacing.y);
  ImGui::BeginChild("briefing", {0, line - told_h - 2.2f * ImGui::GetFrameHeightWithSpacing()});
  ui::wrapped_text(color::kText, model.text);
  for (const std::string& hand : model.hands) ui::wrapped_text(color::kTextQuiet, hand);
  ImGui::Dummy({0, c.px(4)});
  ImGui::BeginDisabled(opening);
  draw_patient_choice(c);
  draw_part_choice(c);
  ImGui::EndDisabled();
  quiet_heading(c, "What to do");
  draw_stage_rows(c);
  quiet_heading(c, "What to avoid");
  draw_faults(c, false);
  quiet_heading(c, "What counts");
  for (const ExerciseModel::Measure& m : model.measures)
    ui::stat(measure_label(m).c_str(),
             (m.lower_is_better ? "up to " : "from ") + amount(m.aim, m.unit),
             "The aim; the score compares you with experts");
  ui::stat("Time limit", ui::clock_time(model.limit_s, false), "The attempt ends then");
  ImGui::EndChild();
  if (opening && model.problem.empty())
    draw_opening(c);
  else if (model.problem.empty())
    ui::text(color::kTextQuiet, "The time starts with Begin.");
  else
    ui::wrapped_text(color::kAmber, model.problem);
  const float w = (ImGui::GetContentRegionAvail().x - c.px(8)) / 2;
  if (!model.opening.empty()) {
    if (ImGui::Button("Cancel", {-1, 0})) c.requests.exercise.stop_opening = true;
    return;
  }
  ImGui::BeginDisabled(opening);
  if (ui::accent_button("Begin  (Enter)", {w, 0})) c.requests.exercise.begin = true;
  ImGui::SameLine(0, c.px(8));
  if (ImGui::Button("Back", {w, 0})) c.requests.exercise.back = true;
  ImGui::EndDisabled();
}

void draw_exercise_verdict(const PanelContext& c) {
  const ExerciseModel& model = c.model.exercise;
  if (model.verdict.empty()) return ui::wrapped_text(color::kAmber, model.problem);
  const bool passed = model.verdict == "passed";
  const bool done = model.parted && model.verdict == "undecided";
  {
    const ui::WithFont font(c.fonts.strong);
    ui::text(passed || done ? color::kAccent : color::kAmber, passed ? "Passed"
                                                              : model.verdict == "not_passed"
                                                                  ? "Not passed"
                                                              : model.parted ? "Done"
                                                                             : "Undecided");
  }
  if (model.score)
    ui::wrapped_text(color::kText, "Score " + ui::number(*model.score, 1) + ", 95 % interval " +
                                       ui::number(*model.score_lo, 1) + " and " +
                                       ui::number(*model.score_hi, 1) + ". Experts average 100.");
  if (!model.why.empty()) ui::wrapped_text(color::kTextQuiet, model.why);
}

// On the bones beside the result.
void draw_debrief_choice(const PanelContext& c) {
  const ExerciseModel& model = c.model.exercise;
  const auto name = [&](DebriefView view) {
    switch (view) {
      case DebriefView::kWays:
        return model.shows_expert ? "Paths, the expert's in blue" : "Paths";
      case DebriefView::kForce:
        return "Force: red from 2.7 N";
      case DebriefView::kScratch:
        return "Scratches: red from 2.7 N mm";
      case DebriefView::kHeat:
        return "Heat: red from 44 C";
      case DebriefView::kNothing:
        break;
    }
    return "Nothing";
  };
  quiet_heading(c, "Show on the bones");
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##shown", name(model.shown))) return;
  if (ImGui::Selectable(name(DebriefView::kNothing), model.shown == DebriefView::kNothing))
    c.requests.exercise.show = DebriefView::kNothing;
  for (const DebriefView view : model.can_show)
    if (ImGui::Selectable(name(view), model.shown == view)) c.requests.exercise.show = view;
  ImGui::EndCombo();
}

void draw_result(const PanelContext& c) {
  const ExerciseModel& model = c.model.exercise;
  ImGui::BeginChild("result", {0, -2.2f * ImGui::GetFrameHeightWithSpacing()});
  draw_exercise_verdict(c);
  if (!model.can_show.empty()) draw_debrief_choice(c);
  quiet_heading(c, "Stages");
  for (const ExerciseModel::Stage& stage : model.stages)
    ui::stat(stage.title.c_str(), stage.done ? ui::clock_time(stage.at_s, false) : "not done",
             "When it was done", stage.done ? color::kText : color::kAmber);
  if (!model.faults.empty()) {
    quiet_heading(c, "Errors, and what they cost");
    draw_faults(c, true);
  }
  if (!model.asked.empty()) quiet_heading(c, "What you found");
  for (const ExerciseModel::Asked& asked : model.asked)
    ui::stat(asked.title.c_str(),
             asked.stated == asked.truth
                 ? asked.truth
                 : (asked.stated.empty() ? "nothing" : asked.stated) + ", is " + asked.truth,
             "What you stated, and the truth",
             asked.stated == asked.truth ? color::kText : color::kAmber);
  quiet_heading(c, "Measures");
  for (const ExerciseModel::Measure& m : model.measures) {
    const bool met = m.lower_is_better ? m.value <= m.aim : m.value >= m.aim;
    ui::stat(measure_label(m).c_str(), amount(m.value, m.unit),
             (std::string(m.lower_is_better ? "Aim: up to " : "Aim: from ") + amount(m.aim, m.unit))
                 .c_str(),
             met ? color::kText : color::kAmber);
  }
  if (model.undone > 0)
    ui::stat("Steps back", std::to_string(model.undone),
             "How often you went back; errors still count");
  if (model.guided_s > 0)
    ui::stat(
        "Led by the expert", ui::clock_time(model.guided_s, false),
        "How long your hand was guided; such an attempt does not count for the learning curve");
  if (model.hints > 0) ui::stat("Hints", std::to_string(model.hints), "How many you asked for");
  if (!model.repeats)
    ui::wrapped_text(color::kAmber,
                     "The replay differs from the recording; the verdict is that of the replay.");
  if (!model.problem.empty()) ui::wrapped_text(color::kAmber, model.problem);
  ImGui::EndChild();
  const float w = (ImGui::GetContentRegionAvail().x - c.px(8)) / 2;
  if (ImGui::Button("Watch it again", {w, 0})) c.requests.exercise.watch = true;
  ui::tooltip(model.file.c_str());
  ImGui::SameLine(0, c.px(8));
  if (ImGui::Button("Save as PDF", {w, 0})) c.requests.exercise.pages = true;
  if (ui::accent_button("Try again", {w, 0})) c.requests.exercise.begin = true;
  ImGui::SameLine(0, c.px(8));
  if (ImGui::Button("Exercises", {w, 0})) c.requests.exercise.back = true;
}

void draw_dialog(const PanelContext& c) {
  const UiRect& r = c.layout.picture;
  const ExercisePage page = c.model.exercise.page;
  const float w = std::min(c.px(440), r.w - c.px(16)), h = r.h - c.px(16);
  // Beside what it shows on the bones.
  const bool aside =
      page == ExercisePage::kResult && c.model.exercise.shown != DebriefView::kNothing;
  if (aside)
    ImGui::SetNextWindowPos({r.x + r.w - c.px(8), r.y + r.h / 2}, ImGuiCond_Always, {1, 0.5f});
  else
    ImGui::SetNextWindowPos({r.x + r.w / 2, r.y + r.h / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({w, h});
  ImGui::Begin("##exercise", nullptr, kExerciseWindow);
  const bool unnamed = page == ExercisePage::kCourse && c.model.exercise.title.empty();
  strong(c, unnamed ? "Exercises" : c.model.exercise.title);
  if (page == ExercisePage::kCourse)
    draw_course(c);
  else if (page == ExercisePage::kResult)
    draw_result(c);
  else
    draw_briefing(c);
  ImGui::End();
}

// The stage in hand with its neighbours: of a long exercise the others would cover the picture.
void draw_live_stage(const PanelContext& c) {
  constexpr std::ptrdiff_t kBefore = 1, kAfter = 2, kMostAtOnce = 6;
  const ExerciseModel& model = c.model.exercise;
  const auto count = static_cast<std::ptrdiff_t>(model.stages.size());
  const auto live = std::find_if(model.stages.begin(), model.stages.end(),
                                 [](const ExerciseModel::Stage& stage) { return stage.live; });
  const std::ptrdiff_t at = std::min(live - model.stages.begin(), count - 1);
  const bool all = count <= kMostAtOnce;
  const std::ptrdiff_t first = all ? 0 : std::max<std::ptrdiff_t>(0, at - kBefore);
  const std::ptrdiff_t end = all ? count : std::min(count, at + kAfter + 1);
  if (!all)
    ui::stat("Stage", std::to_string(at + 1) + " of " + std::to_string(count),
             "The briefing and the list below name them all");
  for (std::ptrdiff_t n = first; n < end; ++n) {
    const ExerciseModel::Stage& stage = model.stages[static_cast<std::size_t>(n)];
    ui::wrapped_text(stage.live ? color::kText : color::kTextQuiet,
                     (stage.done ? "Done: " : "") + stage.title);
    if (!stage.live) continue;
    ui::wrapped_text(color::kTextQuiet, stage.instruction);
    std::string left;
    for (std::size_t i = 0; i < std::min<std::size_t>(8, model.left.size()); ++i)
      left += (left.empty() ? "" : ", ") + model.left[i];
    if (model.goals > 1)
      ui::wrapped_text(color::kAccent, std::to_string(model.goals - model.left.size()) + " of " +
                                           std::to_string(model.goals) + ". Left: " + left);
  }
}

// What the user says is wrong with the patient.
void draw_asked(const PanelContext& c) {
  const ExerciseModel& model = c.model.exercise;
  if (model.asked.empty()) return;
  ImGui::Separator();
  ui::text(color::kTextQuiet, "What do you find?");
  for (const ExerciseModel::Asked& asked : model.asked) {
    ui::wrapped_text(color::kText, asked.title);
    ImGui::PushID(asked.name.c_str());
    if (ImGui::BeginCombo("##stated", asked.stated.empty() ? "not stated" : asked.stated.c_str())) {
      const auto choice = [&](const std::string& grade) {
        if (ImGui::Selectable(grade.c_str(), grade == asked.stated))
          c.requests.exercise.state = {asked.name, grade};
      };
      choice("none");
      for (const std::string& grade : asked.grades) choice(grade);
      ImGui::EndCombo();
    }
    ImGui::PopID();
  }
}

void draw_ghost_switch(const PanelContext& c) {
  const GhostModel& ghost = c.model.exercise.ghost;
  if (!ghost.allowed) return;
  bool on = ghost.on;
  if (ui::switch_row("Expert beside me", &on,
                     "Shows an expert's instruments, seen through, at the step that comes next for "
                     "you. They touch nothing."))
    c.requests.exercise.ghost = true;
  if (!ghost.on) return;
  if (!ghost.problem.empty())
    ui::wrapped_text(color::kTextQuiet, ghost.problem);
  else if (ghost.preparing)
    ui::wrapped_text(
        color::kTextQuiet,
        "The expert plays it in the background. Of a long exercise that takes minutes.");
  else if (ghost.strength <= 0)
    ui::wrapped_text(color::kTextQuiet, "Not shown: your results say that you can do without.");
}

void draw_guide_switch(const PanelContext& c) {
  const GhostModel& ghost = c.model.exercise.ghost;
  if (!ghost.allowed || !ghost.can_guide) return;
  bool on = ghost.guides;
  if (ui::switch_row("Lead my hand", &on,
                     "The device pulls your hand weakly towards the expert's path, at most 0.8 N. "
                     "The result says so, and the attempt does not count for the learning curve."))
    c.requests.exercise.guide = true;
  if (!ghost.guides) return;
  if (ghost.strength <= 0)
    ui::wrapped_text(color::kTextQuiet, "Not led: your results say that you can do without.");
}

bool is_anew(const ExerciseModel::Stage& stage) { return stage.anew; }

bool can_return(const ExerciseModel& model) {
  return std::any_of(model.stages.begin(), model.stages.end(),
                     [](const auto& stage) { return !stage.restore_title.empty(); });
}

void draw_return(const PanelContext& c) {
  const ExerciseModel& model = c.model.exercise;
  if (!can_return(model)) return;
  const bool chooses = ImGui::BeginCombo("##return", "Go to the start of ...");
  ui::tooltip("What was done since is undone; errors still count");
  if (!chooses) return;
  for (const bool anew : {false, true}) {
    if (anew && std::any_of(model.stages.begin(), model.stages.end(), is_anew))
      ImGui::TextDisabled("Begin anew there");
    for (std::size_t i = 0; i < model.stages.size(); ++i)
      if (const auto& stage = model.stages[i]; stage.anew == anew && !stage.restore_title.empty()) {
        if (ImGui::Selectable(stage.restore_title.c_str())) c.requests.exercise.return_to = i;
        if (anew)
          ui::tooltip("This attempt ends; the expert does what comes before, which takes minutes");
      }
  }
  ImGui::EndCombo();
}

class ExerciseStyle {
 public:
  explicit ExerciseStyle(const PanelContext& c) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(14), c.px(12)});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, color::kPanel);
    ImGui::PushStyleColor(ImGuiCol_ChildBg, 0);
  }
  ~ExerciseStyle() {
    ImGui::PopStyleColor(2);
    ImGui::PopStyleVar();
  }
  ExerciseStyle(const ExerciseStyle&) = delete;
  ExerciseStyle& operator=(const ExerciseStyle&) = delete;
};

float end_card() {
  const float height = ImGui::GetWindowHeight();
  ImGui::PopItemWidth();
  ImGui::End();
  return height;
}

void draw_made_errors(const PanelContext& c) {
  const ExerciseModel& model = c.model.exercise;
  if (model.faults.empty()) return;
  ImGui::Separator();
  const std::size_t shown = std::min<std::size_t>(3, model.faults.size());
  for (std::size_t i = model.faults.size() - shown; i < model.faults.size(); ++i)
    ui::wrapped_text(color::kAmber,
                     ui::clock_time(model.faults[i].at_s, false) + "  " + model.faults[i].title +
                         (model.faults[i].where.empty() ? "" : ", " + model.faults[i].where));
}

void draw_told(const ExerciseModel& model) {
  for (const ExerciseModel::Told& told : model.told)
    ui::stat(told.name.c_str(), told.value, told.meaning.c_str());
}

void draw_scrolled_part(const PanelContext& c) {
  const ExerciseModel& model = c.model.exercise;
  draw_live_stage(c);
  if (!model.cue.empty()) ui::wrapped_text(color::kText, "Hint: " + model.cue);
  // What one works with comes before what one reads, which may scroll; but a hand that holds the
  // mouse cannot scroll to the few lines that change while it works.
  constexpr std::size_t kFew = 3;
  const bool few = model.told.size() <= kFew;
  if (few) draw_told(model);
  draw_exercise_knee(c);
  if (c.model.views.water) ImGui::Separator();
  draw_water_section(c);
  draw_made_errors(c);
  if (!few) draw_told(model);
  draw_asked(c);
  if (!model.ghost.allowed) return;
  ImGui::Separator();
  draw_ghost_switch(c);
  draw_guide_switch(c);
}

void draw_card_buttons(const PanelContext& c) {
  const ExerciseModel& model = c.model.exercise;
  if (ImGui::Button(model.paused ? "Resume (P)" : "Pause (P)", {-1, 0}))
    c.requests.exercise.pause = true;
  ImGui::BeginDisabled(!model.has_cue || !model.cue.empty());
  if (ImGui::Button("Hint (I)")) c.requests.exercise.hint = true;
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (ImGui::Button("Back (U)")) c.requests.exercise.undo = true;
  ui::tooltip(
      "To the start of the stage or the last mark. Errors still count, and the report says how "
      "often you went back.");
  ImGui::SameLine();
  if (ImGui::Button("End (J)")) c.requests.exercise.end = true;
  ui::tooltip("Ends the attempt and judges it");
  draw_return(c);
}

// Beside the scene while the exercise goes on. Its height.
float draw_running(const PanelContext& c) {
  const ExerciseModel& model = c.model.exercise;
  const UiRect& r = c.layout.picture;
  const UiRect at = c.model.panels_open
                        ? c.layout.left
                        : UiRect{r.x + c.px(8), r.y + c.px(8), c.px(kExerciseCard), r.h - c.px(16)};
  const float most = c.model.panels_open ? at.h - c.px(kLeastCaseCard) : at.h;
  ImGui::SetNextWindowPos({at.x, at.y});
  ImGui::SetNextWindowSizeConstraints({at.w, 0}, {at.w, most});
  ImGui::Begin("##running", nullptr, kExerciseWindow | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PushItemWidth(-1);
  strong(c, model.title);
  if (model.page == ExercisePage::kJudging) {
    ui::wrapped_text(color::kTextQuiet, "Replaying and judging your attempt ...");
    ImGui::ProgressBar(static_cast<float>(model.judged), {-1, c.px(6)}, "");
    return end_card();
  }
  ui::stat("Time",
           ui::clock_time(model.elapsed_s, false) + " of " + ui::clock_time(model.limit_s, false),
           "The attempt ends at the limit");
  if (model.paused)
    ui::wrapped_text(color::kAmber,
                     "Paused: the time has stopped, the force is off, nothing counts.");
  ImGui::Separator();
  // What does not fit scrolls; the buttons below it stay in sight.
  const float below = ImGui::GetFrameHeightWithSpacing() * (can_return(model) ? 3.0f : 2.0f);
  float* const needed = ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID("needed"), c.px(200));
  const float room = most - ImGui::GetCursorPosY() - below - ImGui::GetStyle().WindowPadding.y;
  ImGui::BeginChild("scrolled", {0, std::max(c.px(64), std::min(*needed, room))});
  ImGui::PushItemWidth(-1);
  draw_scrolled_part(c);
  ImGui::PopItemWidth();
  *needed = ImGui::GetCursorPosY();
  ImGui::EndChild();
  draw_card_buttons(c);
  return end_card();
}

}  // namespace

// The room below it is the left card's.
void draw_exercise_card(const PanelContext& c, UiLayout& layout) {
  const ExercisePage page = c.model.exercise.page;
  if (page != ExercisePage::kRunning && page != ExercisePage::kJudging) return;
  const ExerciseStyle style(c);
  const float used = draw_running(c) + c.px(8);
  if (!c.model.panels_open) return;
  layout.left.y += used;
  layout.left.h = std::max(1.0f, layout.left.h - used);
}

void draw_exercise(const PanelContext& c) {
  const ExercisePage page = c.model.exercise.page;
  if (page == ExercisePage::kClosed || page == ExercisePage::kRunning ||
      page == ExercisePage::kJudging)
    return;
  const ExerciseStyle style(c);
  draw_dialog(c);
}

}  // namespace osteon
