#include "commands/sessions/stability_map.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace osteon {
namespace {

constexpr double kLongestDelay_s = 0.003, kSoftest = 500, kStiffest = 10000;
constexpr double kWide = 300, kHigh = 240, kLeft = 62, kTop = 44, kRight = 16, kBottom = 46;

template <class... Args>
std::string format(const char* pattern, Args... args) {
  char out[256];
  std::snprintf(out, sizeof out, pattern, args...);
  return out;
}

bool swings(const WallOutcome& o) {
  return o.cause != ForceOff::kNone || (!o.settled() && o.swing_m > 0.8 * o.earlier_swing_m);
}

// Pale green while it settles, paler to grey where the stiffness had to be lowered; amber to red by
// how far it swings (0.2 to 20 mm).
std::string color_of(const WallOutcome& o) {
  if (swings(o)) {
    const double size = o.cause != ForceOff::kNone ? 0.02 : o.swing_m;
    const double t = std::clamp(std::log10(size / 0.0002) / 2, 0.0, 1.0);
    return format("rgb(%.0f,%.0f,%.0f)", 240 - 50 * t, 180 - 140 * t, 70 - 20 * t);
  }
  const double t = 1 - o.passivity.stiffness_share;
  return format("rgb(%.0f,%.0f,%.0f)", 180 + 30 * t, 224 - 14 * t, 186 + 30 * t);
}

double y_of(double wall) {
  const double t = std::log(wall / kSoftest) / std::log(kStiffest / kSoftest);
  return kHigh * (1 - t);
}

std::string text_at(double x, double y, const std::string& text, const char* anchor = "middle") {
  return format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor) + text +
         "</text>\n";
}

std::string cells(const StabilityMap& map) {
  const double w = kWide / static_cast<double>(map.delays_s.size());
  const double h = kHigh / static_cast<double>(map.walls_n_per_m.size());
  std::string out;
  for (std::size_t r = 0; r < map.walls_n_per_m.size(); ++r)
    for (std::size_t c = 0; c < map.delays_s.size(); ++c)
      out += format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.2f\" height=\"%.2f\" fill=\"",
                    static_cast<double>(c) * w, kHigh - static_cast<double>(r + 1) * h, w + 0.1,
                    h + 0.1) +
             color_of(map.outcomes[r * map.delays_s.size() + c]) + "\"/>\n";
  return out;
}

// Colgate and Brown's bound with the delay on top: K = b / (T / 2 + delay).
std::string bound(const StabilityMap& map) {
  std::string points;
  for (int i = 0; i <= 60; ++i) {
    const double delay = kLongestDelay_s * i / 60;
    const double wall = map.damping_n_s_per_m / (0.5 * map.tick_s + delay);
    if (wall >= kSoftest && wall <= kStiffest)
      points += format("%.1f,%.1f ", kWide * delay / kLongestDelay_s, y_of(wall));
  }
  return "<polyline points=\"" + points +
         "\" fill=\"none\" stroke=\"#223\" stroke-dasharray=\"5 3\" shape-rendering=\"auto\"/>\n";
}

std::string axes(const StabilityMap& map) {
  std::string out = format("<rect width=\"%.0f\" height=\"%.0f\" fill=\"none\" stroke=\"#223\"/>\n",
                           kWide, kHigh);
  for (const double wall : {500.0, 1000.0, 2000.0, 5000.0, 10000.0})
    out += text_at(-6, y_of(wall) + 4, format("%g", wall * 1e-3), "end");
  for (const int ms : {0, 1, 2, 3}) out += text_at(kWide * ms / 3, kHigh + 16, format("%d", ms));
  out += text_at(kWide / 2, kHigh + 34, "delay of the force, ms");
  out += format("<text transform=\"translate(-40 %.0f) rotate(-90)\" text-anchor=\"middle\">",
                kHigh / 2) +
         "wall, N/mm</text>\n";
  out += text_at(kWide / 2, -24, map.title);
  return out + text_at(kWide / 2, -8,
                       format("oscillates in %d of %zu", map.swinging(), map.outcomes.size()));
}

}  // namespace

int StabilityMap::swinging() const {
  return static_cast<int>(std::count_if(outcomes.begin(), outcomes.end(), swings));
}

StabilityMap map_stability(const HandParams& hand, LoopGuard guard, int columns, int rows) {
  DeviceInfo info;
  info.peak_force_n = 8;
  info.continuous_force_n = 8;
  SafetyParams params;
  params.passivity.lower_stiffness = guard == LoopGuard::kAll;
  StabilityMap map;
  map.damping_n_s_per_m = hand.grip_damping_n_s_per_m;
  // Centres of the cells.
  for (int c = 0; c < columns; ++c) map.delays_s.push_back(kLongestDelay_s * (c + 0.5) / columns);
  for (int r = 0; r < rows; ++r)
    map.walls_n_per_m.push_back(kSoftest * std::pow(kStiffest / kSoftest, (r + 0.5) / rows));
  for (const double wall : map.walls_n_per_m)
    for (const double delay : map.delays_s) {
      WallTrial trial;
      trial.hand = hand;
      trial.wall_n_per_m = wall;
      trial.delay_s = delay;
      trial.filtered = guard != LoopGuard::kNone;
      map.outcomes.push_back(press_wall(trial, info, params));
    }
  return map;
}

std::string to_svg(const std::vector<StabilityMap>& maps, std::size_t across) {
  const double w = kLeft + kWide + kRight, h = kTop + kHigh + kBottom;
  const std::size_t down = (maps.size() + across - 1) / std::max<std::size_t>(1, across);
  const double width = w * static_cast<double>(across), height = h * static_cast<double>(down);
  std::string out = format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
      "font-family=\"sans-serif\" font-size=\"12\" fill=\"#223\" "
      "shape-rendering=\"crispEdges\">\n",
      width, height + 24);
  out += "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  for (std::size_t i = 0; i < maps.size(); ++i) {
    out += format("<g transform=\"translate(%.0f %.0f)\">\n",
                  kLeft + w * static_cast<double>(i % across),
                  kTop + h * static_cast<double>(i / across));
    out += cells(maps[i]) + bound(maps[i]) + axes(maps[i]) + "</g>\n";
  }
  out += text_at(width / 2, height + 10,
                 "green: settles; greyer: with its stiffness lowered; amber to red: oscillates, "
                 "0.2 to 20 mm; dashed: K = b / (T / 2 + delay)");
  return out + "</svg>\n";
}

}  // namespace osteon
