#pragma once

#include <nlohmann/json_fwd.hpp>

#include "runs/hands/hand_settings.h"

namespace osteon {

nlohmann::json to_json_value(const MappingMap& mappings);
nlohmann::json to_json_value(const PedalMap& pedals);
/// What is missing, of another type or out of range keeps its default; never fails.
MappingMap parse_mappings(const nlohmann::json& json);
PedalMap parse_pedals(const nlohmann::json& json);

}  // namespace osteon
