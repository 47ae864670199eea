#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "osteon/procedure/path_metrics.h"

namespace osteon {
namespace {

using MetricsJson = nlohmann::ordered_json;

MetricsJson value_of(const std::optional<double>& value) {
  return value ? MetricsJson(*value) : MetricsJson(nullptr);
}

MetricsJson metrics_object(const PathMetrics& m) {
  return {{"elapsed_s", m.elapsed_s},
          {"path_mm", m.path_mm},
          {"time_in_tissue_s", value_of(m.time_in_tissue_s)},
          {"path_in_tissue_mm", value_of(m.path_in_tissue_mm)},
          {"tissue_damage_mm2", value_of(m.tissue_damage_mm2)},
          {"speed_mm_s", m.speed_mm_s},
          {"smoothness", value_of(m.smoothness)},
          {"sparc", value_of(m.sparc)},
          {"ldlj", value_of(m.ldlj)},
          {"depth_mm", m.depth_mm},
          {"rotation_deg", m.rotation_deg},
          {"inefficiency_percent", value_of(m.inefficiency_percent)},
          {"translational_actions", m.translational_actions},
          {"rotational_actions", m.rotational_actions}};
}

std::string number_text(const MetricsJson& value) {
  if (value.is_null()) return "-";
  if (value.is_number_integer()) return std::to_string(value.get<int>());
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, value.get<double>(),
                                 std::chars_format::fixed, 3)
                       .ptr;
  return std::string(digits, end);
}

}  // namespace

std::string to_json(const PathMetrics& metrics) { return metrics_object(metrics).dump(2) + "\n"; }

std::string to_text(const PathMetrics& metrics) {
  std::string text;
  const MetricsJson object = metrics_object(metrics);
  for (const auto& [key, value] : object.items()) {
    const std::string number = number_text(value);
    text += key + std::string(24 - key.size(), ' ') +
            std::string(std::max<std::size_t>(14, number.size()) - number.size(), ' ') + number +
            "\n";
  }
  return text;
}

}  // namespace osteon
