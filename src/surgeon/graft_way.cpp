#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "acl_way.h"
#include "osteon/scene/graft_bench.h"
#include "osteon/surgeon/graft_surgeon.h"

namespace osteon {
namespace {

constexpr double kCarry_m_per_s = 0.2, kNear_m_per_s = 0.03, kDraw_m_per_s = 0.01;
constexpr double kOver_m = 0.04;      // above the bench, on the way
constexpr double kBladeIn_m = 0.003;  // pressed so far into what yields
constexpr double kBesideBand_m = 0.004;
constexpr double kBefore_m = 0.05, kAtBegin_m = 0.001;
constexpr double kTaken_s = 0.4, kAtEnd_s = 0.6, kJaw_s = 0.3;
constexpr double kOn_m = 0.012;        // beyond a line's end, against its resistance
constexpr double kAgainst_m = 0.016;   // into a sizer that does not go on
constexpr double kSlideLag_m = 0.010;  // a hand at a slide that resists with 3 N lags so far
constexpr double kLongEnough_m = 0.0755, kThickEnough_m = 0.008;
constexpr double kBoardClock = 20, kPretensionFor_s = 640, kTooShortFor_s = 100;

// One hand that changes instruments.
class BenchWay {
 public:
  BenchWay(const std::string& instrument, const Pose& X, double pace) : pace_(pace) {
    path_.with_instruments = true;
    at_.X_WD = X;
    at_.instrument = instrument;
    path_.samples.push_back(at_);
  }
  void go(const Pose& X, double m_per_s) {
    const double seconds = (X.p - at_.X_WD.p).norm() / (m_per_s * pace_);
    at_.X_WD = X;
    stay(std::max(seconds, 0.05));
  }
  void stay(double seconds) {
    at_.time_s += seconds;
    path_.samples.push_back(at_);
  }
  void over(const Vec3& p_W, const Vec3& back_W) {
    go(held_by_shaft(at_.X_WD.p + Vec3(0, 0, std::max(0.0, kOver_m - at_.X_WD.p.z())),
                     at_.X_WD.q * Vec3::UnitZ()),
       kCarry_m_per_s);
    go(held_by_shaft(Vec3(p_W.x(), p_W.y(), kOver_m), back_W), kCarry_m_per_s);
  }
  void take(const std::string& instrument, double size_mm = 0) {
    stay(0.2);
    at_.instrument = instrument;
    at_.size_mm = size_mm;
    at_.jaw = 0;
    path_.samples.back() = at_;
    stay(0.3);
  }
  void jaw(double open) {
    at_.jaw = open;
    path_.samples.back().jaw = open;
    stay(kJaw_s);
  }
  const Pose& pose() const { return at_.X_WD; }
  const ProbePath& path() const { return path_; }

