#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "ui/panel_ground.h"
#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

// A live run shows at least this much, so that the first touches do not jump about.
constexpr double kLeastShownS = 30;

struct Lane {
  ImVec2 lo, hi;
  double end_s;
  float x(double time_s) const {
    return lo.x + (hi.x - lo.x) * static_cast<float>(std::clamp(time_s / end_s, 0.0, 1.0));
  }
};

// Bones in the order of their first touch: each gets a line of its own.
std::vector<BoneId> touched_bones(std::span<const ContactSpan> spans) {
  std::vector<BoneId> order;
  for (const ContactSpan& span : spans)
    if (std::find(order.begin(), order.end(), span.bone) == order.end()) order.push_back(span.bone);
  return order;
}

void draw_ruler(const PanelContext& c, const Lane& lane) {
  static constexpr std::array<double, 8> kSteps = {1, 5, 10, 30, 60, 300, 600, 3600};
  const double pixels_per_s = static_cast<double>(lane.hi.x - lane.lo.x) / lane.end_s;
  double step = kSteps.back();
  for (const double s : kSteps)
    if (s * pixels_per_s >= static_cast<double>(c.px(72))) {
      step = s;
      break;
    }
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ui::WithFont small(c.fonts.small);
  for (double t = 0; t <= lane.end_s; t += step) {
    const float x = std::round(lane.x(t));
    draw->AddLine({x, lane.lo.y}, {x, lane.hi.y}, IM_COL32(255, 255, 255, 16));
    if (t > 0 && x < lane.hi.x - c.px(24))
      draw->AddText({x + 3, lane.hi.y + 1}, color::kTextQuiet, ui::clock_time(t, false).c_str());
  }
}

void explain_span(const PanelContext& c, const ContactSpan& span) {
  const bool known = span.bone.index < c.model.bone_labels.size();
  const std::string name = known ? c.model.bone_labels[span.bone.index] : "Bone";
  const std::string text = name + "\ntouched from " + ui::clock_time(span.start_s) + " to " +
                           ui::clock_time(span.end_s) + ", peak " +
                           ui::number(static_cast<double>(span.peak_force_n), 2) + " N";
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(text.c_str());
  ImGui::EndTooltip();
}

// Beside the first touch of each bone, where its line is high enough to be read.
void draw_span_names(const PanelContext& c, const Lane& lane, const std::vector<BoneId>& order,
                     float line_h) {
  const ui::WithFont small(c.fonts.small);
  if (line_h < 0.8f * ImGui::GetTextLineHeight()) return;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  for (std::size_t line = 0; line < order.size(); ++line) {
    if (order[line].index >= c.model.bone_labels.size()) continue;
    const std::string& name = c.model.bone_labels[order[line].index];
    const auto first = std::find_if(c.model.timeline.spans.begin(), c.model.timeline.spans.end(),
                                    [&](const ContactSpan& s) { return s.bone == order[line]; });
    const float width = ImGui::CalcTextSize(name.c_str()).x;
    const float x = std::min(lane.x(first->start_s) + c.px(4), lane.hi.x - width);
    const float y =
        lane.lo.y + line_h * (static_cast<float>(line) + 0.5f) - 0.5f * ImGui::GetTextLineHeight();
    draw->AddText({x + 1, y + 1}, IM_COL32(0, 0, 0, 0xc0), name.c_str());
    draw->AddText({x, y}, color::kText, name.c_str());
  }
}

// Small signs along the upper edge; a square stands for what was harmful.
void draw_marks(const PanelContext& c, const Lane& lane, bool hovered) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const TimelineMark* under = nullptr;
  const float a = c.px(3);
  for (const TimelineMark& mark : c.model.timeline.marks) {
    const float x = lane.x(mark.time_s), y = lane.lo.y + a;
    if (mark.harm)
      draw->AddRectFilled({x - a, y - a}, {x + a, y + a}, color::kAmber);
    else
      draw->AddCircleFilled({x, y}, a, color::kAccent, 12);
    if (std::abs(mouse.x - x) <= a + 1 && mouse.y < lane.lo.y + 4 * a) under = &mark;
  }
  if (!hovered || !under) return;
  ImGui::BeginTooltip();
  ImGui::TextUnformatted((ui::clock_time(under->time_s) + "  " + under->text).c_str());
  ImGui::EndTooltip();
}

void draw_spans(const PanelContext& c, const Lane& lane, bool hovered) {
  const std::vector<BoneId> order = touched_bones(c.model.timeline.spans);
  if (order.empty()) return;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float line_h =
      (lane.hi.y - lane.lo.y) / static_cast<float>(std::max<std::size_t>(3, order.size()));
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ContactSpan* under = nullptr;
  for (const ContactSpan& span : c.model.timeline.spans) {
    const auto line = std::find(order.begin(), order.end(), span.bone) - order.begin();
    const float y = lane.lo.y + line_h * static_cast<float>(line);
    const float x0 = lane.x(span.start_s);
    const float x1 = std::max(lane.x(span.end_s), x0 + 2);
    draw->AddRectFilled({x0, y + 0.5f}, {x1, y + line_h - 0.5f}, ui::bone_color(span.bone.index),
                        1);
    if (mouse.x >= x0 - 2 && mouse.x <= x1 + 2 && mouse.y >= y && mouse.y < y + line_h)
      under = &span;
  }
  draw_span_names(c, lane, order, line_h);
  if (hovered && under) explain_span(c, *under);
}

