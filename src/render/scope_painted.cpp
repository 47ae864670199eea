#include "scope_painted.h"

#include <algorithm>

namespace osteon {
namespace {

/// Less than a student can see: of a place, and of a turn (the sine of its half).
constexpr double kStill_m = 2e-6, kStill_turn = 2e-5;

bool looks_still(const Pose& a, const Pose& b) {
  return (a.p - b.p).norm() < kStill_m && (a.q.conjugate() * b.q).vec().norm() < kStill_turn;
}

bool looks_still(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Pose& p, const Pose& q) { return looks_still(p, q); });
}

}  // namespace

bool ScopePainted::still(const ScopePainted& b) const {
  return side_px == b.side_px && half_field_rad == b.half_field_rad && barrel == b.barrel &&
         instruments == b.instruments && ghosts == b.ghosts && version == b.version &&
         wall == b.wall && water == b.water && white == b.white && bits == b.bits &&
         looks_still(X_WC, b.X_WC) && looks_still(parts, b.parts) && looks_still(tools, b.tools);
}

}  // namespace osteon
