#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "ui/label.h"
#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

struct Measure {
  std::string label;  ///< "Radial inclination"
  const char* unit;   ///< with the space before it, where one belongs there
};

// "radial_inclination_deg": the unit is the end of the name.
Measure measure_of(std::string name) {
  const char* unit = "";
  const auto cut = [&](const std::string& ending, const char* shown_as) {
    if (!name.ends_with(ending)) return;
    name.resize(name.size() - ending.size());
    unit = shown_as;
  };
  cut("_deg", "\xc2\xb0");
  cut("_mm", " mm");
  cut("_percent", " %");
  return {label_of(name), unit};
}

std::string with_unit(double value, const char* unit) {
  char text[48];
  std::snprintf(text, sizeof text, "%.1f%s", value, unit);
  return text;
}

auto find_set(PatientOrder& order, const std::string& name) {
  return std::find_if(order.set.begin(), order.set.end(),
                      [&](const ParameterValue& value) { return value.first == name; });
}

// Two buttons of which one is on; true when the other was pressed.
bool either(const PanelContext& c, const char* first, const char* second, bool second_on) {
  const float w = (ImGui::GetContentRegionAvail().x - c.px(4)) / 2;
  const bool to_first = ui::toggle_button(first, !second_on, {w, 0}) && second_on;
  ImGui::SameLine(0, c.px(4));
  const bool to_second = ui::toggle_button(second, second_on, {w, 0}) && !second_on;
  return to_first || to_second;
}

void draw_whose(const PanelContext& c, PatientOrder& order, bool& changed) {
  if (either(c, "Wrist", "Knee", order.anatomy == "knee")) {
    order.anatomy = order.anatomy == "knee" ? "wrist" : "knee";
    changed = true;
  }
  if (either(c, "Right", "Left", order.side == "left")) {
    order.side = order.side == "left" ? "right" : "left";
    changed = true;
  }
}

void draw_seed(const PanelContext& c, PatientOrder& order, bool& changed) {
  bool random = order.seed.has_value();
  if (ui::switch_row("Drawn at random", &random,
                     "Draws every measure that you have not set from the range among people. The "
                     "same number gives the same patient.")) {
    order.seed = random ? std::optional<std::uint64_t>(1) : std::nullopt;
    changed = true;
  }
  if (!order.seed) return;
  ImGui::AlignTextToFramePadding();
  ui::text(color::kTextQuiet, "Number");
  ImGui::SameLine(c.px(96));
  ImGui::SetNextItemWidth(c.px(128));
  changed |= ImGui::InputScalar("##seed", ImGuiDataType_U64, &*order.seed);
  ImGui::SameLine(0, c.px(8));
  if (ImGui::Button("Another")) {
    ++*order.seed;
    changed = true;
  }
}

void draw_parameter(const VariationParameter& p, PatientOrder& order, bool& changed) {
  const Measure measure = measure_of(p.name);
  const auto at = find_set(order, p.name);
  const bool set = at != order.set.end();
  double value = set ? at->second : p.built_in;
  const bool differs = p.sd > 0;  // else it is a pose, which is never drawn
  const std::string shown =
      set || !order.seed || !differs ? with_unit(value, measure.unit) : "drawn";
  const std::string people =
      differs ? with_unit(p.mean, "") + " \xc2\xb1 " + with_unit(p.sd, measure.unit) : "a pose";
  const std::string explanation =
      p.meaning + ". " + (differs ? "People: " + people + " (" + p.source + "); f" : "F") + "rom " +
      with_unit(p.min, "") + " to " + with_unit(p.max, measure.unit);
  ImGui::PushID(p.name.c_str());
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  // The format is the text itself: a drawn value has no number yet.
  std::string format = shown;
  if (const auto percent = format.find('%'); percent != std::string::npos)
    format.insert(percent, "%");
  if (ui::slider(measure.label.c_str(), &value, p.min, p.max, format.c_str(),
                 explanation.c_str())) {
    const double rounded = std::clamp(std::round(value * 10) / 10, p.min, p.max);
    if (set)
      at->second = rounded;
    else
      order.set.emplace_back(p.name, rounded);
    changed = true;
  }
  ImGui::TableNextColumn();
  ui::text(color::kTextQuiet, people.c_str());
  ui::tooltip(differs ? "Mean and standard deviation among people" : "Not drawn at random");
  ImGui::BeginDisabled(!set);
  if (ImGui::SmallButton("Reset")) {
    order.set.erase(at);
    changed = true;
  }
  ImGui::EndDisabled();
  ImGui::PopID();
}

