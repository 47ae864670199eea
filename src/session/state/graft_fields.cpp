#include "state/fields.h"

namespace osteon::stored {
namespace {

constexpr std::uint64_t kTableWork = 25;  // that of muscle and thread on tendons
constexpr std::uint64_t kFascia = 38;     // that of tendons that are found under it
constexpr std::uint64_t kExams = 34;      // that of a knee that is examined
constexpr std::uint64_t kOrders = 13;     // the version that says what graft was handed over

}  // namespace

template <class A>
void field(A& a, TendonOnBench& t) {
  number(a, t.bands_cut, (1u << kMostBands) - 1);
  field(a, t.front_m);
  for (bool* x : {&t.stripped, &t.amputated}) field(a, *x);
  number(a, t.folds, 4);
  if (!since(a, kTableWork)) {  // every tendon was clean and stitched then
    t.scraped_m = kScrapedClean_m;
    t.stitches = (1u << kMostStitches) - 1;
    return;
  }
  field(a, t.scraped_m);
  number(a, t.stitches, (1u << kMostStitches) - 1);
  if (since(a, kFascia)) field(a, t.found);
}

template <class A>
void field(A& a, BenchHand& h) {
  field(a, h.instrument);
  number(a, h.line, GraftBenchPlan::kLines);
  for (double* x : {&h.grip, &h.front_m}) field(a, *x);
  number(a, h.carries, kGraftTendons);
  field(a, h.shut);
  number(a, h.over, kGraftTendons * kMostBands);
  field(a, h.from_W);
  field(a, h.hangs);
  if (since(a, kTableWork)) number(a, h.scrapes, kGraftTendons);
  if (!since(a, kFascia)) return;
  number(a, h.slits, 2);
  number(a, h.lifts, kGraftTendons);
}

template <class A>
void field(A& a, GraftBenchState& s) {
  if (!since(a, 8)) return;  // there was no bench then
  field(a, s.on);
  if (!s.on) return;
  for (TendonOnBench& tendon : s.tendons) field(a, tendon);
  for (BenchHand& hand : s.hands) field(a, hand);
  for (double* x : {&s.passed_m, &s.refused_m, &s.loop_m, &s.tension_n, &s.creep_s}) field(a, *x);
  if (!since(a, kFascia)) return;  // nothing covered the tendons then
  number(a, s.slit, kFasciaOpen);
  number(a, s.hurt, kMclHurt | kNerveHurt);
}

template <class A>
void field(A& a, PlacingHand& h) {
  field(a, h.instrument);
  number(a, h.line, static_cast<std::uint64_t>(PlacingLine::kScrew));
  field(a, h.grip);
  field(a, h.shut);
  field(a, h.from_m);
}

template <class A>
void field(A& a, PlacingScrew& s) {
  for (std::uint32_t* x : {&s.screws, &s.cycles}) field(a, *x);
  field(a, s.p_B);
  field(a, s.out_B);
  for (double* x : {&s.width_m, &s.length_m, &s.in_m, &s.tension_n, &s.flexion_deg}) field(a, *x);
  field(a, s.done);
}

template <class A>
void field(A& a, PlacingTunnel& t) {
  number(a, t.bone, kMaxBones - 1);
  field(a, t.mouth_B);
  field(a, t.outer_B);
  field(a, t.radius_m);
}

// What was told of a graft, and the plan of one that is there.
template <class A>
void field_order(A& a, GraftPlacingState& s) {
  field(a, s.ordered);
  number(a, s.told, kPlacingNumbers);
  for (double& x : s.numbers) field(a, x);
  if (!s.on) return;
  for (PlacingTunnel* t : {&s.plan.femur, &s.plan.tibia}) field(a, *t);
  PlacingPlan& p = s.plan;
  for (double* x : {&p.socket_m, &p.between_m, &p.tibia_bend_rad, &p.femur_bend_rad, &p.graft_m,
                    &p.graft_length_m, &p.loop_m, &p.tail_n})
    field(a, *x);
}

template <class A>
void field(A& a, GraftPlacingState& s) {
  if (!since(a, 12)) return;  // no graft was placed then
  field(a, s.on);
  const bool old = !since(a, kOrders);
  if (!old) field_order(a, s);
  if (!s.on) return;
  number(a, s.phase, static_cast<std::uint64_t>(PlacingPhase::kTurned));
  for (PlacingHand& hand : s.hands) field(a, hand);
  field(a, s.end_W);
  number(a, s.holder, kPlacingHands);
  for (std::uint32_t* x : {&s.lost, &s.let_go_early}) field(a, *x);
  for (double* x : {&s.pin_m, &s.drawn_m, &s.pull_n, &s.most_pull_n, &s.gap_m}) field(a, *x);
  if (old) return;
  field(a, s.tension_n);
  field(a, s.cycles_before);
  field(a, s.screw);
}

template <class A>
void field(A& a, KneeExamState& s) {
  number(a, s.told, kKneeGiveNumbers);
  field(a, s.on);
  number(a, s.knee, kMostKneeState);
  field(a, s.digest);
  for (double& x : s.wanted) field(a, x);
  for (double& x : s.now) field(a, x);
  for (double* x : {&s.front_n, &s.valgus_nm, &s.internal_nm}) field(a, *x);
  field(a, s.give.way_B);
  field(a, s.give.turn_B);
  for (double* x : {&s.give.front_m, &s.give.other_front_m}) field(a, *x);
}

// Whether it was bent, and since kExams whether something was told of how it gives, are one word.
template <class A>
void bend_fields(A& a, BendState& s, KneeExamState& exam) {
  if (!since(a, 13)) return;  // no joint was bent then
  std::uint64_t known = (s.on ? 1u : 0u) + (exam.told > 0 ? 2u : 0u);
  number(a, known, since(a, kExams) ? 3 : 1);
  if constexpr (A::kReads) s.on = (known & 1u) != 0;
  if ((known & 2u) != 0) field(a, exam);
  if (!s.on) return;
  for (double* x : {&s.wanted_deg, &s.now_deg}) field(a, *x);
  field(a, s.straight);
  field(a, s.cycles);
}

template <class A>
void field(A& a, ToldKnee& told) {
  std::uint64_t count = told ? told->size() : 0;
  number(a, count, kKneeGiveNumbers);
  if constexpr (A::kReads) {
    std::vector<double> numbers(a.ok ? count : 0);
    for (double& x : numbers) field(a, x);
    told = numbers.empty() ? nullptr : std::make_shared<const std::vector<double>>(numbers);
  } else if (told) {
    for (double x : *told) field(a, x);
  }
}

template void field(Out&, GraftBenchState&);
template void field(In&, GraftBenchState&);
template void field(Out&, GraftPlacingState&);
template void field(In&, GraftPlacingState&);
template void bend_fields(Out&, BendState&, KneeExamState&);
template void bend_fields(In&, BendState&, KneeExamState&);
template void field(Out&, ToldKnee&);
template void field(In&, ToldKnee&);

}  // namespace osteon::stored
