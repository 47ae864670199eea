#include "commands/session_options.h"

#include "commands/parser.h"

namespace osteon {

void SessionOptions::add_to(cli::App& command) {
  command.add_option("--seed", settings.seed,
                     "recorded; for what is random in a session (nothing is, until now)");
  command.add_option("--stiffness", settings.haptic.stiffness_n_per_m, "virtual coupling, N/m")
      ->check(cli::Range(50.0, 5000.0))
      ->capture_default_str();
  command.add_option("--friction", settings.haptic.friction_scale, "factor on every friction")
      ->check(cli::Range(0.0, 5.0))
      ->capture_default_str();
  command.add_option("--max-force", settings.haptic.max_force_n, "the device's limit, N")
      ->check(cli::Range(0.0, 40.0))
      ->capture_default_str();
  command.add_flag("--free-bones", free_bones, "bones move on springs instead of being held");
  command.add_option("--hand-mass", hand.mass_kg, "virtual hand, kg")
      ->check(cli::Range(0.02, 2.0))
      ->capture_default_str();
  command.add_option("--hand-stiffness", hand.grip_stiffness_n_per_m, "virtual hand's grip, N/m")
      ->check(cli::Range(10.0, 5000.0))
      ->capture_default_str();
}

SessionSettings SessionOptions::resolved() const {
  SessionSettings out = settings;
  out.physics.hold_bones = !free_bones;
  return out;
}

}  // namespace osteon
