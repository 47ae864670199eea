#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "osteon/physics/acl_tunnels.h"

namespace osteon {

/// What is known of a reconstructed ligament.
struct AclReport {
  AclTunnels tunnels;
  std::optional<GraftOutcome> graft;  ///< none: a tunnel is missing
  /// Tunnels of an earlier reconstruction, as they were found; none: the knee had none.
  std::optional<AclTunnels> before = {};
  /// Bone between a tunnel that was drilled now and that bone's earlier one, below 0: it opens into
  /// it; none: one of both is missing.
  std::optional<double> femur_to_old_m = {}, tibia_to_old_m = {};
};

/// assets/tissue/knee_ligaments.toml.
Result<LigamentTable> shipped_ligaments();

/// Places of the tunnels, and with both of them what the knee does with a graft between.
Result<AclReport> make_acl_report(const CaseDef& def, const AclDrilling& drilling,
                                  const std::optional<GraftChoices>& choices = {});

/// docs/acl.md names the keys; lengths in mm, shares in percent.
nlohmann::ordered_json to_json(const AclReport& report);
std::string to_text(const AclReport& report);
/// An attempt's report as JSON with that as `acl`; as it is where nothing was asked.
std::string with_tunnels(const std::string& attempt_json, const std::optional<AclReport>& report,
                         const std::string& not_measured);

}  // namespace osteon
