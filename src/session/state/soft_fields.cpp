#include <algorithm>
#include <span>

#include "state/fields.h"

namespace osteon::stored {

// The version that says where a band is drawn aside, and what suction holds.
constexpr std::uint64_t kAside = 32;
// The version that says what of the solids lies loose.
constexpr std::uint64_t kLooseSofts = 33;
// The version that has room for more bands than kBandsBefore.
constexpr std::uint64_t kMoreBands = 36;
constexpr std::size_t kBandsBefore = 8;
// Of a band: 61 strands and whether it is in two.
constexpr std::uint64_t kAllStrandBits = (std::uint64_t{1} << 62) - 1;

template <class A>
void field(A& a, NearBand& n) {
  field(a, n.contact.band);
  field(a, n.contact.part);
  field(a, n.contact.nhat_W);
  field(a, n.contact.others_taken_m);
  for (bool* x : {&n.touching, &n.barred, &n.behind}) field(a, *x);
  field(a, n.deep_m);
  field(a, n.taken_m);
  if (!since(a, kAside)) return;
  for (Vec3* x : {&n.contact.off_W, &n.bend_W}) field(a, *x);
  field(a, n.at_share);
}

template <class A>
void field(A& a, BandTouch& t) {
  field(a, t.on);
  field(a, t.over);
  field(a, t.first_step);
  field(a, t.last_step);
  field(a, t.peak_n);
  field(a, t.deepest_m);
}

template <class A>
void field(A& a, SolidNear& n) {
  SolidContact& c = n.contact;
  for (std::uint32_t* x : {&c.solid, &c.bone, &c.part}) field(a, *x);
  for (double* x : {&c.along, &c.stiffness_n_per_m, &c.others_m, &n.deep_m, &n.force_n})
    field(a, *x);
  for (Vec3* x : {&c.p_B, &c.nhat_B, &n.outside_B}) field(a, *x);
  for (bool* x : {&n.touching, &n.barred, &n.behind}) field(a, *x);
  if (!since(a, 14)) return;  // nothing cut solids then
  field(a, n.entered_m);
  if (!since(a, 26)) return;  // a box was a rod then
  field(a, c.core);
}

template <class A>
void solids_field(A& a, SoftState& s) {
  if (!since(a, 7)) return;  // no solid was soft then
  for (bool& lost : s.solid_lost) field(a, lost);
  for (SolidHandState& hand : s.solid_hands) {
    field(a, hand.instrument);
    first_of(a, hand.count, hand.near);
    for (BandTouch& touch : hand.touches) field(a, touch);
  }
  field(a, s.cut);
}

template <class A>
void field(A& a, SoftGrip& g) {
  field(a, g.jaw_open);
  SoftHold& hold = g.hold;
  number(a, hold.of, static_cast<std::uint64_t>(SoftHold::Of::kSolid));
  for (std::uint32_t* x : {&hold.part, &hold.bone}) field(a, *x);
  for (Vec3* x : {&hold.p_T, &hold.p_B, &g.against_B}) field(a, *x);
  for (double* x : {&hold.share, &hold.others_taken_m, &hold.stiffness_n_per_m, &g.force_n,
                    &g.taken_m, &g.peak_n, &g.most_m})
    field(a, *x);
  field(a, g.first_step);
  if (!since(a, kAside)) return;
  for (Vec3* x : {&hold.nhat_B, &g.bend_W}) field(a, *x);
  field(a, hold.most_n);
}

template <class A>
void grips_field(A& a, SoftState& s) {
  if (!since(a, 22)) return;  // jaws held nothing then
  bool any = std::any_of(s.grips.begin(), s.grips.end(),
                         [](const SoftGrip& grip) { return grip != SoftGrip{}; });
  field(a, any);
  for (SoftGrip& grip : s.grips)
    if (any) field(a, grip);
}

// Whether it is in two, bit 0, and behind it which of its strands are gone: a word of before they
// were told apart says the same.
template <class A>
void strands_field(A& a, BandState& band) {
  std::uint64_t bits = band.gone << 1 | (band.torn ? 1 : 0);
  number(a, bits, kAllStrandBits);
  band.torn = (bits & 1) != 0;
  band.gone = bits >> 1;
}

template <class A>
void field(A& a, SoftState& s) {
  if (!since(a, 3)) return;  // nothing was soft then
  field(a, s.on);
  if (!s.on) return;
  const std::size_t bands = since(a, kMoreBands) ? kMaxBands : kBandsBefore;
  for (BandState& band : std::span(s.bands).first(bands)) {
    strands_field(a, band);
    field(a, band.lost);
    if (!band.torn && band.gone == 0) continue;
    if (!since(a, 10)) continue;  // where it tore was not kept then
    field(a, band.torn_share);
  }
  for (SoftHandState& hand : s.hands) {
    field(a, hand.instrument);
    first_of(a, hand.count, hand.near);
    for (BandTouch& touch : std::span(hand.touches).first(bands)) field(a, touch);
  }
  solids_field(a, s);
  grips_field(a, s);
  field(a, s.skin);
  pieces_field(a, s);
}

// As of bones (carving_fields.cpp). Where nothing cuts, nothing lies.
template <class A>
void pieces_field(A& a, SoftState& s) {
  if (!since(a, kLooseSofts) || !s.cut) return;
  bool there = s.pieces != nullptr && !s.pieces->pieces.empty();
  field(a, there);
  if (!there) return;
  FallenPiecesState state = s.pieces ? *s.pieces : FallenPiecesState{};
  field(a, state);
  if constexpr (A::kReads) s.pieces = std::make_shared<const FallenPiecesState>(std::move(state));
}

template void field(Out&, SoftState&);
template void field(In&, SoftState&);

}  // namespace osteon::stored
