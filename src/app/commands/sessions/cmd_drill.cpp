#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include "commands/support/parser.h"

#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "osteon/base/file.h"
#include "osteon/carve/drill_trial.h"
#include "osteon/carve/rbf_force.h"

namespace osteon {
namespace {

struct TrialCommand {
  double thrust_n = 40, drop_n = 0, diameter_mm = 3.2, speed_rpm = 1000, pilot_mm = 0;
  double bluntness = 0;
  std::vector<std::string> layers{"cortical_bone=4", "cancellous_bone=20", "cortical_bone=4"};
  bool water = false, json = false;
};

Result<std::vector<DrillLayer>> parse_layers(const std::vector<std::string>& texts) {
  std::vector<DrillLayer> layers;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    char* end = nullptr;
    const double mm =
        equals == std::string::npos ? NAN : std::strtod(text.c_str() + equals + 1, &end);
    if (!std::isfinite(mm) || *end != '\0')
      return fail("is not a layer: '" + text + "'", "--layer",
                  "Write it as material=mm, such as cortical_bone=4");
    layers.push_back({text.substr(0, equals), mm / 1000});
  }
  return layers;
}

nlohmann::ordered_json trial_json(const DrillTrial& t) {
  nlohmann::ordered_json out;
  out["through"] = t.through;
  out["plunge_mm"] = 1000 * t.plunge_m;
  out["seconds"] = t.samples.empty() ? 0 : t.samples.back().time_s;
  out["hottest_c"] = t.hottest_c;
  out["necrosis_47c_60s_mm3"] = 1e9 * t.necrosis_m3[0];
  out["necrosis_50c_30s_mm3"] = 1e9 * t.necrosis_m3[1];
  out["samples"] = nlohmann::ordered_json::array();
  for (const DrillSample& s : t.samples)
    out["samples"].push_back({{"t_s", s.time_s},
                              {"tip_mm", 1000 * s.tip_m},
                              {"removed_mm", 1000 * s.removed_m},
                              {"resistance_n", s.resistance_n},
                              {"torque_nmm", 1000 * s.torque_nm},
                              {"feed_mm_per_rev", 1000 * s.feed_m_per_rev},
                              {"hottest_c", s.hottest_c}});
  return out;
}

int run_trial(const TrialCommand& command) {
  const auto data = find_data_dir();
  if (!data) return report_error(data.error());
  const auto table = load_drill_table(*data / "assets/materials/drilling.toml");
  if (!table) return report_error(table.error());
  const auto layers = parse_layers(command.layers);
  if (!layers) return report_error(layers.error());
  DrillTool tool{command.diameter_mm / 1000, command.speed_rpm / 60, command.bluntness,
                 command.pilot_mm / 1000};
  DrillHand hand;
  hand.thrust_n = command.thrust_n;
  hand.drop_n = command.drop_n;
  DrillTrialOptions options;
  options.heat = true;
  options.water = command.water;
  const auto trial = run_drill_trial(*table, *layers, tool, hand, options);
  if (!trial) return report_error(trial.error());
  if (command.json) {
    std::printf("%s\n", trial_json(*trial).dump(1).c_str());
  } else if (trial->through) {
    std::printf(
        "through in %.1f s, plunge %.1f mm, hottest %.1f C beside the hole, dead bone "
        "%.1f mm3 (47 C, 60 s), %.1f mm3 (50 C, 30 s)\n",
        trial->samples.back().time_s, 1000 * trial->plunge_m, trial->hottest_c,
        1e9 * trial->necrosis_m3[0], 1e9 * trial->necrosis_m3[1]);
  } else {
    std::printf("not through: %.2f mm removed, hottest %.1f C beside the hole\n",
                1000 * trial->samples.back().removed_m, trial->hottest_c);
  }
  return trial->through ? kExitDone : kExitNo;
}

/// A hand on a spring presses a drill along a guided tunnel; both rules answer.
struct Trace {
  std::vector<double> drill_m, force_n;
};

template <class Rule>
Trace trace(Rule rule) {
  constexpr double kTick_s = 1e-3, kMass_kg = 0.2, kStiff = 400, kDamp = 8, kSpeed = 0.01;
  Trace out;
  double x = 0, v = 0;
  for (int tick = 0; tick < 5000; ++tick) {
    const double wants = kSpeed * tick * kTick_s;
    const double force = rule(x);
    v += (kStiff * (wants - x) - kDamp * v - force) / kMass_kg * kTick_s;
    x += v * kTick_s;
    out.drill_m.push_back(x);
    out.force_n.push_back(force);
  }
  return out;
}

std::string polyline(const Trace& t, double top, double height, double most_n,
                     const std::string& colour) {
  std::string out =
      "<polyline fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"0.8\" points=\"";
  char text[64];
  for (std::size_t i = 0; i < t.force_n.size(); i += 2) {
    std::snprintf(text, sizeof text, "%.2f,%.2f ", 60 + 0.13 * static_cast<double>(i),
                  top + height - height * t.force_n[i] / most_n);
    out += text;
  }
  return out + "\"/>\n";
}

std::string force_panel(const Trace& t, double top, const std::string& name,
                        const std::string& colour) {
  char frame[512];
  std::snprintf(frame, sizeof frame,
                "<rect x=\"60\" y=\"%.0f\" width=\"650\" height=\"120\" fill=\"none\" "
                "stroke=\"#888\"/>\n<text x=\"66\" y=\"%.0f\">%s</text>\n<text x=\"20\" "
                "y=\"%.0f\">6 N</text>\n<text x=\"20\" y=\"%.0f\">0</text>\n",
                top, top - 6, name.c_str(), top + 10, top + 120);
  return frame + polyline(t, top, 120, 6, colour);
}

int run_resistance(const std::string& out) {
  const GuidedTunnel tunnel;
  NaiveDrillState naive;
  RbfDrillState rbf;
  const Trace a = trace([&](double x) { return naive_drill_force(naive, tunnel, x); });
  const Trace b = trace([&](double x) { return rbf_drill_force(rbf, tunnel, x); });
  const std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"740\" height=\"360\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"740\" height=\"360\" "
      "fill=\"white\"/>\n" +
      force_panel(a, 30, "Force of the plain rule (equation 2)", "#b03030") +
      force_panel(b, 190, "Force of the sum of radial functions (equations 3, 4)", "#2050a0") +
      "<text x=\"60\" y=\"335\">0 s</text>\n<text x=\"690\" y=\"335\">5 s</text>\n</svg>\n";
  if (const auto saved = write_file_atomic(out, svg); !saved) return report_error(saved.error());
  const auto steps = [](const Trace& t) {
    int count = 0;
    for (std::size_t i = 1; i < t.force_n.size(); ++i)
      count += std::abs(t.force_n[i] - t.force_n[i - 1]) > 1 ? 1 : 0;
    return count;
  };
  std::printf("steps of more than 1 N in 5 s: plain rule %d, radial functions %d -> %s\n", steps(a),
              steps(b), out.c_str());
  return kExitDone;
}

}  // namespace

