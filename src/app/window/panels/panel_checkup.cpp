#include <algorithm>
#include <string>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

// A word beside the colour: the state does not hang on the colour alone.
struct Mark {
  const char* word;
  ImU32 ink;
};
Mark mark_of(FindingLevel level) {
  if (level == FindingLevel::kGood) return {"OK", color::kAccent};
  return level == FindingLevel::kNote ? Mark{"Note", color::kAmber} : Mark{"BAD", color::kRed};
}

void wrapped(ImU32 ink, const std::string& text) {
  ImGui::PushTextWrapPos(0);
  ui::text(ink, text.c_str());
  ImGui::PopTextWrapPos();
}

void draw_bar(const PanelContext& c, double fraction) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float w = ImGui::GetContentRegionAvail().x;
  const float share = static_cast<float>(std::clamp(fraction, 0.0, 1.0));
  ImGui::Dummy({w, c.px(6)});
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(lo, {lo.x + w, lo.y + c.px(4)}, color::kField, c.px(2));
  draw->AddRectFilled(lo, {lo.x + w * share, lo.y + c.px(4)}, color::kAccent, c.px(2));
}

void draw_verdict(const PanelContext& c) {
  const CheckupModel& checkup = c.model.checkup;
  const ui::WithFont strong(c.fonts.strong);
  if (checkup.running) {
    ImGui::TextUnformatted(checkup.doing.c_str());
    draw_bar(c, checkup.fraction);
  } else if (!checkup.verdict.empty()) {
    wrapped(mark_of(worst(checkup.findings)).ink, checkup.verdict);
  } else {
    wrapped(color::kAmber, checkup.not_now);
  }
}

void draw_finding(const Finding& finding) {
  const Mark mark = mark_of(finding.level);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ui::text(mark.ink, mark.word);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(finding.topic.c_str());
  ImGui::TableNextColumn();
  wrapped(color::kText, finding.text);
  if (!finding.todo.empty()) wrapped(color::kTextQuiet, finding.todo);
}

void draw_findings(const PanelContext& c) {
  if (!ImGui::BeginTable("findings", 3, ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("mark", ImGuiTableColumnFlags_WidthFixed, c.px(36));
  ImGui::TableSetupColumn("topic", ImGuiTableColumnFlags_WidthFixed, c.px(124));
  ImGui::TableSetupColumn("text", ImGuiTableColumnFlags_WidthStretch);
  for (const Finding& finding : c.model.checkup.findings) draw_finding(finding);
  ImGui::EndTable();
}

// The rule itself, for those who install it by hand or ask what it allows.
void draw_udev_rule(const PanelContext& c) {
  const UdevRule& udev = c.model.checkup.udev;
  if (udev.text.empty() || udev.installed) return;
  if (!ui::section(c.fonts, "udev rule: lets users other than root open the devices", false))
    return;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, color::kField);
  {
    const ui::WithFont small(c.fonts.small);
    ImGui::BeginChild("rule", {0, 7 * ImGui::GetTextLineHeightWithSpacing()}, true,
                      ImGuiWindowFlags_HorizontalScrollbar);
    ImGui::TextUnformatted(udev.text.c_str());
    ImGui::EndChild();
  }
  ImGui::PopStyleColor();
  if (ImGui::Button("Copy the rule")) c.requests.copy = udev.text;
  ui::tooltip("For /etc/udev/rules.d/70-osteon.rules");
  ImGui::SameLine();
  if (udev.may_install) {
    if (ui::accent_button("Install it")) c.requests.install_udev = true;
    ui::tooltip("Writes /etc/udev/rules.d/70-osteon.rules; then plug the device in again");
  } else {
    if (ImGui::Button("Copy the command that installs it"))
      c.requests.copy = "sudo osteon doctor --install-udev";
    ui::tooltip("sudo osteon doctor --install-udev: only root may write there");
  }
}

void draw_push_test(const PanelContext& c) {
  const CheckupModel& checkup = c.model.checkup;
  if (checkup.device.empty()) return;
  wrapped(color::kTextQuiet, "Force test: " + checkup.device +
                                 " pushes with at most 0.5 N along each driven axis for one "
                                 "second. Hold it loosely; Esc stops it at once.");
  if (ImGui::Button("Push gently")) c.requests.begin_push_test = true;
  ui::tooltip("I hold the device; it may push with 0.5 N");
}

void draw_buttons(const PanelContext& c) {
  const CheckupModel& checkup = c.model.checkup;
  if (checkup.running) {
    if (ImGui::Button("Stop  (Esc)")) c.requests.cancel_checkup = true;
    return;
  }
  ImGui::BeginDisabled(!checkup.not_now.empty());
  draw_push_test(c);
  ImGui::Separator();
  if (ImGui::Button("Check again")) c.requests.begin_checkup = true;
  ImGui::EndDisabled();
  if (!checkup.not_now.empty()) ui::tooltip(checkup.not_now.c_str());
  ImGui::SameLine();
  ImGui::BeginDisabled(checkup.findings.empty());
  if (ImGui::Button("Copy the list"))
    c.requests.copy = to_text(checkup.findings) + "\n" + checkup.verdict + "\n";
  ImGui::EndDisabled();
  ui::tooltip("As text, for support requests");
  ImGui::SameLine();
  if (ImGui::Button("Close  (F2)")) c.requests.toggle_checkup = true;
}

// Height that something took in the picture before; 0 before the first.
float& last_height(const char* what) {
  return *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID(what));
}

// As high as it is, or as the panel's greatest height leaves room for: then it scrolls, so that the
// verdict and the buttons stay in sight.
void draw_list(const PanelContext& c, float panel_h) {
  float& needed = last_height("list");
  const ImGuiStyle& style = ImGui::GetStyle();
  const float below = last_height("footer") + style.ItemSpacing.y + style.WindowPadding.y;
  const float room = std::max(c.px(48), panel_h - ImGui::GetCursorPosY() - below);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::BeginChild("list", {0, std::clamp(needed, 1.0f, room)});
  draw_findings(c);
  needed = ImGui::GetCursorPosY();
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

void draw_footer(const PanelContext& c) {
  ImGui::BeginGroup();
  if (!c.model.checkup.running) draw_udev_rule(c);
  draw_buttons(c);
  ImGui::EndGroup();
  last_height("footer") = ImGui::GetItemRectSize().y;
}

}  // namespace

void draw_checkup(const PanelContext& c) {
  const UiRect& r = c.layout.picture;
  const float w = std::min(c.px(640), r.w - c.px(16)), h = r.h - c.px(16);
  ImGui::SetNextWindowPos({r.x + r.w / 2, r.y + r.h / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({w, 0}, {w, h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(24), c.px(16)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, color::kPanel);
  ImGui::Begin("##checkup", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
  draw_verdict(c);
  ImGui::Dummy({0, c.px(2)});
  draw_list(c, h);
  draw_footer(c);
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
}

}  // namespace osteon
