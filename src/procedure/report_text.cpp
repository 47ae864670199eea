#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "hex.h"
#include "osteon/procedure/report.h"

namespace osteon {
namespace {

// Decimal point whatever the locale; padded on the left to `width`.
std::string fixed(double value, int decimals, std::size_t width = 0) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  std::string result(text.data());
  std::replace(result.begin(), result.end(), ',', '.');
  return result.size() < width ? std::string(width - result.size(), ' ') + result : result;
}

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

std::size_t name_width(const Report& report) {
  std::size_t width = 4;
  for (const BoneReport& bone : report.bones)
    if (bone.touched()) width = std::max(width, bone.name.size());
  return width;
}

std::string bone_table(const Report& report) {
  const std::size_t width = name_width(report);
  std::string text = padded("bone", width) + "  first s  contact s  peak N  mean N  deepest mm\n";
  for (const BoneReport& bone : report.bones) {
    if (!bone.touched()) continue;
    text += padded(bone.name, width) + fixed(bone.first_contact_s, 3, 9) +
            fixed(bone.contact_time_s, 3, 11) + fixed(bone.peak_force_n, 2, 8) +
            fixed(bone.mean_force_n, 2, 8) + fixed(bone.deepest_mm, 3, 12) + "\n";
  }
  return text;
}

std::string untouched_line(const Report& report) {
  std::string names;
  for (const BoneReport& bone : report.bones)
    if (!bone.touched()) names += (names.empty() ? "" : ", ") + bone.name;
  return names.empty() ? "" : "never touched: " + names + "\n";
}

// Those that were used alone.
std::string portal_line(const Report& report) {
  std::string text;
  for (const PortalReport& portal : report.portals) {
    if (portal.times_entered == 0) continue;
    text += (text.empty() ? "portals        " : ", ") + portal.name + " " +
            fixed(portal.time_s, 3) + " s";
    if (portal.times_entered > 1) text += " in " + std::to_string(portal.times_entered) + " times";
  }
  return text.empty() ? text : text + "\n";
}

std::string times(double p50, double p99, double p999, double max) {
  return "p50 " + fixed(p50, 1) + ", p99 " + fixed(p99, 1) + ", p99.9 " + fixed(p999, 1) +
         ", max " + fixed(max, 1);
}

std::string timing_lines(const Report& report) {
  std::string text;
  if (report.tick_max_us > 0)
    text += "tick time us   " +
            times(report.tick_p50_us, report.tick_p99_us, report.tick_p999_us, report.tick_max_us) +
            "; missed ticks " + std::to_string(report.missed_ticks) + "\n";
  if (report.step_max_us > 0)
    text += "step time us   " +
            times(report.step_p50_us, report.step_p99_us, report.step_p999_us, report.step_max_us) +
            " (physics)\n";
  if (report.realtime_factor > 0)
    text += "speed          " + fixed(report.realtime_factor, 1) + " times real time\n";
  return text;
}

}  // namespace

std::string to_text(const Report& report) {
  const bool any = std::any_of(report.bones.begin(), report.bones.end(),
                               [](const BoneReport& bone) { return bone.touched(); });
  return "case           " + report.case_name + " (" + hex16(report.case_hash) + ")\n" +
         "duration       " + fixed(report.duration_s, 3) + " s, " + std::to_string(report.ticks) +
         " ticks\n" + "path length    " + fixed(report.path_length_mm, 1) + " mm\n" +
         "smoothness     " + fixed(report.smoothness_sparc, 2) +
         " (spectral arc length; closer to 0 is smoother)\n" + portal_line(report) +
         timing_lines(report) + "state hash     " + hex16(report.state_hash) + "\n\n" +
         (any ? bone_table(report) : std::string("no bone was touched\n")) + untouched_line(report);
}

}  // namespace osteon