 private:
  double pace_;
  ProbePath path_;
  PathSample at_;
};

struct GraftHabits {
  std::string fault;
  std::array<std::uint32_t, kGraftTendons> folds{2, 2};
  double size_m = 0;
  double loop_m = 0;
};

constexpr std::array<std::string_view, 4> kGraftFaults{"amputated_tendon", "unflipped_button",
                                                       "long_loop", "slack_graft"};

// As few strands as make it thick enough; of those that are long enough.
GraftHabits graft_habits(const GraftBenchPlan& plan, const std::string& fault) {
  GraftHabits habits;
  habits.fault = fault;
  GraftBenchState done;
  done.on = true;
  for (TendonOnBench& tendon : done.tendons) tendon.stripped = true;
  constexpr std::uint32_t kWays[][2] = {{2, 2}, {3, 2}, {3, 3}};
  for (const auto& folds : kWays) {
    for (std::size_t t = 0; t < kGraftTendons; ++t) done.tendons[t].folds = folds[t];
    const auto graft = graft_on(plan, done);
    if (!graft || (habits.size_m > 0 && graft->length_m < kLongEnough_m)) continue;
    habits.folds = {folds[0], folds[1]};
    habits.size_m = graft->sized_m;
    if (graft->sized_m > kThickEnough_m - 1e-6) break;
  }
  habits.loop_m = loop_for(plan.channel_m, plan.socket_m);
  if (fault == "unflipped_button")
    habits.loop_m -= 0.005;
  else if (fault == "long_loop")
    habits.loop_m += 0.010;
  return habits;
}

void cut_band(BenchWay& way, const Vec3& band_W) {
  const Vec3 back = Vec3(-0.4, 0, 0.9).normalized(), across(0, kBesideBand_m, 0);
  const Vec3 in(0, 0, -kBladeIn_m);
  way.over(band_W, back);
  way.go(held_by_shaft(band_W - across + Vec3(0, 0, 0.005), back), kCarry_m_per_s);
  way.go(held_by_shaft(band_W - across + in, back), kNear_m_per_s);
  way.go(held_by_shaft(band_W + across + in, back), kDraw_m_per_s);
  way.go(held_by_shaft(band_W + across + Vec3(0, 0, 0.010), back), kNear_m_per_s);
}

// Comes in line, is pushed on so far from the line's begin, waits and goes back.
void push_along(BenchWay& way, const GraftBenchPlan& plan, std::uint32_t line, double on_m,
                double m_per_s) {
  const Vec3 from = plan.begin_W(line), along = (plan.end_W(line) - from).normalized();
  const auto at = [&](double m) { return held_by_shaft(from + m * along, -along); };
  way.over(from - kBefore_m * along, -along);
  way.go(at(-kBefore_m), kCarry_m_per_s);
  way.go(at(-kAtBegin_m), kNear_m_per_s);
  way.stay(kTaken_s);
  way.go(at(on_m), m_per_s);
  way.stay(kAtEnd_s);
  way.go(at(-kBefore_m), 3 * m_per_s);
}

double length_of(const GraftBenchPlan& plan, std::uint32_t line) {
  return (plan.end_W(line) - plan.begin_W(line)).norm();
}

void fold_tendon(BenchWay& way, const GraftBenchPlan& plan, std::size_t tendon,
                 std::uint32_t folds) {
  const Vec3 back = Vec3(-0.3, 0, 0.95).normalized();
  const Vec3 free = plan.tendons[tendon].free_W, post = plan.posts_W[folds - 2];
  way.over(free, back);
  way.jaw(1);
  way.go(held_by_shaft(free, back), kNear_m_per_s);
  way.jaw(0);
  way.over(post, back);
  way.go(held_by_shaft(post, back), kNear_m_per_s);
  way.jaw(1);
  way.over(post, back);
  way.jaw(0);
}

void harvest(BenchWay& way, const GraftBenchPlan& plan, const GraftHabits& habits) {
  bool forgets = habits.fault == "amputated_tendon";
  for (const auto& tendon : plan.tendons)
    for (const Vec3& band : tendon.bands_W)
      if (!std::exchange(forgets, false)) cut_band(way, band);
  way.over(plan.tendons[0].insertion_W - Vec3(kBefore_m, 0, 0), Vec3(-1, 0, 0));
  way.take("tendon_stripper");
  for (std::uint32_t t = 0; t < kGraftTendons; ++t)
    push_along(way, plan, t, length_of(plan, t) + kOn_m, 0.04);
}

void size_graft(BenchWay& way, const GraftBenchPlan& plan, double size_m) {
  constexpr std::uint32_t kLine = GraftBenchPlan::kGraft;
  const double on = length_of(plan, kLine) + kOn_m;
  if (size_m > kLeastSizer_m + 1e-6) {
    way.take("graft_sizer", 1e3 * (size_m - kSizerStep_m));
    push_along(way, plan, kLine, kAgainst_m, kNear_m_per_s);
  }
  way.take("graft_sizer", 1e3 * size_m);
  push_along(way, plan, kLine, on, kNear_m_per_s);
}

}  // namespace

Result<ProbePath> plan_graft(const Case& the_case, const Skill& skill) {
  const auto plan = find_graft_bench(the_case);
  if (!plan)
    return fail("the case has no bench for a graft", the_case.name, "Use builtin:graft_bench");
  const std::string fault = skill.name.starts_with("bad:") ? skill.name.substr(4) : std::string();
  if (!fault.empty() &&
      std::find(kGraftFaults.begin(), kGraftFaults.end(), fault) == kGraftFaults.end())
    return fail("no virtual surgeon can make the error '" + fault + "'", "surgeon");
  const GraftHabits habits = graft_habits(*plan, fault);
  const Vec3 up = Vec3(-0.4, 0, 0.9).normalized();
  const double pace = skill.travel_m_per_s / Skill{}.travel_m_per_s;
  BenchWay way("scalpel_15", held_by_shaft(Vec3(-0.05, 0, 0.06), up), pace);
  way.stay(0.3);
  harvest(way, *plan, habits);
  way.over(plan->tendons[0].free_W, up);
  way.take("clamp");
  for (std::size_t t = 0; t < kGraftTendons; ++t) fold_tendon(way, *plan, t, habits.folds[t]);
  way.over(plan->graft_from_W - Vec3(kBefore_m, 0, 0), Vec3(-1, 0, 0));
  size_graft(way, *plan, habits.size_m);
  way.over(plan->board_from_W - Vec3(kBefore_m, 0, 0), Vec3(-1, 0, 0));
  way.take("clamp");
  const double slide = length_of(*plan, GraftBenchPlan::kBoard) / 1.5;  // where it pulls with 80 N
  push_along(way, *plan, GraftBenchPlan::kBoard, slide + kSlideLag_m, kNear_m_per_s);
  way.stay((fault == "slack_graft" ? kTooShortFor_s : kPretensionFor_s) / kBoardClock);
  way.over(plan->hook_W - Vec3(kBefore_m, 0, 0), Vec3(-1, 0, 0));
  way.take("endobutton", 1e3 * habits.loop_m);
  way.go(held_by_shaft(plan->hook_W - Vec3(kBefore_m, 0, 0), Vec3(-1, 0, 0)), kCarry_m_per_s);
  way.go(held_by_shaft(plan->hook_W, Vec3(-1, 0, 0)), kNear_m_per_s);
  way.stay(1.5);
  return trembling(way.path(), skill.tremor_m, skill.seed + 3);
}

}  // namespace osteon