void add_drill_commands(cli::App& app, int& exit_code) {
  cli::App* group = app.add_subcommand("drill", "Simulate a drill in bone");
  group->require_subcommand(1);
  auto command = std::make_shared<TrialCommand>();
  cli::App* trial = group->add_subcommand(
      "trial", "Drill through layers with an emulated hand; exits 1 when it does not get through");
  trial->add_option("--thrust-n", command->thrust_n, "thrust of the hand, N")
      ->capture_default_str();
  trial->add_option("--drop-n", command->drop_n, "reduction of the thrust in the last layer, N")
      ->capture_default_str();
  trial->add_option("--diameter", command->diameter_mm, "diameter of the drill, mm")
      ->capture_default_str();
  trial->add_option("--speed-rpm", command->speed_rpm, "speed, rpm; negative: backwards")
      ->capture_default_str();
  trial->add_option("--pilot", command->pilot_mm, "diameter of a pilot hole, mm; 0: none")
      ->capture_default_str();
  trial->add_option("--bluntness", command->bluntness, "wear of the drill, from 0 (new) to 1")
      ->capture_default_str();
  trial
      ->add_option("--layer", command->layers,
                   "material=thickness in mm, from the surface inwards; may be given several times")
      ->capture_default_str();
  trial->add_flag("--water", command->water, "irrigate the hole");
  trial->add_flag("--json", command->json, "print JSON with samples");
  trial->callback([command, &exit_code] { exit_code = run_trial(*command); });
  auto out = std::make_shared<std::string>();
  cli::App* resistance = group->add_subcommand(
      "resistance", "Draw the resistance of a guided tunnel by vKASS's two rules");
  resistance->add_option("--out", *out, "the SVG file to write")->required();
  resistance->callback([out, &exit_code] { exit_code = run_resistance(*out); });
}

}  // namespace osteon
