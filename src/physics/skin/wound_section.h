#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "osteon/collide/round_box.h"
#include "osteon/physics/skin_setup.h"
#include "osteon/tissue/sheet_lips.h"

namespace osteon {

/// Where a tool passes the plane of the skin: as discs in the sheet's plane, a broad blade as a row
/// of them.
struct WoundSection {
  std::uint32_t part = 0;
  double along = 0;          ///< of a rod, 0 to 1
  Vec3 core = Vec3::Zero();  ///< of a box, in its axes
  Vec3 middle_S = Vec3::Zero();
  double radius_m = 0;  ///< of the part's round edge
  std::uint32_t count = 0;
  std::array<LipDisc, 5> discs{};
};

/// Of the parts that pass it the broadest. None where the tool is above the skin, or lies on it.
std::optional<WoundSection> wound_section(const SkinPatch& patch, std::span<const RoundBox> parts,
                                          const Pose& X_ST, std::uint32_t hand);

}  // namespace osteon