void draw_parameters(const PanelContext& c, PatientOrder& order, bool& changed) {
  if (!ui::section(c.fonts, "Measures")) return;
  if (!ImGui::BeginTable("measures", 2)) return;
  ImGui::TableSetupColumn("slider", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("people", ImGuiTableColumnFlags_WidthFixed, c.px(112));
  for (const VariationParameter& p : c.model.patient.parameters) draw_parameter(p, order, changed);
  ImGui::EndTable();
}

void draw_finding_choice(const AnatomyFinding& finding, PatientOrder& order, bool& changed) {
  const auto at =
      std::find_if(order.findings.begin(), order.findings.end(),
                   [&](const FindingChoice& chosen) { return chosen.finding == finding.name; });
  const bool has = at != order.findings.end();
  ImGui::PushID(finding.name.c_str());
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ui::text_within(color::kText, measure_of(finding.name).label, ImGui::GetContentRegionAvail().x);
  std::string meaning = finding.meaning;
  for (const FindingGrade& grade : finding.grades)
    meaning += "\n" + grade.name + ": " + grade.meaning;
  ui::tooltip(meaning.c_str());
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##grade", has ? at->grade.c_str() : "none")) {
    std::string chosen = has ? at->grade : "";
    if (ImGui::Selectable("none", !has)) chosen.clear();
    for (const FindingGrade& grade : finding.grades) {
      if (ImGui::Selectable(grade.name.c_str(), has && at->grade == grade.name))
        chosen = grade.name;
      ui::tooltip(grade.meaning.c_str());
    }
    if (chosen != (has ? at->grade : "")) {
      if (has) order.findings.erase(at);
      if (!chosen.empty()) order.findings.push_back({finding.name, chosen});
      changed = true;
    }
    ImGui::EndCombo();
  }
  ImGui::PopID();
}

void draw_finding_choices(const PanelContext& c, PatientOrder& order, bool& changed) {
  if (!ui::section(c.fonts, "Findings")) return;
  if (!ImGui::BeginTable("findings", 2)) return;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("grade", ImGuiTableColumnFlags_WidthFixed, c.px(160));
  for (const AnatomyFinding& finding : c.model.patient.findings)
    draw_finding_choice(finding, order, changed);
  ImGui::EndTable();
}

void draw_form(const PanelContext& c) {
  PatientOrder order = c.model.patient.order;
  bool changed = false;
  draw_whose(c, order, changed);
  draw_seed(c, order, changed);
  const float footer = 2.6f * ImGui::GetFrameHeightWithSpacing();
  ImGui::BeginChild("form", {0, std::max(c.px(48), ImGui::GetContentRegionAvail().y - footer)});
  draw_parameters(c, order, changed);
  draw_finding_choices(c, order, changed);
  ImGui::EndChild();
  if (changed) c.requests.patient.order = std::move(order);
}

void draw_patient_state(const PanelContext& c) {
  const PatientModel& patient = c.model.patient;
  if (patient.making) {
    ImGui::ProgressBar(static_cast<float>(patient.fraction), {-1, c.px(6)}, "");
    return;
  }
  if (patient.problem.empty())
    ui::text_within(color::kTextQuiet, "Saved as a new case, then opened.",
                    ImGui::GetContentRegionAvail().x);
  else
    ui::text_within(color::kAmber, patient.problem, ImGui::GetContentRegionAvail().x);
}

void draw_patient_buttons(const PanelContext& c) {
  const float w = (ImGui::GetContentRegionAvail().x - c.px(8)) / 2;
  if (c.model.patient.making) {
    if (ImGui::Button("Stop", {w, 0})) c.requests.patient.stop = true;
  } else if (ui::accent_button("Make and open", {w, 0})) {
    c.requests.patient.make = true;
  }
  ImGui::SameLine(0, c.px(8));
  if (ImGui::Button("Close  (N)", {w, 0})) c.requests.patient.toggle = true;
}

}  // namespace

void draw_patient(const PanelContext& c) {
  const UiRect& r = c.layout.picture;
  const float w = std::min(c.px(440), r.w - c.px(16)), h = r.h - c.px(16);
  ImGui::SetNextWindowPos({r.x + r.w / 2, r.y + r.h / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({w, h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(16), c.px(12)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, color::kPanel);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, 0);
  ImGui::Begin(
      "##patient", nullptr,
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  {
    const ui::WithFont strong(c.fonts.strong);
    ImGui::TextUnformatted("New patient");
  }
  ImGui::BeginDisabled(c.model.patient.making);
  draw_form(c);
  ImGui::EndDisabled();
  draw_patient_state(c);
  draw_patient_buttons(c);
  ImGui::End();
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar();
}

}  // namespace osteon
