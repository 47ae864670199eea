#include "state/fields.h"

namespace osteon::stored {

template <class A>
void field(A& a, BoneMotion& b) {
  field(a, b.X_WB);
  field(a, b.v_W);
  field(a, b.w_W);
}

template <class A>
void field(A& a, ToolGuide& g) {
  field(a, g.on);
  if (!g.on) return;
  field(a, g.instrument);
  field(a, g.bone);
  field(a, g.p_B);
  field(a, g.nhat_B);
  for (double* x : {&g.grip, &g.give_m_per_n, &g.stop_m}) field(a, *x);
  for (bool* x : {&g.in_hole, &g.stops}) field(a, *x);
  if (!since(a, 12)) return;  // nothing pulled then
  field(a, g.pulls);
}

template <class A>
void field(A& a, GuideRod& r) {
  number(a, r.kind, static_cast<std::uint64_t>(GuideRod::Kind::kSleeve));
  if (r.kind == GuideRod::Kind::kNone) return;
  number(a, r.bone, kMaxBones - 1);
  field(a, r.X_BR);
  for (double* x : {&r.radius_m, &r.length_m, &r.in_bone_m}) field(a, *x);
}

template <class A>
void field(A& a, Wound& w) {
  field(a, w.soft);
  if (w.soft == kNoWound) return;
  number(a, w.bone.index, kMaxBones - 1);
  field(a, w.p_B);
  field(a, w.open_m2);
}

template <class A>
void field(A& a, WaterState& s) {
  if (!since(a, 11)) return;  // it was in no state then
  field(a, s.on);
  if (!s.on) return;
  field(a, s.hashed);
  for (double* x : {&s.pump_pa, &s.outlet_open, &s.pressure_pa, &s.blood, &s.debris, &s.suction,
                    &s.bleeding_m3_s, &s.debris_m3_s, &s.removed_m3, &s.vascular_m3, &s.opened_m3})
    field(a, *x);
  for (Wound& wound : s.wounds) field(a, wound);
}

// Which places are taken, bit by bit, and those.
template <class A>
void field(A& a, InsideList& list) {
  if (!since(a, 26)) return;  // nothing was entered then
  std::uint64_t taken = 0;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].kind != SubjectKind::kNothing) taken |= std::uint64_t{1} << i;
  number(a, taken, (std::uint64_t{1} << kMostInside) - 1);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if ((taken >> i & 1u) == 0) continue;
    Inside& one = list[i];
    number(a, one.kind, static_cast<std::uint64_t>(SubjectKind::kSoftPart));
    number(a, one.subject, kMaxSofts - 1);
    field(a, one.first_step);
    field(a, one.last_step);
    field(a, one.deepest_m);
  }
}

template <class A>
void field(A& a, BoneSnapshot& s) {
  field(a, s.step);
  field(a, s.time_s);
  field(a, s.epoch);
  field(a, s.saved_step);
  first_of(a, s.count, s.bones);
  if (!since(a, 6)) return;  // nothing led instruments then
  for (ToolGuide& guide : s.guides) field(a, guide);
  for (GuideRod& rod : s.rods) field(a, rod);
  field(a, s.bench);
  field(a, s.water);
  field(a, s.placing);
  bend_fields(a, s.bend, s.exam);
  for (InsideList& list : s.inside) field(a, list);
}

template <class A>
void field(A& a, LooseRing& r) {
  number(a, r.is, static_cast<std::uint64_t>(LooseRing::Is::kFalling));
  field(a, r.X_WB);
  field(a, r.hand);
  field(a, r.second);
  field(a, r.X_PB);
  field(a, r.falls_m_per_s);
}

template <class A>
void field(A& a, RingsState& s) {
  if (!since(a, 5)) return;  // nothing lay loose then
  field(a, s.on);
  if (!s.on) return;
  first_of(a, s.count, s.rings);
  for (bool& shut : s.shut) field(a, shut);
  for (std::uint32_t& instrument : s.instrument) field(a, instrument);
}

template void field(Out&, GuideRod&);
template void field(In&, GuideRod&);
template void field(Out&, InsideList&);
template void field(In&, InsideList&);
template void field(Out&, BoneSnapshot&);
template void field(In&, BoneSnapshot&);
template void field(Out&, RingsState&);
template void field(In&, RingsState&);

}  // namespace osteon::stored
