#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "osteon/tissue/rod.h"

namespace osteon {

/// A part of a rod, with what acts on it, as it moves on.
struct RodPart {
  Rod rod;
  RodSupports supports;  ///< with the grips of the whole, also of those that hold none of it
  RodState state;
};

/// Cuts a rod across at an inner node, which both parts then have, each with its own half of the
/// mass: length, mass and momentum stay, and of the elastic energy only the bending at the node is
/// lost. The axes in which the node was held are held of both parts; a force on it is shared by
/// mass. Where friction stuck it begins anew. The parts do not touch each other. None: there is no
/// such node, or it is an end.
std::optional<std::pair<RodPart, RodPart>> cut_rod(const Rod& rod, const RodSupports& supports,
                                                   const RodState& state, std::size_t node);

}  // namespace osteon
