#include <memory>
#include <utility>
#include <vector>

#include "osteon/physics/skin_state.h"
#include "state/fields.h"

namespace osteon::stored {
namespace {

constexpr std::uint64_t kBoxOnSkin = 29;         // the version before which a box was a rod on skin
constexpr std::uint64_t kPortalsInSkin = 31;     // and before which no hole was a portal
constexpr std::uint64_t kBareSkin = 35;          // and before which it was always felt
constexpr std::uint64_t kOpenWounds = 37;        // and before which none was held open
constexpr std::uint64_t kMostOfSkin = 1u << 20;  // vertices or edges of a sheet, more than it has

}  // namespace

template <class A>
void field(A& a, SheetPoint& p) {
  for (int i = 0; i < 2; ++i) field(a, p[i]);
}

template <class A>
void field(A& a, SkinCuts& cuts) {
  std::uint64_t moved = cuts.moved.size(), cut = cuts.cut.size();
  number(a, moved, kMostOfSkin);
  number(a, cut, kMostOfSkin);
  if constexpr (A::kReads) {
    // Each takes words: a count above what is left is damage, and must not be made room for.
    const std::uint64_t left = (a.bytes.size() - a.at) / 8;
    a.ok = a.ok && 3 * moved + 2 * cut <= left;
    if (!a.ok) return;
    cuts.moved.resize(moved);
    cuts.cut.resize(cut);
  }
  for (SkinCuts::Moved& one : cuts.moved) {
    field(a, one.vertex);
    field(a, one.p);
  }
  for (SkinCuts::Cut& one : cuts.cut) {
    field(a, one.edge);
    field(a, one.depth_m);
  }
  field(a, cuts.blade_in);
  field(a, cuts.blade_at);
}

template <class A>
void field(A& a, SkinContact& c) {
  for (std::uint32_t* x : {&c.patch, &c.bone, &c.part}) field(a, *x);
  for (Vec3* v : {&c.p_B, &c.nhat_B, &c.hole_B}) field(a, *v);
  for (double* x : {&c.along, &c.deep_m, &c.force_n, &c.stiffness_n_per_m, &c.aside_n_per_m})
    field(a, *x);
  field(a, c.through);
  if (!since(a, kBoxOnSkin)) return;
  field(a, c.core);
  if (c.through && since(a, kPortalsInSkin)) field(a, c.made);
}

template <class A>
void field(A& a, SkinPortal& portal) {
  field(a, portal.at);
  field(a, portal.hole_m);
  field(a, portal.pierced);
}

template <class A>
void field(A& a, SkinHand& h) {
  field(a, h.near);
  if (h.near) {
    field(a, h.barred);
    field(a, h.instrument);
    field(a, h.contact);
    field(a, h.p);
    for (double* x : {&h.yields_n_per_m, &h.entered_m, &h.stroke_m, &h.deepest_m, &h.slit_m,
                      &h.pull_n, &h.pierce.force_n, &h.pierce.excess_n, &h.pierce.depth_m})
      field(a, *x);
    for (bool* x : {&h.cutting, &h.pierce.through}) field(a, *x);
    field(a, h.since_step);
    field(a, h.hole);
    if (since(a, kBoxOnSkin)) field(a, h.radius_m);
    if (h.contact.through && since(a, kPortalsInSkin)) field(a, h.held_steps);
    if (since(a, kOpenWounds)) field(a, h.in_wound);
  }
  BandTouch& t = h.touch;
  field(a, t.on);
  if (!t.on) return;
  field(a, t.over);
  for (std::uint64_t* x : {&t.first_step, &t.last_step}) field(a, *x);
  for (double* x : {&t.peak_n, &t.deepest_m}) field(a, *x);
}

template <class A>
void field(A& a, std::shared_ptr<const SkinState>& skin) {
  if (!since(a, 24)) return;  // no skin was felt then
  bool there = skin != nullptr;
  field(a, there);
  if (!there) return;
  SkinState state = skin ? *skin : SkinState{};
  std::uint64_t patches = state.patches.size();
  number(a, patches, std::uint64_t{kMaxSkins});
  if constexpr (A::kReads) state.patches.resize(patches);
  for (SkinPatchState& patch : state.patches) {
    field(a, patch.cuts);
    field(a, patch.felt);
    field(a, patch.working);
    field(a, patch.next);
    field(a, patch.worked);
    field(a, patch.cut_m);
    field(a, patch.holes);
    if (since(a, kPortalsInSkin)) first_of(a, patch.made_count, patch.made);
    if (since(a, kOpenWounds)) {
      field(a, patch.has_lips);
      if (patch.has_lips) field(a, patch.lips_of);
      field(a, patch.lips_worked);
    }
    if (!a.ok) return;
  }
  if (since(a, kBareSkin)) {
    auto bares = static_cast<std::uint64_t>(state.bares);
    number(a, bares, static_cast<std::uint64_t>(SkinBare::kAll));
    state.bares = static_cast<SkinBare>(bares);
  }
  for (auto& hands : state.hands)
    for (std::size_t s = 0; s < patches; ++s) field(a, hands[s]);
  if constexpr (A::kReads) skin = std::make_shared<const SkinState>(std::move(state));
}

template void field(Out&, std::shared_ptr<const SkinState>&);
template void field(In&, std::shared_ptr<const SkinState>&);

}  // namespace osteon::stored
