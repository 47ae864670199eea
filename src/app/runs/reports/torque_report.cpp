#include "runs/reports/torque_report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "osteon/scene/tool_moment.h"

namespace osteon {

nlohmann::ordered_json to_json(const TorqueReport& report) {
  return {
      {"peak_nm", report.peak_nm}, {"peak_at_s", report.peak_at_s}, {"mean_nm", report.mean_nm}};
}

std::string to_text(const TorqueReport& report) {
  if (!(report.peak_nm > 0)) return {};
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(),
                "torque         at the grip: peak %.4f N m (at %.3f s), mean %.4f N m\n",
                report.peak_nm, report.peak_at_s, report.mean_nm);
  return text.data();
}

TorqueWatch::TorqueWatch(Tray tray, std::vector<Portal> portals, std::size_t hands)
    : tray_(std::move(tray)), portals_(std::move(portals)), hands_(hands) {}

bool TorqueWatch::has_levers() const {
  return std::any_of(tray_.begin(), tray_.end(),
                     [](const auto& tool) { return tool->shaft.radius > 0; });
}

Vec3 TorqueWatch::moment_W(const ToolState& tool) const {
  if (tool.instrument >= tray_.size()) return Vec3::Zero();
  return moment_at_grip(tool, *tray_[tool.instrument], portals_);
}

void TorqueWatch::see(std::size_t hand, const ToolState& tool) {
  if (hand >= hands_.size()) return;
  const double size = moment_W(tool).norm();
  if (!(size > 0)) return;
  Tally& tally = hands_[hand];
  ++tally.ticks;
  tally.sum_nm += size;
  if (size <= tally.peak_nm) return;
  tally.peak_nm = size;
  tally.peak_at_s = tool.time_s;
}

std::vector<TorqueReport> TorqueWatch::finish() const {
  std::vector<TorqueReport> reports;
  for (const Tally& tally : hands_)
    reports.push_back({tally.peak_nm, tally.peak_at_s,
                       tally.ticks > 0 ? tally.sum_nm / static_cast<double>(tally.ticks) : 0});
  return reports;
}

std::string with_torque(const std::string& reports_json, std::span<const TorqueReport> torques,
                        std::span<const std::string> names) {
  if (torques.empty()) return reports_json;
  auto json = nlohmann::ordered_json::parse(reports_json);
  if (names.empty()) json["torque"] = to_json(torques.front());
  for (std::size_t h = 0; h < std::min(torques.size(), names.size()); ++h)
    json["hands"][names[h]]["torque"] = to_json(torques[h]);
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace osteon
