// State of the skin in a session: saved, checked, put back, hashed.
#include <algorithm>
#include <cmath>

#include "osteon/base/hash.h"
#include "skin/skin_world.h"

namespace osteon {
namespace {

void add_to(Hasher& h, const SheetPoint& p) {
  h.add(p.x());
  h.add(p.y());
}

void add_to(Hasher& h, const SkinHand& hand) {
  h.add(hand.near);
  if (hand.near) {
    h.add(hand.barred);
    h.add(hand.instrument);
    const SkinContact& c = hand.contact;
    for (const std::uint32_t x : {c.patch, c.bone, c.part, c.made, hand.held_steps}) h.add(x);
    for (const Vec3& v : {c.core, c.p_B, c.nhat_B, c.hole_B}) h.add(v);
    for (const double x :
         {c.along, c.deep_m, c.force_n, c.stiffness_n_per_m, c.aside_n_per_m, hand.radius_m,
          hand.yields_n_per_m, hand.entered_m, hand.stroke_m, hand.deepest_m, hand.pierce.force_n,
          hand.pierce.excess_n, hand.pierce.depth_m, hand.slit_m, hand.pull_n})
      h.add(x);
    for (const bool x : {c.through, hand.cutting, hand.pierce.through}) h.add(x);
    if (hand.in_wound) h.add(hand.in_wound);
    add_to(h, hand.p);
    add_to(h, hand.hole);
    h.add(hand.since_step);
  }
  h.add(hand.touch.on);
  if (!hand.touch.on) return;
  h.add(hand.touch.over);
  h.add(hand.touch.first_step);
  h.add(hand.touch.last_step);
  h.add(hand.touch.peak_n);
  h.add(hand.touch.deepest_m);
}

bool sound(const SkinPatchState& patch) {
  if (patch.made_count > kMadePerPatch) return false;
  for (std::uint32_t i = 0; i < patch.made_count; ++i)
    if (!std::isfinite(patch.made[i].at.x()) || !std::isfinite(patch.made[i].at.y()) ||
        !(patch.made[i].hole_m > 0 && patch.made[i].hole_m < 1))
      return false;
  return true;
}

bool is_made(std::uint32_t number, std::size_t s, const SkinPatchState& patch) {
  const std::size_t first = s * kMadePerPatch;
  return number == kNotMade || (number >= first && number < first + patch.made_count);
}

}  // namespace

std::uint64_t hash_of_cuts(const SheetCuts& cuts) {
  Hasher h;
  for (const SheetPoint& p : cuts.points) add_to(h, p);
  for (const double depth : cuts.depth_m) h.add(depth);
  return h.value();
}

void SkinWorld::changed(std::size_t s) {
  Patch& mine = patches_[s];
  mine.cuts_hash = hash_of_cuts(mine.cuts);
  mine.slits.find(*setup_.skins[s].sheet, mine.cuts);
  mine.shown = std::make_shared<const SkinCuts>(cuts_to_keep(*setup_.skins[s].sheet, mine.cuts));
}

std::uint64_t SkinWorld::hash() const {
  Hasher h;
  for (const Patch& patch : patches_) {
    h.add(patch.cuts_hash);
    h.add(patch.cuts.blade_in);
    h.add(patch.cuts.blade_at);
    h.add(patch.felt_hash);
    h.add(patch.next_hash);
    h.add(patch.worked);
    if (patch.lips) h.add(patch.lips_hash);
    if (patch.lips_worked > 0) h.add(patch.lips_worked);
    h.add(patch.cut_m);
    h.add(patch.holes);
    for (std::uint32_t i = 0; i < patch.made_count; ++i) {
      add_to(h, patch.made[i].at);
      h.add(patch.made[i].hole_m);
      h.add(patch.made[i].pierced);
    }
  }
  for (const auto& hands : hands_)
    for (std::size_t s = 0; s < patches_.size(); ++s) add_to(h, hands[s]);
  // As one byte of truth, as before there was more than one kind of it.
  if (bares_ != SkinBare::kNone) h.add(true);
  if (bares_ == SkinBare::kAll) h.add(true);
  return h.value();
}

std::shared_ptr<const SkinState> SkinWorld::save() const {
  auto out = std::make_shared<SkinState>();
  for (std::size_t s = 0; s < patches_.size(); ++s) {
    const Patch& from = patches_[s];
    out->patches.push_back({cuts_to_keep(*setup_.skins[s].sheet, from.cuts), from.felt,
                            from.work != nullptr, from.next, from.worked, from.lips != nullptr,
                            from.lips_of, from.lips_worked, from.cut_m, from.holes, from.made_count,
                            from.made});
  }
  out->hands = hands_;
  out->bares = bares_;
  return out;
}

bool SkinWorld::fits(const SkinState& state, std::span<const std::vector<Capsule>> tray) const {
  if (state.patches.size() != patches_.size()) return false;
  for (std::size_t s = 0; s < patches_.size(); ++s) {
    const SkinSheet& sheet = *setup_.skins[s].sheet;
    const SkinPatchState& patch = state.patches[s];
    for (const SkinCuts* cuts : {&patch.cuts, &patch.felt, &patch.next, &patch.lips_of})
      if (!osteon::fits(sheet, *cuts)) return false;
    if (!sound(patch)) return false;
    for (const auto& hands : state.hands)
      if (hands[s].near &&
          (hands[s].instrument >= tray.size() ||
           hands[s].contact.part >= tray[hands[s].instrument].size() ||
           hands[s].contact.patch != s || hands[s].contact.bone != setup_.skins[s].bone.index ||
           !is_made(hands[s].contact.made, s, patch)))
        return false;
  }
  return true;
}

void SkinWorld::put(std::size_t s, const SkinPatchState& from) {
  const SkinSheet& sheet = *setup_.skins[s].sheet;
  Patch& mine = patches_[s];
  mine.cuts = kept_cuts(sheet, from.cuts);
  mine.cut_m = from.cut_m;
  mine.holes = from.holes;
  mine.made_count = from.made_count;
  mine.made = from.made;
  mine.felt = from.felt;
  const SheetCuts felt = kept_cuts(sheet, from.felt);
  mine.felt_hash = hash_of_cuts(felt);
  if (from.felt == SkinCuts{}) {
    mine.yields = setup_.skins[s].whole;
  } else {
    SheetWork work(sheet, felt);
    while (!work.step()) {
    }
    mine.yields = work.take();
  }
  mine.work = nullptr;
  mine.next = {};
  mine.next_hash = kSkinStill;
  mine.worked = 0;
  put_lips(s, from);
  if (from.working) {
    const SheetCuts next = kept_cuts(sheet, from.next);
    mine.next = from.next;
    mine.next_hash = hash_of_cuts(next);
    mine.work = std::make_unique<SheetWork>(sheet, next);
    for (; mine.worked < from.worked; ++mine.worked)
      if (mine.work->step()) break;
  }
  changed(s);
}

void SkinWorld::restore(const SkinState& state) {
  for (std::size_t s = 0; s < patches_.size(); ++s) put(s, state.patches[s]);
  hands_ = state.hands;
  bares_ = state.bares;
  events_.clear();
}

void SkinWorld::go_back(const SkinState& state) {
  for (std::size_t s = 0; s < patches_.size(); ++s) {
    Patch& mine = patches_[s];
    mine.cuts = kept_cuts(*setup_.skins[s].sheet, state.patches[s].cuts);
    mine.cuts.blade_in = false;
    mine.cut_m = state.patches[s].cut_m;
    mine.holes = state.patches[s].holes;
    mine.made_count = state.patches[s].made_count;
    mine.made = state.patches[s].made;
    changed(s);
  }
  if (bares_ == SkinBare::kAll) bares_ = state.bares;
  hands_ = {};
  for (Patch& mine : patches_) mine.pushes.count = 0;
  events_.clear();
}

}  // namespace osteon
