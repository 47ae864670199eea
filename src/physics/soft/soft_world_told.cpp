// What clears bands, and what is told of all that is soft.
#include <algorithm>
#include <cmath>

#include "osteon/physics/band_strands.h"
#include "osteon/physics/soft_world.h"
#include "skin/skin_world.h"
#include "soft/solid_cutting.h"

namespace osteon {
namespace {

static_assert(kMaxSoftLosses == kMaxBands + kMaxSolids);
constexpr double kToldMm3 = 1e9;

}  // namespace

// Symbols: v, how fast the instrument goes through tissue at its power; 2 r, how thick the band is.
// It takes all strands in 2 r / v: one in so many steps.
bool SoftWorld::clears_now(const Hand& hand, const BandContact& contact) const {
  const ToolState& tool = *hand.tool;
  if (!setup_->clearers_part || !(tool.power > 0) || tool.instrument >= setup_->biters.size())
    return false;
  const auto& with = setup_->biters[tool.instrument];
  if (!with || with->way != SolidCutter::Way::kClear || !(with->works >> contact.part & 1))
    return false;
  const Vec3 nhat_T = tool.X_WP.q.conjugate() * contact.nhat_W;
  if (!with->face_T.isZero() && !(with->face_T.dot(nhat_T) < 0)) return false;
  const double through_s =
      2 * setup_->bands[contact.band].radius_m / (with->speed_m_per_s * std::min(tool.power, 1.0));
  const double steps = std::clamp(through_s / (kStrands * step_s_), 1.0, 1e6);
  return step_ % static_cast<std::uint64_t>(std::lround(steps)) == 0;
}

SoftTold SoftWorld::told() const {
  SoftTold out;
  out.cleared_percent = all_cleared_percent();
  const auto touch = [&](std::size_t hand, std::uint32_t soft, double force_n) {
    if (force_n > out.touches[hand].force_n) out.touches[hand] = {soft, force_n};
  };
  for (std::size_t b = 0; b < setup_->bands.size(); ++b) {
    const SoftBand& band = setup_->bands[b];
    const double gone = state_.bands[b].torn ? 1 : 1 - strands_left(state_.bands[b].gone);
    if (gone > 0) out.losses[out.loss_count++] = {band.soft, 0, 100 * gone};
    for (std::size_t h = 0; h < kMaxHands; ++h) touch(h, band.soft, readouts_[b].force_n[h]);
  }
  for (std::size_t s = 0; s < setup_->solids.size(); ++s) {
    const SoftSolid& solid = setup_->solids[s];
    const double gone_m3 = cutting_ && !solid.to_clear ? cutting_->gone_m3(s) : 0;
    if (gone_m3 > 0) out.losses[out.loss_count++] = {solid.soft, kToldMm3 * gone_m3, 0};
    for (std::size_t h = 0; h < kMaxHands; ++h) touch(h, solid.soft, solid_readouts_[s].force_n[h]);
  }
  if (skins_) out.skin = skins_->opening();
  return out;
}

}  // namespace osteon
