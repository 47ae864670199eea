#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "hand_way.h"
#include "incision_way.h"
#include "osteon/scene/graft_bench.h"
#include "osteon/surgeon/graft_surgeon.h"

namespace osteon {
namespace {

constexpr double kDraw_m_per_s = 0.01;
constexpr double kOver_m = 0.04;      // above the bench, on the way
constexpr double kBladeIn_m = 0.003;  // pressed so far into what yields
constexpr double kBesideBand_m = 0.004;
constexpr double kBefore_m = 0.05, kAtBegin_m = 0.001;
constexpr double kTaken_s = 0.4, kAtEnd_s = 0.6;
constexpr double kOn_m = 0.012;        // beyond a line's end, against its resistance
constexpr double kAgainst_m = 0.016;   // into a sizer that does not go on
constexpr double kSlideLag_m = 0.010;  // a hand at a slide that resists with 3 N lags so far
constexpr double kLongEnough_m = 0.0755, kThickEnough_m = 0.008;
constexpr double kTableUnder_m = 0.012;  // a free end
constexpr double kStrokeFrom_m = 0.006, kStrokeTo_m = 0.026, kStroke_m_per_s = 0.06;
constexpr int kStrokes = 2;  // and back
constexpr std::uint32_t kPasses = 5, kTooFewPasses = 2;
constexpr double kHang_s = 1.5, kTooWide_m = 0.001;
constexpr double kShortOfMark_m = 0.001, kLiftOut_m = 0.020;
constexpr double kBehindMark_m = 0.022, kThroughFascia_m = 0.016;
const Vec3 kHandBegins(-0.03, 0.16, 0.06);  // from where the graft begins
const Vec3 kComes(-0.03, 0.16, 0.25);       // high over all that lies there
const Vec3 kOverKnee(0, 0, 0.45);           // from the joint's middle
const Vec3 kUpright = Vec3(-0.4, 0, 0.9).normalized();
constexpr double kBoardClock = 20, kPretensionFor_s = 640, kTooShortFor_s = 100;

// Up, over to a place and above it, with a shaft that leads back.
void over(HandWay& way, const GraftBenchPlan& plan, const Vec3& p_W, const Vec3& back_W) {
  const double above = plan.graft_from_W.z() + kOver_m;
  Vec3 up = way.pose().p;
  up.z() = std::max(up.z(), above);
  way.go(held_by_shaft(up, way.pose().q * Vec3::UnitZ()), kHandCarry_m_per_s);
  way.go(held_by_shaft(Vec3(p_W.x(), p_W.y(), above), back_W), kHandCarry_m_per_s);
}

struct GraftHabits {
  std::string fault;
  std::array<std::uint32_t, kGraftTendons> folds{2, 2};
  double size_m = 0;
};

constexpr std::array<std::string_view, 8> kGraftFaults{
    "mcl_cut",   "nerve_cut",   "amputated_tendon", "unflipped_button",
    "long_loop", "slack_graft", "muscle_left",      "few_stitches"};
// Of a whole reconstruction.
constexpr std::array<std::string_view, 11> kFaultsInKnee{
    "incision_aside", "incision_deep", "mcl_cut",    "nerve_cut", "amputated_tendon", "muscle_left",
    "few_stitches",   "slack_graft",   "short_loop", "long_loop", "wide_tunnel"};

// As few strands as make it thick enough; of those that are long enough.
GraftHabits graft_habits(const GraftBenchPlan& plan, const std::string& fault) {
  GraftHabits habits;
  habits.fault = fault;
  GraftBenchState done;
  done.on = true;
  for (TendonOnBench& tendon : done.tendons) {
    tendon.stripped = true;
    tendon.scraped_m = fault == "muscle_left" ? 0 : kScrapedClean_m;
  }
  constexpr std::uint32_t kWays[][2] = {{2, 2}, {3, 2}, {3, 3}};
  for (const auto& folds : kWays) {
    for (std::size_t t = 0; t < kGraftTendons; ++t) done.tendons[t].folds = folds[t];
    const auto graft = graft_on(plan, done);
    if (!graft || (habits.size_m > 0 && graft->length_m < kLongEnough_m)) continue;
    habits.folds = {folds[0], folds[1]};
    habits.size_m = graft->sized_m;
    if (graft->sized_m > kThickEnough_m - 1e-6) break;
  }
  return habits;
}

void cut_band(HandWay& way, const GraftBenchPlan& plan, const Vec3& band_W) {
  const Vec3 back = Vec3(-0.4, 0, 0.9).normalized(), across(0, kBesideBand_m, 0);
  const Vec3 in(0, 0, -kBladeIn_m);
  over(way, plan, band_W, back);
  way.go(held_by_shaft(band_W - across + Vec3(0, 0, 0.005), back), kHandCarry_m_per_s);
  way.go(held_by_shaft(band_W - across + in, back), kHandNear_m_per_s);
  way.go(held_by_shaft(band_W + across + in, back), kDraw_m_per_s);
  way.go(held_by_shaft(band_W + across + Vec3(0, 0, 0.010), back), kHandNear_m_per_s);
}

// Comes in line, is pushed on so far from the line's begin, waits and goes back.
void push_along(HandWay& way, const GraftBenchPlan& plan, std::uint32_t line, double on_m,
                double m_per_s) {
  const Vec3 from = plan.begin_W(line), along = (plan.end_W(line) - from).normalized();
  const auto at = [&](double m) { return held_by_shaft(from + m * along, -along); };
  over(way, plan, from - kBefore_m * along, -along);
  way.go(at(-kBefore_m), kHandCarry_m_per_s);
  way.go(at(-kAtBegin_m), kHandNear_m_per_s);
  way.stay(kTaken_s);
  way.go(at(on_m), m_per_s);
  way.stay(kAtEnd_s);
  way.go(at(-kBefore_m), 3 * m_per_s);
}

double length_of(const GraftBenchPlan& plan, std::uint32_t line) {
  return (plan.end_W(line) - plan.begin_W(line)).norm();
}

void fold_tendon(HandWay& way, const GraftBenchPlan& plan, std::size_t tendon,
                 std::uint32_t folds) {
  const Vec3 back = Vec3(-0.3, 0, 0.95).normalized();
  const Vec3 free = plan.tendons[tendon].free_W, post = plan.posts_W[folds - 2];
  over(way, plan, free, back);
  way.jaw(1);
  way.go(held_by_shaft(free, back), kHandNear_m_per_s);
  way.jaw(0);
  over(way, plan, post, back);
  way.go(held_by_shaft(post, back), kHandNear_m_per_s);
  way.jaw(1);
  over(way, plan, post, back);
  way.jaw(0);
}

// Along the fascia's mark, `aside_m` from it, pressed so far into it.
void slit_fascia(HandWay& way, const GraftBenchPlan& plan, double aside_m, double in_m) {
  const Vec3 aside = aside_m * plan.fascia_across_W(), up = plan.fascia_up_W();
  const Vec3 short_of = kShortOfMark_m * plan.fascia_along_W();
  const Vec3 from = plan.fascia_from_W + aside + short_of, to = plan.fascia_to_W + aside - short_of;
  over(way, plan, from, kUpright);
  way.go(held_by_shaft(from + 0.005 * up, kUpright), kHandCarry_m_per_s);
  way.go(held_by_shaft(from - in_m * up, kUpright), kHandNear_m_per_s);
  way.go(held_by_shaft(to - in_m * up, kUpright), kDraw_m_per_s);
  way.go(held_by_shaft(to + 0.010 * up, kUpright), kHandNear_m_per_s);
}

void lift_out(HandWay& way, const GraftBenchPlan& plan, std::size_t tendon) {
  const Vec3 at = found_at_W(plan, tendon), up = plan.fascia_up_W();
  over(way, plan, at, kUpright);
  way.jaw(1);
  way.go(held_by_shaft(at, kUpright), kHandNear_m_per_s);
  way.jaw(0);
  way.stay(kTaken_s);
  way.go(held_by_shaft(at + kLiftOut_m * up, kUpright), kHandNear_m_per_s);
  way.stay(kAtEnd_s);
  way.jaw(1);
  over(way, plan, at, kUpright);
  way.jaw(0);
}

// The fascia is opened and both tendons are lifted out of it.
void find_tendons(HandWay& way, const GraftBenchPlan& plan, const GraftHabits& habits) {
  if (!plan.is_covered()) return;
  if (habits.fault == "nerve_cut") slit_fascia(way, plan, kBehindMark_m, kBladeIn_m);
  slit_fascia(way, plan, 0, habits.fault == "mcl_cut" ? kThroughFascia_m : kBladeIn_m);
  over(way, plan, plan.fascia_to_W, kUpright);
  way.take("clamp");
  for (std::size_t t = 0; t < kGraftTendons; ++t) lift_out(way, plan, t);
  over(way, plan, plan.fascia_to_W, kUpright);
  way.take("scalpel_15");
}

void harvest(HandWay& way, const GraftBenchPlan& plan, const GraftHabits& habits) {
  bool forgets = habits.fault == "amputated_tendon";
  for (const auto& tendon : plan.tendons)
    for (const Vec3& band : tendon.bands_W)
      if (!std::exchange(forgets, false)) cut_band(way, plan, band);
  over(way, plan, plan.tendons[0].insertion_W - Vec3(kBefore_m, 0, 0), Vec3(-1, 0, 0));
  way.take("tendon_stripper");
  for (std::uint32_t t = 0; t < kGraftTendons; ++t)
    push_along(way, plan, t, length_of(plan, t) + kOn_m, 0.04);
}

// Strokes of the blade beside the free end, pressed on the table.
void scrape_muscle(HandWay& way, const GraftBenchPlan& plan, std::size_t tendon) {
  const GraftBenchPlan::Tendon& is = plan.tendons[tendon];
  const auto at = [&](double along, double up) {
    return held_by_shaft(is.free_W + along * is.lies_W + Vec3(0, 0, up), kUpright);
  };
  over(way, plan, at(kStrokeFrom_m, 0).p, kUpright);
  way.go(at(kStrokeFrom_m, -kTableUnder_m + 0.005), kHandCarry_m_per_s);
  way.go(at(kStrokeFrom_m, -kTableUnder_m - kBladeIn_m), kHandNear_m_per_s);
  for (int i = 0; i < kStrokes; ++i) {
    way.go(at(kStrokeTo_m, -kTableUnder_m - kBladeIn_m), kStroke_m_per_s);
    way.go(at(kStrokeFrom_m, -kTableUnder_m - kBladeIn_m), kStroke_m_per_s);
  }
  way.go(at(kStrokeFrom_m, -kTableUnder_m + 0.010), kHandNear_m_per_s);
}

void stitch_end(HandWay& way, const GraftBenchPlan& plan, std::size_t tendon,
                std::uint32_t passes) {
  over(way, plan, stitch_W(plan, tendon, 0), kUpright);
  way.jaw(1);
  for (std::uint32_t k = 0; k < passes; ++k) {
    way.go(held_by_shaft(stitch_W(plan, tendon, k), kUpright), kHandNear_m_per_s);
    way.jaw(0);
    way.jaw(1);
  }
  over(way, plan, stitch_W(plan, tendon, 0), kUpright);
  way.jaw(0);
}

// Muscle off, thread through the ends.
void prepare_tendons(HandWay& way, const GraftBenchPlan& plan, const GraftHabits& habits) {
  if (habits.fault != "muscle_left") {
    over(way, plan, plan.tendons[0].free_W, kUpright);
    way.take("scalpel_15");
    for (std::size_t t = 0; t < kGraftTendons; ++t) scrape_muscle(way, plan, t);
  }
  over(way, plan, plan.tendons[0].free_W, kUpright);
  way.take("needle_holder");
  for (std::size_t t = 0; t < kGraftTendons; ++t)
    stitch_end(way, plan, t, habits.fault == "few_stitches" ? kTooFewPasses : kPasses);
}

void size_graft(HandWay& way, const GraftBenchPlan& plan, double size_m) {
  constexpr std::uint32_t kLine = GraftBenchPlan::kGraft;
  const double on = length_of(plan, kLine) + kOn_m;
  if (size_m > kLeastSizer_m + 1e-6) {
    way.take("graft_sizer", 1e3 * (size_m - kSizerStep_m));
    push_along(way, plan, kLine, kAgainst_m, kHandNear_m_per_s);
  }
  way.take("graft_sizer", 1e3 * size_m);
  push_along(way, plan, kLine, on, kHandNear_m_per_s);
}

// Tendons out, folded, sized.
void make_graft(HandWay& way, const GraftBenchPlan& plan, const GraftHabits& habits) {
  find_tendons(way, plan, habits);
  harvest(way, plan, habits);
  prepare_tendons(way, plan, habits);
  over(way, plan, plan.tendons[0].free_W, kUpright);
  way.take("clamp");
  for (std::size_t t = 0; t < kGraftTendons; ++t) fold_tendon(way, plan, t, habits.folds[t]);
  over(way, plan, plan.graft_from_W - Vec3(kBefore_m, 0, 0), Vec3(-1, 0, 0));
  size_graft(way, plan, habits.size_m);
}

// On the board, which keeps on pulling.
void stretch(HandWay& way, const GraftBenchPlan& plan) {
  over(way, plan, plan.board_from_W - Vec3(kBefore_m, 0, 0), Vec3(-1, 0, 0));
  way.take("clamp");
  const double slide = length_of(plan, GraftBenchPlan::kBoard) / 1.5;  // where it pulls with 80 N
  push_along(way, plan, GraftBenchPlan::kBoard, slide + kSlideLag_m, kHandNear_m_per_s);
}

// Lets the slide back to its begin: open jaws follow it.
void slacken(HandWay& way, const GraftBenchPlan& plan) {
  const Vec3 from = plan.board_from_W;
  const auto at = [&](double m) { return held_by_shaft(from + Vec3(m, 0, 0), Vec3(-1, 0, 0)); };
  over(way, plan, from - Vec3(kBefore_m, 0, 0), Vec3(-1, 0, 0));
  way.go(at(-kBefore_m), kHandCarry_m_per_s);
  way.go(at(-kAtBegin_m), kHandNear_m_per_s);
  way.stay(kTaken_s);
  way.go(at(length_of(plan, GraftBenchPlan::kBoard) / 1.5), kHandNear_m_per_s);
  way.jaw(1);
  way.go(at(-kBefore_m), kHandNear_m_per_s);
  way.jaw(0);
}

void hang_loop(HandWay& way, const GraftBenchPlan& plan, double loop_m) {
  over(way, plan, plan.hook_W - Vec3(kBefore_m, 0, 0), Vec3(-1, 0, 0));
  way.take("endobutton", 1e3 * loop_m);
  way.go(held_by_shaft(plan.hook_W - Vec3(kBefore_m, 0, 0), Vec3(-1, 0, 0)), kHandCarry_m_per_s);
  way.go(held_by_shaft(plan.hook_W, Vec3(-1, 0, 0)), kHandNear_m_per_s);
  way.stay(kHang_s);
}

std::string fault_of(const Skill& skill) {
  return skill.name.starts_with("bad:") ? skill.name.substr(4) : std::string();
}

double pace_of(const Skill& skill) { return skill.travel_m_per_s / Skill{}.travel_m_per_s; }

Result<GraftBenchPlan> bench_in(const Case& the_case) {
  const auto plan = find_graft_bench(the_case);
  if (!plan)
    return fail("the case has no bench for a graft", the_case.name, "Use builtin:graft_bench");
  return *plan;
}

// A long pin whose shaft points away from the joint would sweep over the bench beside it.
RoundJoint beside_bench(const RoundJoint& knee, const GraftBenchPlan& plan) {
  RoundJoint round = knee;
  std::vector<Vec3> places{plan.graft_from_W, plan.graft_to_W, plan.board_from_W, plan.board_to_W,
                           plan.hook_W};
  places.insert(places.end(), plan.posts_W.begin(), plan.posts_W.end());
  for (const Vec3& p_W : places) round.bones.push_back((p_W - knee.middle_W).normalized());
  return round;
}

// Up, over the knee, and to it with what was held there.
void leave_bench(HandWay& way, const GraftBenchPlan& plan, const RoundJoint& knee, const Pose& to,
                 const std::string& held) {
  over(way, plan, plan.graft_from_W + kHandBegins, kUpright);
  way.go(held_by_shaft(plan.graft_from_W + kComes, kUpright), kHandCarry_m_per_s);
  way.go(held_by_shaft(knee.middle_W + kOverKnee, Vec3::UnitZ()), kHandCarry_m_per_s);
  change_round(way, beside_bench(knee, plan), held, to.p, to.rotate(Vec3::UnitZ()));
}

RoundJoint round_knee(const Case& the_case) {
  Vec3 middle = Vec3::Zero();
  for (const Landmark& mark : the_case.landmarks)
    if (mark.name == "acl_femur" || mark.name == "acl_tibia") middle += 0.5 * mark.p_W;
  return round_joint(the_case, rest_snapshot(the_case), middle);
}

double loop_by(const std::string& fault, double channel_m, double socket_m) {
  const double right_m = loop_for(channel_m, socket_m);
  if (fault == "short_loop") return right_m - 0.005;
  return fault == "long_loop" ? right_m + 0.010 : right_m;
}

}  // namespace

Result<ProbePath> plan_graft(const Case& the_case, const Skill& skill) {
  const auto plan = bench_in(the_case);
  if (!plan) return tl::unexpected(plan.error());
  const std::string fault = fault_of(skill);
  if (!fault.empty() &&
      std::find(kGraftFaults.begin(), kGraftFaults.end(), fault) == kGraftFaults.end())
    return fail("no virtual surgeon can make the error '" + fault + "'", "surgeon");
  HandWay way("scalpel_15", held_by_shaft(plan->graft_from_W + kHandBegins, kUpright),
              pace_of(skill));
  way.stay(0.3);
  make_graft(way, *plan, graft_habits(*plan, fault));
  stretch(way, *plan);
  way.stay((fault == "slack_graft" ? kTooShortFor_s : kPretensionFor_s) / kBoardClock);
  // On the bench alone it is the loop that keeps a button from turning.
  const std::string of_loop = fault == "unflipped_button" ? "short_loop" : fault;
  hang_loop(way, *plan, loop_by(of_loop, plan->channel_m, plan->socket_m));
  return trembling(way.path(), skill.tremor_m, skill.seed + 3);
}

std::span<const std::string_view> graft_faults_in_knee() { return kFaultsInKnee; }

Result<double> drilled_for_graft(const Case& the_case, const Skill& skill) {
  const auto plan = bench_in(the_case);
  if (!plan) return tl::unexpected(plan.error());
  const std::string fault = fault_of(skill);
  return graft_habits(*plan, fault).size_m + (fault == "wide_tunnel" ? kTooWide_m : 0);
}

Result<ProbePath> plan_graft_stage(const Case& the_case, const Skill& skill, double begin_s,
                                   const Pose& from, const std::string& held,
                                   const std::optional<Pose>& X_WSite) {
  const auto plan = bench_in(the_case);
  if (!plan) return tl::unexpected(plan.error());
  const std::string fault = fault_of(skill);
  const GraftHabits habits = graft_habits(*plan, fault);
  HandWay way(held, from, pace_of(skill));
  way.stay(begin_s);
  const RoundJoint knee = round_knee(the_case);
  if (X_WSite) open_skin(the_case, *X_WSite, knee, fault, way);
  change_round(way, knee, "scalpel_15", plan->graft_from_W + kComes, kUpright);
  make_graft(way, *plan, habits);
  stretch(way, *plan);
  way.stay(kTooShortFor_s / kBoardClock);
  if (fault == "slack_graft") slacken(way, *plan);
  leave_bench(way, *plan, knee, from, held);
  way.stay(0.5);
  return trembling(way.path(), skill.tremor_m, skill.seed + 3);
}

Result<ProbePath> plan_loop_stage(const Case& the_case, const Skill& skill, double channel_m,
                                  double socket_m, const Pose& from, const std::string& held) {
  const auto plan = bench_in(the_case);
  if (!plan) return tl::unexpected(plan.error());
  const double loop_m = loop_by(fault_of(skill), channel_m, socket_m);
  if (!(loop_m > 0)) return fail("no loop is long enough for the channel", "graft");
  HandWay way(held, from, pace_of(skill));
  const RoundJoint knee = round_knee(the_case);
  change_round(way, knee, held, plan->graft_from_W + kComes, kUpright);
  hang_loop(way, *plan, loop_m);
  leave_bench(way, *plan, knee, from, held);
  return trembling(way.path(), skill.tremor_m, skill.seed + 4);
}

}  // namespace osteon
