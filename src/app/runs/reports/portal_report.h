#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "osteon/base/result.h"
#include "osteon/procedure/portal_watch.h"
#include "osteon/scene/case.h"

namespace osteon {

/// Portals that were made in skin, by their landmarks, and whose they are; docs/acl.md names the
/// keys.
nlohmann::ordered_json made_portals_json(std::span<const MadePortalFound> found,
                                         const Case& the_case, const std::string& case_spec);
/// Where the portals of a case are, or were made beside their landmarks: lengths in mm, World, the
/// case at rest.
nlohmann::ordered_json portals_json(const Case& the_case,
                                    std::span<const MadePortalFound> found = {});
/// Puts both into the report of an attempt: portals that were made as `portals`, and where those of
/// a knee with tunnels are as `acl.portals`.
void add_portals(std::span<const MadePortalFound> found, const Case& the_case,
                 const std::string& case_spec, nlohmann::ordered_json& report);
std::string portals_text(std::span<const MadePortalFound> found, const Case& the_case);

/// Both portals of a knee, as a run that made them reports it.
struct ReportedPortals {
  std::string patient;                             ///< patient_of the case
  std::map<std::string, MadePortalFound> portals;  ///< by landmark: portal_al and portal_am
};
/// Fails, saying what is missing, on a text that is no such report.
Result<ReportedPortals> read_portals(const std::string& json_text, const std::string& where);

/// Whose knee a case is, whatever is torn, felt or bent in it: "builtin:knee:3:left". A folder
/// stands for itself.
std::string patient_of(const std::string& case_spec);

}  // namespace osteon
