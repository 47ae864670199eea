#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

// The plot's top: the least of 1, 2, 4, 8 ... N that holds what is shown.
float plot_top_n(std::span<const float> values) {
  float top = 1;
  for (const float v : values)
    while (v > top && top < 1024) top *= 2;
  return top;
}

void draw_grid(ImDrawList* draw, ImVec2 lo, ImVec2 hi, float top_n) {
  for (int i = 1; i < 4; ++i) {
    const float y = lo.y + (hi.y - lo.y) * static_cast<float>(i) / 4;
    draw->AddLine({lo.x, y}, {hi.x, y}, IM_COL32(255, 255, 255, 14));
  }
  const std::string label = ui::number(static_cast<double>(top_n), 0) + " N";
  draw->AddText({lo.x + 5, lo.y + 2}, color::kTextQuiet, label.c_str());
}

// One point a pixel, the peak of its values: a short knock is never lost between two pixels.
std::vector<ImVec2> curve_points(ImVec2 lo, ImVec2 hi, std::span<const float> values, float top_n) {
  std::vector<ImVec2> points;
  const auto columns = static_cast<std::size_t>(std::max(0.0f, hi.x - lo.x));
  const std::size_t n = values.size();
  if (columns < 2 || n < 2) return points;
  for (std::size_t x = 0; x < columns; ++x) {
    const std::size_t a = n * x / columns;
    const std::size_t b = std::max(n * (x + 1) / columns, a + 1);
    const float peak = *std::max_element(values.begin() + static_cast<std::ptrdiff_t>(a),
                                         values.begin() + static_cast<std::ptrdiff_t>(b));
    points.emplace_back(lo.x + static_cast<float>(x) + 0.5f,
                        hi.y - 1.5f - (hi.y - lo.y - 3) * peak / top_n);
  }
  return points;
}

void draw_curve(ImDrawList* draw, ImVec2 lo, ImVec2 hi, std::span<const float> values,
                float top_n) {
  const std::vector<ImVec2> points = curve_points(lo, hi, values, top_n);
  for (const ImVec2& p : points)
    if (p.y < hi.y - 2)
      draw->AddRectFilled({p.x - 0.5f, p.y}, {p.x + 0.5f, hi.y}, IM_COL32(0x4f, 0xb8, 0xd8, 0x30));
  draw->AddPolyline(points.data(), static_cast<int>(points.size()), color::kAccent, 0, 1.5f);
}

void draw_plot(const PanelContext& c) {
  const ImVec2 size{ImGui::GetContentRegionAvail().x, c.px(72)};
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const ImVec2 hi{lo.x + size.x, lo.y + size.y};
  ImGui::InvisibleButton("force plot", size);
  ui::tooltip("Force on the hand over the last 8 seconds, newtons; each point is the peak of 4 ms");
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ui::WithFont small(c.fonts.small);
  draw->AddRectFilled(lo, hi, color::kGround, 4);
  const float top_n = plot_top_n(c.model.force_history);
  draw_curve(draw, lo, hi, c.model.force_history, top_n);
  draw_grid(draw, lo, hi, top_n);
}

void draw_number(const PanelContext& c) {
  const HandModel& hand = c.model.hand;
  const bool at_limit = hand.force_n >= 0.98 * hand.force_limit_n;
  ImGui::BeginGroup();
  {
    const ui::WithFont large(c.fonts.large);
    ui::text(at_limit ? color::kAmber : color::kText, ui::number(hand.force_n, 2).c_str());
  }
  // The unit stands on the figures' base line.
  const ImVec2 end = ImGui::GetItemRectMax();
  ImGui::GetWindowDrawList()->AddText({end.x + c.px(6), end.y - c.px(21)}, color::kTextQuiet,
                                      at_limit ? "N  at limit" : "N");
  ImGui::EndGroup();
  ui::tooltip(
      "Computed force of bone on the hand, newtons. The limit is the device's, or 8 N without "
      "motors.");
}

void draw_torque(const PanelContext& c) {
  const HandModel& hand = c.model.hand;
  if (!hand.has_lever) return;
  ui::stat("Torque", ui::number(1e3 * hand.torque_nm, 1) + " mN m",
           "Moment of all contacts about the instrument's grip, at the front of the handle, "
           "millinewton metres");
  if (c.model.replay.on || !hand.info.drives_rotation()) return;
  ui::stat("Torque given", ui::number(1e3 * hand.status.torque_at_hand_V.norm(), 1) + " mN m",
           "Torque that the device gives to the stylus, after its safety limits");
}

}  // namespace

void draw_force_section(const PanelContext& c) {
  draw_number(c);
  draw_torque(c);
  draw_plot(c);
}

}  // namespace osteon