void draw_cursor(const PanelContext& c, const Lane& lane) {
  const double t = c.model.replay.on ? c.model.replay.position_s : c.model.timeline.end_s;
  const float x = std::round(lane.x(t));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float a = c.px(4);
  draw->AddLine({x, lane.lo.y}, {x, lane.hi.y}, color::kAccent, 1.5f);
  draw->AddTriangleFilled({x - a, lane.lo.y - a}, {x + a, lane.lo.y - a}, {x, lane.lo.y + 1},
                          color::kAccent);
}

void draw_lane(const PanelContext& c, float x0, float x1) {
  const UiRect& r = c.layout.bottom;
  Lane lane{{x0, r.y + c.px(9)}, {x1, r.bottom() - c.px(16)}, 1};
  lane.end_s = c.model.replay.on ? std::max(0.1, c.model.replay.duration_s)
                                 : std::max(kLeastShownS, c.model.timeline.end_s);
  ImGui::SetCursorScreenPos({lane.lo.x, r.y});
  ImGui::InvisibleButton("lane", {std::max(1.0f, lane.hi.x - lane.lo.x), r.h});
  const bool hovered = ImGui::IsItemHovered();
  if (c.model.replay.on && ImGui::IsItemActive()) {
    const double share = static_cast<double>((ImGui::GetIO().MousePos.x - lane.lo.x) /
                                             std::max(1.0f, lane.hi.x - lane.lo.x));
    c.requests.seek_s = std::clamp(share, 0.0, 1.0) * lane.end_s;
  }
  ImGui::GetWindowDrawList()->AddRectFilled(lane.lo, lane.hi, color::kGround, 3);
  draw_ruler(c, lane);
  draw_spans(c, lane, hovered);
  draw_marks(c, lane, hovered);
  draw_cursor(c, lane);
}

// Draws the sign for play or pause over the button that was just made.
void draw_play_sign(const PanelContext& c, bool playing) {
  const ImVec2 lo = ImGui::GetItemRectMin();
  const ImVec2 hi = ImGui::GetItemRectMax();
  const ImVec2 m{0.5f * (lo.x + hi.x), 0.5f * (lo.y + hi.y)};
  const float a = c.px(5);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (!playing) {
    draw->AddTriangleFilled({m.x - a * 0.8f, m.y - a}, {m.x + a, m.y}, {m.x - a * 0.8f, m.y + a},
                            color::kText);
    return;
  }
  draw->AddRectFilled({m.x - a, m.y - a}, {m.x - a * 0.25f, m.y + a}, color::kText);
  draw->AddRectFilled({m.x + a * 0.25f, m.y - a}, {m.x + a, m.y + a}, color::kText);
}

void draw_speed_menu(const PanelContext& c) {
  static constexpr std::array<double, 7> kSpeeds = {0.1, 0.25, 0.5, 1, 1.5, 2, 4};
  const auto label = [](double v) {
    std::string text = ui::number(v, 2);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text + "x";
  };
  ImGui::SetNextItemWidth(c.px(72));
  if (ImGui::BeginCombo("##speed", label(c.model.replay.speed).c_str())) {
    for (const double speed : kSpeeds)
      if (ImGui::Selectable(label(speed).c_str(), speed == c.model.replay.speed))
        c.requests.speed = speed;
    ImGui::EndCombo();
  }
  ui::tooltip("Speed of the replay, multiple of real time; 0.1 to 4 ( , slower   . faster )");
}

float draw_transport(const PanelContext& c) {
  const UiRect& r = c.layout.bottom;
  ImGui::SetCursorScreenPos({r.x + c.px(16), r.y + 0.5f * (r.h - ImGui::GetFrameHeight())});
  if (ImGui::Button("##play", {c.px(32), 0})) c.requests.toggle_play = true;
  draw_play_sign(c, c.model.replay.playing);
  ui::tooltip(c.model.replay.playing ? "Pause (P)" : "Play (P)");
  ImGui::SameLine();
  draw_speed_menu(c);
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  const std::string at =
      ui::clock_time(c.model.replay.position_s) + " / " + ui::clock_time(c.model.replay.duration_s);
  ImGui::TextUnformatted(at.c_str());
  ui::tooltip("Moment shown and length of the recording, minutes and seconds");
  return ImGui::GetItemRectMax().x + c.px(16);
}

float draw_live_label(const PanelContext& c) {
  const UiRect& r = c.layout.bottom;
  ImGui::SetCursorScreenPos({r.x + c.px(16), r.y + 0.5f * (r.h - ImGui::GetTextLineHeight())});
  ui::text(color::kTextQuiet, "Contacts");
  ui::tooltip("When each bone was touched in this run; one colour and one line per bone");
  return r.x + c.px(96);
}

}  // namespace

void draw_timeline(const PanelContext& c) {
  const UiRect& r = c.layout.bottom;
  ImGui::SetNextWindowPos({r.x, r.y});
  ImGui::SetNextWindowSize({r.w, r.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  begin_panel("##timeline", kBarPanel);
  ImGui::PopStyleVar(3);
  const float x0 = c.model.replay.on ? draw_transport(c) : draw_live_label(c);
  draw_lane(c, x0, r.right() - c.px(16));
  ImGui::End();
}

}  // namespace osteon
