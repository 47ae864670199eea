#pragma once

#include <cstdint>
#include <optional>

#include "osteon/scene/case.h"
#include "osteon/scene/state.h"

namespace osteon {

/// How a landmark has moved away from rest with its bone, in World: p_W at rest is now at the
/// pose times p_W. A landmark whose bone no joint moves, or that has none, stays: exactly.
Pose moved_from_rest(const Case& the_case, std::uint32_t landmark, const BoneSnapshot& bones);
/// Where it is now, World.
Vec3 place_now(const Case& the_case, std::uint32_t landmark, const BoneSnapshot& bones);

/// The meniscus that a landmark lies on, in Case::softs; none: it lies on none that the case shows.
std::optional<std::uint32_t> meniscus_under(const Case& the_case, std::uint32_t landmark);

/// The bones as a session begins: at rest, but for those of a joint that begins otherwise.
BoneSnapshot begun_bones(const Case& the_case);
/// The same case with its joint bent as a session begins: bones and landmarks. Its soft parts are
/// left out, and so are its joints.
Case as_it_begins(const Case& the_case);

}  // namespace osteon
