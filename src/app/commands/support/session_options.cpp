#include "commands/support/session_options.h"

#include <sstream>

#include "commands/support/parser.h"
#include "osteon/image/tissue.h"
#include "runs/hands/tray.h"

namespace osteon {

void SessionOptions::add_to(cli::App& command) {
  command.add_option("--seed", settings.seed,
                     "stored in the recording; nothing in a session is random yet");
  command
      .add_option("--stiffness", settings.haptic.stiffness_n_per_m,
                  "stiffness of the virtual coupling, N/m")
      ->check(cli::Range(50.0, 5000.0))
      ->capture_default_str();
  command
      .add_option("--friction", settings.haptic.friction_scale,
                  "factor on the friction of every material")
      ->check(cli::Range(0.0, 5.0))
      ->capture_default_str();
  command.add_option("--max-force", settings.haptic.max_force_n, "force limit of the device, N")
      ->check(cli::Range(0.0, 40.0))
      ->capture_default_str();
  command.add_flag("--free-bones", free_bones, "bones move on springs instead of being held");
  add_portals_option(command, portals);
  add_soft_option(command, soft);
  add_guided_option(command, settings.carve.guided_n);
  add_irrigation_option(command, settings.carve.irrigation_ml_per_min);
  command.add_option("--hand-mass", hand.mass_kg, "mass of the virtual hand, kg")
      ->check(cli::Range(0.02, 2.0))
      ->capture_default_str();
  command
      .add_option("--hand-stiffness", hand.grip_stiffness_n_per_m,
                  "stiffness of the virtual hand's grip, N/m")
      ->check(cli::Range(10.0, 5000.0))
      ->capture_default_str();
}

Result<SessionSettings> SessionOptions::resolved() const {
  SessionSettings out = settings;
  out.physics.hold_bones = !free_bones;
  out.soft = softs_named(soft);
  if (auto done = open_in_skin(portals, out); !done) return tl::unexpected(done.error());
  return out;
}

void add_portals_option(cli::App& command, std::string& portals) {
  command
      .add_option("--portals", portals,
                  "holes in the skin that shafts pass through: all, none, or some of those that "
                  "`osteon case info` lists, such as 3-4,4-5")
      ->capture_default_str();
}

void add_soft_option(cli::App& command, std::string& soft) {
  command.add_option("--soft", soft,
                     "soft parts that are felt: ligaments, menisci, tfcc and skin (all that the "
                     "case has), or some of them: acl,pcl,mcl,lcl,medial_meniscus,"
                     "lateral_meniscus,scapholunate_dorsal,skin:portal_al; default: none");
}

void add_guided_option(cli::App& command, double& guided_n) {
  command
      .add_option("--guided-force", guided_n,
                  "resistance to a drill that a pin or an aimer's sleeve guides, N, the same in "
                  "all bone; 0: the resistance of the bone itself")
      ->check(cli::Range(0.0, 40.0))
      ->capture_default_str();
}

void add_structures_option(cli::App& command, bool& structures) {
  command.add_flag("--structures", structures,
                   "open the case with its soft parts, and record when a tip goes into one");
}

void add_irrigation_option(cli::App& command, double& irrigation_ml_per_min) {
  command
      .add_option("--irrigation", irrigation_ml_per_min,
                  "water over the bone that is cut, ml/min; it cools the bone, in the report and "
                  "in pictures of its temperature. A joint that a pump fills is rinsed as well")
      ->check(cli::Range(0.0, 2000.0))
      ->capture_default_str();
}

std::vector<std::string> portals_named(const std::string& text) {
  std::vector<std::string> names;
  if (text == "none") return names;
  std::istringstream parts(text);
  for (std::string name; std::getline(parts, name, ',');) names.push_back(name);
  return names;
}

Result<void> open_in_skin(const std::string& portals, SessionSettings& settings) {
  settings.portals = portals_named(portals);
  const auto tissues = load_default_tissues();
  if (!tissues) return tl::unexpected(tissues.error());
  if (const Tissue* skin = tissues->find("skin")) settings.portal_skin = portal_skin(*skin);
  return {};
}

}  // namespace osteon
