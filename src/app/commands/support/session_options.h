#pragma once

#include "osteon/device/virtual_hand.h"
#include "osteon/session/session.h"

namespace osteon::cli {
class App;
}

namespace osteon {

/// Options that every command with a session shares, with their defaults.
struct SessionOptions {
  SessionSettings settings;
  HandParams hand;
  bool free_bones = false;
  std::string portals = "all";
  std::string soft;

  void add_to(cli::App& command);
  /// Settings after parsing, with the tissue table's skin. Fails when that cannot be read.
  Result<SessionSettings> resolved() const;
};

/// "--portals": which holes in the skin are open, as `portals_named` reads it.
void add_portals_option(cli::App& command, std::string& portals);
/// "--soft": which soft parts are felt, as `softs_named` reads it.
void add_soft_option(cli::App& command, std::string& soft);
/// "--structures": the case is opened with its soft parts, so that events tell when a tip goes into
/// one.
void add_structures_option(cli::App& command, bool& structures);
/// "--irrigation": as CarveSettings::irrigation_ml_per_min.
void add_irrigation_option(cli::App& command, double& irrigation_ml_per_min);
/// "--guided-force": as CarveSettings::guided_n.
void add_guided_option(cli::App& command, double& guided_n);
/// "all", "none", or names or titles with commas between: "3-4,4-5".
std::vector<std::string> portals_named(const std::string& text);
/// Opens these portals, in the tissue table's skin.
Result<void> open_in_skin(const std::string& portals, SessionSettings& settings);

}  // namespace osteon
