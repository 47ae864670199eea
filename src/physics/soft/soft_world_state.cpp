// State of what is soft in a session: saved, checked, put back, hashed.
#include <algorithm>
#include <cmath>
#include <span>

#include "osteon/base/hash.h"
#include "osteon/physics/band_strands.h"
#include "osteon/physics/fallen_pieces.h"
#include "osteon/physics/soft_world.h"
#include "skin/skin_world.h"
#include "soft/soft_grips.h"
#include "soft/soft_touch.h"
#include "soft/solid_cutting.h"
#include "soft/solid_presses.h"

namespace osteon {
namespace {

// So many bands are hashed at least, felt or not: as recordings of before there was room for more.
constexpr std::size_t kHashedBands = 8;

void add_to(Hasher& h, const NearBand& near) {
  h.add(near.contact.band);
  h.add(near.contact.part);
  h.add(near.contact.nhat_W);
  h.add(near.contact.others_taken_m);
  h.add(near.touching);
  h.add(near.barred);
  h.add(near.behind);
  h.add(near.deep_m);
  h.add(near.taken_m);
  if (!near.contact.off_W.isZero(0)) h.add(near.contact.off_W);
}

void add_to(Hasher& h, const BandTouch& touch) {
  h.add(touch.on);
  h.add(touch.over);
  h.add(touch.first_step);
  h.add(touch.last_step);
  h.add(touch.peak_n);
  h.add(touch.deepest_m);
}

void add_to(Hasher& h, const SolidNear& near) {
  for (const std::uint32_t x : {near.contact.solid, near.contact.bone, near.contact.part}) h.add(x);
  for (const Vec3& v : {near.contact.p_B, near.contact.nhat_B, near.outside_B}) h.add(v);
  for (const double x : {near.contact.along, near.contact.stiffness_n_per_m, near.contact.others_m,
                         near.deep_m, near.force_n})
    h.add(x);
  if (near.entered_m > 0) h.add(near.entered_m);
  for (const bool x : {near.touching, near.barred, near.behind}) h.add(x);
}

void add_to(Hasher& h, const SoftGrip& grip) {
  h.add(grip.jaw_open);
  h.add(static_cast<std::uint8_t>(grip.hold.of));
  h.add(grip.hold.part);
  h.add(grip.hold.bone);
  for (const Vec3& v : {grip.hold.p_T, grip.hold.p_B, grip.against_B}) h.add(v);
  for (const double x : {grip.hold.share, grip.hold.others_taken_m, grip.hold.stiffness_n_per_m,
                         grip.force_n, grip.taken_m, grip.peak_n, grip.most_m})
    h.add(x);
  h.add(grip.first_step);
  if (!(grip.hold.most_n > 0)) return;
  h.add(grip.hold.most_n);
  h.add(grip.hold.nhat_B);
}

void add_solids_to(Hasher& h, const SoftState& state) {
  for (const bool lost : state.solid_lost) h.add(lost);
  for (const SolidHandState& hand : state.solid_hands) {
    h.add(hand.instrument);
    h.add(hand.count);
    for (std::uint32_t i = 0; i < hand.count; ++i) add_to(h, hand.near[i]);
    for (const BandTouch& touch : hand.touches) add_to(h, touch);
  }
}

}  // namespace

SoftState SoftWorld::save() const {
  SoftState out = state_;
  if (cutting_) out.cut = cutting_->save();
  if (skins_) out.skin = skins_->save();
  if (pieces_) out.pieces = std::make_shared<const FallenPiecesState>(pieces_->state());
  return out;
}

// A state from before solids could be cut has none.
void SoftWorld::restore_cuts(const SoftState& state) {
  state_.cut = nullptr;
  if (!cutting_) return;
  if (state.cut)
    cutting_->restore(*state.cut);
  else
    cutting_->clear();
}

std::uint64_t SoftWorld::hash() const {
  Hasher h;
  h.add(setup_->hash);
  const std::size_t bands = std::max(kHashedBands, setup_->bands.size());
  for (const BandState& band : std::span(state_.bands).first(bands)) {
    h.add(band.torn);
    h.add(band.lost);
    if (band.gone != 0) h.add(band.gone);
    if (band.torn || band.gone != 0) h.add(band.torn_share);
  }
  for (const SoftHandState& hand : state_.hands) {
    h.add(hand.instrument);
    h.add(hand.count);
    for (std::uint32_t i = 0; i < hand.count; ++i) add_to(h, hand.near[i]);
    for (const BandTouch& touch : std::span(hand.touches).first(bands)) add_to(h, touch);
  }
  for (const SoftGrip& grip : state_.grips)
    if (grip != SoftGrip{}) add_to(h, grip);
  if (solids_) add_solids_to(h, state_);
  if (cutting_) h.add(cutting_->hash());
  if (skins_) h.add(skins_->hash());
  if (pieces_ && !pieces_->empty()) h.add(pieces_->hash());
  return h.value();
}

bool SoftWorld::fits(const SoftState& state) const {
  if (!state.on || (state.cut && !(cutting_ && cutting_->fits(*state.cut)))) return false;
  if (state.skin && !(skins_ && skins_->fits(*state.skin, tray_))) return false;
  if (state.pieces && !fits_pieces(*state.pieces)) return false;
  for (const BandState& band : state.bands)
    if (!(band.torn_share >= 0 && band.torn_share <= 1) || band.gone > kAllStrands) return false;
  for (const SoftHandState& hand : state.hands) {
    if (hand.count > kMaxBandContacts || hand.instrument >= tray_.size()) return false;
    for (std::uint32_t i = 0; i < hand.count; ++i)
      if (hand.near[i].contact.band >= setup_->bands.size() ||
          hand.near[i].contact.part >= tray_[hand.instrument].size())
        return false;
  }
  for (const SolidHandState& hand : state.solid_hands) {
    if (hand.count > kMaxSolidContacts || hand.instrument >= tray_.size()) return false;
    for (std::uint32_t i = 0; i < hand.count; ++i)
      if (hand.near[i].contact.solid >= setup_->solids.size() ||
          hand.near[i].contact.bone != setup_->solids[hand.near[i].contact.solid].bone.index ||
          hand.near[i].contact.part >= tray_[hand.instrument].size())
        return false;
  }
  const auto holds = [](const SoftGrip& grip) { return grip != SoftGrip{}; };
  return grips_ ? grips_->fits(state) : std::none_of(state.grips.begin(), state.grips.end(), holds);
}

void SoftWorld::restore(const SoftState& state, std::uint32_t epoch) {
  put(state, epoch);
  restore_cuts(state);
  restore_pieces(state, false);
  state_.skin = nullptr;
  if (!skins_) return;
  if (state.skin)
    skins_->restore(*state.skin);
  else
    skins_->clear();
}

void SoftWorld::put(const SoftState& state, std::uint32_t epoch) {
  state_ = state;
  epoch_ = epoch;
  bend_count_ = 0;
  events_.clear();
  openings_.clear();
}

void SoftWorld::go_back(const SoftState& state, std::uint32_t epoch) {
  put(state, epoch);
  if (cutting_ && state.cut)
    cutting_->go_back(*state.cut);
  else
    restore_cuts(state);
  restore_pieces(state, true);
  if (skins_ && state.skin) skins_->go_back(*state.skin);
  state_.cut = nullptr;
  state_.skin = nullptr;
  state_.hands = {};
  state_.solid_hands = {};
  state_.grips = {};
}

}  // namespace osteon
