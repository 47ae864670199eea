// Bands that are cut, or stretched until they tear.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "osteon/physics/band_strands.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/soft_events.h"
#include "skin/skin_world.h"
#include "soft/soft_grips.h"
#include "soft/solid_cutting.h"
#include "soft/solid_presses.h"

namespace osteon {
namespace {

constexpr double kTold = 10;  // events of strands: with each tenth of them

}  // namespace

// Of a band the place goes with the bone whose end is nearer.
void SoftWorld::wound(std::size_t b, const Vec3& p_W, double area_m2) {
  const SoftBand& band = setup_->bands[b];
  if (openings_.size() < openings_.capacity())
    openings_.push_back({band.soft, share_of(b, p_W) < 0.5 ? band.from : band.to, p_W, area_m2});
}

// Both ends of what is in two now, `share` of a band's section.
void SoftWorld::wound_ends(std::size_t b, double share) {
  const double radius_m = setup_->bands[b].radius_m;
  wound(b, spans_[b].a_W + state_.bands[b].torn_share * (spans_[b].b_W - spans_[b].a_W),
        share * 2 * std::numbers::pi * radius_m * radius_m);
}

// In two: as of one that is torn, nothing of it is felt after that.
bool SoftWorld::cut(std::size_t b, std::span<const Hand> hands) {
  for (const Hand& hand : hands) {
    if (!hand.cuts[b]) continue;
    if (setup_->by_strands) {
      lose_strand(b, strand_under(state_.bands[b].gone, sections_[b], hand.edge_W[b]), hand, true);
      return true;
    }
    state_.bands[b].torn = true;
    state_.bands[b].torn_share = share_of(b, hand.p_W[b]);
    tell(hand, kSoftCut, b, {hand.force_n[b], readouts_[b].tension_n, 0});
    return true;
  }
  return false;
}

// The place is the mean of those where its strands went.
void SoftWorld::lose_strand(std::size_t b, int strand, const Hand& by, bool by_edge) {
  BandState& band = state_.bands[b];
  const double left_before = strands_left(band.gone);
  band.gone |= std::uint64_t{1} << strand;
  const double left = strands_left(band.gone), here = by.tool ? share_of(b, by.p_W[b]) : 0.5;
  const int lost = std::popcount(band.gone);
  if (lost == 1)
    band.torn_share = here;
  else if (by_edge)
    band.torn_share += (here - band.torn_share) / lost;
  band.torn = lost == kStrands;
  wound_ends(b, 1.0 / kStrands);
  const double force_n = by.tool ? by.force_n[b] : 0, tension_n = readouts_[b].tension_n;
  if (band.torn && by_edge)
    tell(by, kSoftCut, b, {force_n, tension_n, 0});
  else if (band.torn)
    tell(by, kSoftTorn, b, {tension_n, force_n, 0});
  else if (std::floor(kTold * left) < std::floor(kTold * left_before))
    tell(by, by_edge ? kSoftStrandsCut : kSoftStrandsTorn, b, {100 * left, force_n, tension_n});
}

// A punch takes the strands that lead through what it bites. A band that another hand holds aside
// is bitten only where its straight way is.
void SoftWorld::bite_bands(Hand& hand) {
  const SolidCutter& with = *setup_->biters[hand.tool->instrument];
  const Pose X_TW = hand.tool->X_WP.inverse();
  for (std::size_t b = 0; b < setup_->bands.size(); ++b) {
    for (int strand = 0; strand < kStrands && is_felt(b); ++strand) {
      if ((state_.bands[b].gone >> strand & 1) != 0) continue;
      const Vec3 off = off_strand(setup_->bands[b], strand, sections_[b]);
      const Vec3 from_T = X_TW * Vec3(spans_[b].a_W + off), to_T = X_TW * Vec3(spans_[b].b_W + off);
      for (const CutterPart& part : with.cutter.parts) {
        const auto in = inside_of(part.planes, from_T, to_T);
        if (!(in[0] < in[1])) continue;
        hand.p_W[b] = hand.tool->X_WP * Vec3(from_T + 0.5 * (in[0] + in[1]) * (to_T - from_T));
        lose_strand(b, strand, hand, true);
        break;
      }
    }
  }
}

// What is left bears its share of the failure load. One strand tears in a step: those that are left
// are stretched as much, and the next one follows if that is too much for it.
void SoftWorld::tear_when_overloaded(std::size_t b, const Hand& by, double force_n) {
  const SoftBand& band = setup_->bands[b];
  const double tension_n = readouts_[b].tension_n;
  if (setup_->by_strands) {
    const std::uint64_t gone = state_.bands[b].gone;
    const int weakest = weakest_strand(gone);
    const double holds_n = band.failure_n * band.left * strands_left(gone);
    if (tension_n > holds_n * strand_strength(weakest)) lose_strand(b, weakest, by, false);
  } else if (tension_n > band.failure_n) {
    state_.bands[b].torn = true;
    state_.bands[b].torn_share = by.tool ? share_of(b, by.p_W[b]) : 0.5;
    tell(by, kSoftTorn, b, {tension_n, force_n, 0});
  }
}

// Who pulls most tears it; where no hand pulls, the bones do.
void SoftWorld::tear(std::span<const Hand> hands) {
  for (std::size_t b = 0; b < setup_->bands.size(); ++b) {
    if (!is_felt(b)) continue;
    const SoftBand& band = setup_->bands[b];
    double length = (spans_[b].b_W - spans_[b].a_W).norm() + band.over_m;
    for (const SoftHandState& hand : state_.hands)
      for (std::uint32_t i = 0; i < hand.count; ++i)
        if (hand.near[i].contact.band == b) length += hand.near[i].taken_m;
    length += taken_by_grips(state_, b);
    BandReadout& readout = readouts_[b];
    readout.tension_n = tension_at(band, length, strands_left(state_.bands[b].gone));
    std::size_t most = hands.size();
    for (const Hand& hand : hands) {
      const SoftHold& hold = state_.grips[hand.index].hold;
      if (hold.of == SoftHold::Of::kBand && hold.part == b)
        readout.tension_n = std::max(readout.tension_n, hand.leg_n);
      readout.force_n[hand.index] = hand.force_n[b];
      if (hand.force_n[b] > (most < hands.size() ? hands[most].force_n[b] : 0)) most = hand.index;
    }
    const Hand by = most < hands.size() ? hands[most] : Hand{};
    const double force_n = most < hands.size() ? by.force_n[b] : 0;
    if (!std::isfinite(readout.tension_n) || !std::isfinite(force_n)) {
      state_.bands[b].lost = true;
      tell(by, kSoftLost, b, {});
    } else if (!cut(b, hands)) {  // a blade is sooner than tearing
      tear_when_overloaded(b, by, force_n);
    }
    if (state_.bands[b].torn && !setup_->by_strands) wound_ends(b, 1);
    if (!is_felt(b)) readout = {};
  }
}

}  // namespace osteon
