#include <vector>

#include "state/fields.h"

namespace osteon::stored {
namespace {

// The most pairs of pieces that a state may name: bounds what a damaged file can ask for.
constexpr std::uint64_t kMostPairs = 4'000'000;

bool is_fresh(const PairMemory& pair) { return pair.pair == PairMemory::kNone; }

}  // namespace

template <class A>
void field(A& a, PairMemory& pair) {
  field(a, pair.pair);
  number(a, pair.basis.count, pair.basis.rows.size());
  for (std::uint8_t i = 0; i < pair.basis.count; ++i) field(a, pair.basis.rows[i]);
  field(a, pair.known);
  if (!pair.known) return;
  field(a, pair.plane.nhat_BT_B);
  field(a, pair.plane.bone_support);
  field(a, pair.plane.gap);
  field(a, pair.plane.p_B);
}

// Most places are free: only the others stand in the file, by number.
template <class A>
void field(A& a, std::vector<PairMemory>& pairs) {
  std::uint64_t size = pairs.size();
  number(a, size, kMostPairs);
  std::uint64_t used = 0;
  for (const PairMemory& pair : pairs) used += is_fresh(pair) ? 0 : 1;
  number(a, used, size);
  if constexpr (A::kReads) {
    pairs.assign(a.ok ? size : 0, PairMemory{});
    for (std::uint64_t i = 0; i < used && a.ok; ++i) {
      std::uint64_t place = 0;
      number(a, place, size == 0 ? 0 : size - 1);
      if (a.ok) field(a, pairs[place]);
    }
  } else {
    for (std::uint64_t i = 0; i < size; ++i) {
      if (is_fresh(pairs[i])) continue;
      field(a, i);
      field(a, pairs[i]);
    }
  }
}

template <class A>
void field(A& a, SoftRub& s) {
  if (!since(a, 9)) return;  // soft parts did not rub then
  field(a, s.lag_W);
  field(a, s.sliding);
}

template <class A>
void field(A& a, HapticState& s) {
  field(a, s.tool);
  field(a, s.armed);
  field(a, s.sliding);
  field(a, s.carrier);
  field(a, s.grabbing);
  field(a, s.p_WG);
  field(a, s.rub);
  field(a, s.portal);
  field(a, s.fade_n);
  for (OtherTool& other : s.others) field(a, other);
  first_of(a, s.bone_count, s.X_WB);
  field(a, s.pairs);
}

template <class A>
void field(A& a, HapticParams& p) {
  for (double* value : {&p.tick_s, &p.stiffness_n_per_m, &p.damping_n_s_per_m, &p.friction_scale,
                        &p.max_force_n, &p.max_slew_n_per_s, &p.max_turn_rad_per_tick})
    field(a, *value);
  field(a, p.force_on);
  field(a, p.grab_n_per_m);
}

template void field(Out&, HapticState&);
template void field(In&, HapticState&);
template void field(Out&, HapticParams&);
template void field(In&, HapticParams&);

}  // namespace osteon::stored
