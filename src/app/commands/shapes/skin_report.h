#pragma once

#include <optional>
#include <string>

#include "osteon/tissue/skin_scene.h"

namespace osteon {

/// What was done to a piece of skin, as JSON; see docs/tissue.md. `X_WS`: of a piece on a case.
std::string skin_report_json(const SkinResult& result, const std::optional<Pose>& X_WS);
/// The same for a person.
std::string skin_report_text(const SkinResult& result, const std::optional<Pose>& X_WS);

}  // namespace osteon
