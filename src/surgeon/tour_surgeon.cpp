#include "osteon/surgeon/tour_surgeon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "osteon/base/random.h"
#include "osteon/surgeon/approach.h"

namespace osteon {
namespace {

constexpr double kTourCircle_rad = 2 * std::numbers::pi;
constexpr double kGoShare = 0.15, kOverShare = 0.6, kTurnShare_rad_per_m = 8;
constexpr double kFarTurn_rad = 0.35;
constexpr double kTourNear_m = 0.0025;   // before a touch: from here at the speed of approach
constexpr double kTourFriction_n = 0.6;  // of the portal: felt beside what the bone answers
constexpr double kTourNoticed_n = 1.0;
constexpr double kTourTooDeep_m = 0.008;
constexpr double kTourCorrects_m_per_n_s = 0.003;
constexpr double kTourLongest_s = 6;
constexpr double kTourTooHard_n = 7.5;
constexpr double kTourPush_m_per_s = 0.02;
constexpr double kBumpReach_m = 0.02, kBumpPush_m = 0.013;
constexpr double kTourPastBack_m = 0.003;
// Of a bump, in place of when the bone has answered.
constexpr double kBumpNotYet = -1, kBumpDrawnBack = -2;
constexpr double kBlindLean_rad = 1.1;

double smooth_tour(double f) {
  f = std::clamp(f, 0.0, 1.0);
  return f * f * f * (10 + f * (6 * f - 15));
}

// How well the window can be pushed onto a bone: how far it goes, and more where it would slide off
// or past; kBumpReach_m and more: not at all.
double cost_of_bump(const Case& the_case, const TourPlace& place, const TourTool& tool) {
  constexpr double kSlant_m = 0.03, kStep_m = 0.0002;
  const Pose pose = pose_at(place, tool);
  const Vec3 ahead = pose.rotate(-Vec3::UnitZ());
  for (double along = 0; along < kBumpReach_m; along += 0.0005)
    for (const Bone& bone : the_case.bones) {
      const Vec3 p_W = pose.p + along * ahead;
      if (gap_to(bone, p_W) >= tool.shaft_radius_m) continue;
      Vec3 slope;
      for (int i = 0; i < 3; ++i)
        slope[i] = gap_to(bone, p_W + kStep_m * Vec3::Unit(i)) -
                   gap_to(bone, p_W - kStep_m * Vec3::Unit(i));
      return along + kSlant_m * (1 + ahead.dot(slope.normalized()));
    }
  return kBumpReach_m + kSlant_m;
}

bool is_in_picture(const Case& the_case, const ScopeOptics& optics, const Pose& pose,
                   const Vec3& p_W) {
  const BoneSnapshot rest;
  const ScopeView view = view_through(optics, pose);
  const Vec3 way = p_W - view.eye_W;
  const double off = std::acos(std::clamp(way.normalized().dot(view.along_W), -1.0, 1.0));
  return off < 1.15 * optics.half_field_rad && !is_hidden(the_case, rest, view.eye_W, p_W);
}

class TourPlanner {
 public:
  TourPlanner(const ScenarioPlan& plan, const Case& the_case, const Skill& skill,
              std::vector<TourTool> tools)
      : plan_(plan), case_(the_case), skill_(skill), random_(skill.seed) {
    tour_.tools = std::move(tools);
    last_look_.resize(tour_.tools.size());
  }

  TourPlan run() {
    for (const auto& goals : plan_.goals)
      for (const PlannedRule& goal : goals)
        for (const std::uint32_t subject : goal.bones) add(goal, subject);
    face_what_comes();
    keep_apart();
    choose_fault();
    return std::move(tour_);
  }

 private:
  std::size_t hand_of(const PlannedRule& goal) const {
    if (goal.hand != kNoHand) return goal.hand;
    for (std::size_t h = 0; h < tour_.tools.size(); ++h)
      if (tour_.tools[h].optics.has_value() == (goal.about == SubjectKind::kLandmark)) return h;
    return 0;
  }

  void add(const PlannedRule& goal, std::uint32_t subject) {
    const std::size_t hand = hand_of(goal);
    TourTool& tool = tour_.tools[hand];
    if (goal.rule.kind == "through") {
      tool.portal_W = case_.landmarks[subject].p_W;
      tour_.visits.push_back({hand, TourVisit::Kind::kEnter, false,
                              TourPlace{tool.portal_W, Quat::Identity(), kTourRest_m},
                              goal.rule.numbers.at("for_s")});
      return;
    }
    const bool skips = random_.uniform() < skill_.skip_share;
    const bool looks = goal.about == SubjectKind::kLandmark;
    const std::optional<TourPlace> place =
        looks ? find_look(case_, tool, tool.portal_W,
                          {case_.landmarks[subject].p_W, goal.rule.numbers.at("near_mm") / 1000,
                           goal.rule.numbers.at("far_mm") / 1000})
              : touch_of(hand, subject);
    if (!place)
      tour_.unreachable.push_back(looks ? case_.landmarks[subject].name
                                        : case_.bones[subject].name);
    if (!place || skips) return;
    tour_.visits.push_back({hand, looks ? TourVisit::Kind::kLook : TourVisit::Kind::kTouch, false,
                            *place, goal.rule.numbers.at("for_s")});
    if (looks) last_look_[hand] = place;
  }

  // Who enters a portal faces what is next to be done there.
  void face_what_comes() {
    for (std::size_t i = tour_.visits.size(); i-- > 0;) {
      TourVisit& visit = tour_.visits[i];
      if (visit.kind != TourVisit::Kind::kEnter) continue;
      const auto next = std::find_if(tour_.visits.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                     tour_.visits.end(),
                                     [&](const TourVisit& v) { return v.hand == visit.hand; });
      const bool there =
          next != tour_.visits.end() && (next->place.portal_W - visit.place.portal_W).norm() < 1e-9;
      if (there) visit.place.q = next->place.q;
    }
  }

  // A hook goes where the other hand is not: it turns aside at a portal, and on its way it is
  // lifted over what is in between. A scope keeps its way: what it shows must not be lost for long.
  void keep_apart() {
    std::vector<std::optional<TourPlace>> at(tour_.tools.size());
    for (std::size_t i = 0; i < tour_.visits.size(); ++i) {
      TourVisit& visit = tour_.visits[i];
      const std::optional<TourPlace> from = std::exchange(at[visit.hand], std::nullopt);
      std::vector<TourPlace> others;
      for (const auto& place : at)
        if (place) others.push_back(*place);
      const bool hook = !tour_.tools[visit.hand].optics;
      if (hook && visit.kind == TourVisit::Kind::kEnter && !enter_beside(i, at, others) &&
          give_way(i, at)) {
        at[tour_.visits[i].hand] = from;
        --i;
        continue;
      }
      if (hook && from) visit.lift_m = lift_over(*from, visit.place, others).value_or(0);
      at[visit.hand] = visit.place;
      // Who has touched waits drawn back.
      if (visit.kind == TourVisit::Kind::kTouch) at[visit.hand]->depth_m = kTourRest_m;
    }
  }

  // Clear of the others as they are and as they will go while the hook waits. False: no turn leaves
  // it clear of all that; it is clear of them as they are, then.
  bool enter_beside(std::size_t i, const std::vector<std::optional<TourPlace>>& at,
                    const std::vector<TourPlace>& others) {
    TourVisit& visit = tour_.visits[i];
    const TourTool& tool = tour_.tools[visit.hand];
    std::vector<TourPlace> all = others;
    for (const TourPlace& later : places_until(i, at)) all.push_back(later);
    const TourPlace turned = turned_clear(case_, tool, visit.place, all);
    const bool clear = std::all_of(all.begin(), all.end(),
                                   [&](const TourPlace& other) { return clear_of(turned, other); });
    visit.place = clear ? turned : turned_clear(case_, tool, visit.place, others);
    return clear;
  }

  // Where another hand changes its portal next, the hook lets it go first: it waits over its own
  // portal, so far out that the other passes. False: the other does not, or cannot pass either.
  bool give_way(std::size_t i, const std::vector<std::optional<TourPlace>>& at) {
    if (i + 1 >= tour_.visits.size()) return false;
    const TourVisit &visit = tour_.visits[i], &next = tour_.visits[i + 1];
    if (next.kind != TourVisit::Kind::kEnter || next.hand == visit.hand || !at[next.hand])
      return false;
    const std::vector<TourPlace> others = places_until(i, at);
    for (const double out_m : {0.03, 0.06, 0.09, 0.12}) {
      TourVisit wait = visit;
      wait.kind = TourVisit::Kind::kWaitOver;
      wait.place.depth_m = -out_m;
      if (!clear_of(wait.place, *at[next.hand]) ||
          !std::all_of(others.begin(), others.end(),
                       [&](const TourPlace& other) { return clear_of(wait.place, other); }))
        continue;
      std::swap(tour_.visits[i], tour_.visits[i + 1]);
      tour_.visits.insert(tour_.visits.begin() + static_cast<std::ptrdiff_t>(i), wait);
      return true;
    }
    return false;
  }

  // Where the other hands are and pass from a visit until its own hand's next one.
  std::vector<TourPlace> places_until(std::size_t visit,
                                      std::vector<std::optional<TourPlace>> at) const {
    constexpr int kSamples = 8;
    std::vector<TourPlace> places;
    const std::size_t hand = tour_.visits[visit].hand;
    for (std::size_t i = visit + 1; i < tour_.visits.size(); ++i) {
      const TourVisit& next = tour_.visits[i];
      if (next.hand == hand) break;
      const auto& from = at[next.hand];
      const bool elsewhere = from && (from->portal_W - next.place.portal_W).norm() > 1e-9;
      for (int k = 0; elsewhere && k <= kSamples; ++k)
        places.push_back(place_between(*from, next.place, 0, static_cast<double>(k) / kSamples));
      places.push_back(next.place);
      at[next.hand] = next.place;
    }
    return places;
  }

  // Beside the other hand's shaft where there is a place; else the hands have to share the room.
  std::optional<TourPlace> touch_of(std::size_t hand, std::uint32_t bone) const {
    const TourTool& tool = tour_.tools[hand];
    const TourPlace* other = last_look(hand);
    const auto place = find_touch(case_, tool, tool.portal_W, bone, other, skill_.seed);
    return place || !other ? place
                           : find_touch(case_, tool, tool.portal_W, bone, nullptr, skill_.seed);
  }

  const TourPlace* last_look(std::size_t but) const {
    for (std::size_t h = 0; h < last_look_.size(); ++h)
      if (h != but && last_look_[h]) return &*last_look_[h];
    return nullptr;
  }

  void choose_fault() {
    std::optional<std::size_t> hand;
    for (const PlannedRule& error : plan_.errors) {
      if (error.rule.kind != skill_.fault || error.rule.hand != skill_.fault_hand) continue;
      tour_.fault_numbers = error.rule.numbers;
      if (error.hand != kNoHand) hand = error.hand;
    }
    if (skill_.fault.empty()) return;
    if (skill_.fault == "left_out") return leave_out();
    TourVisit* chosen = nullptr;
    std::vector<std::pair<double, TourVisit*>> bumps;
    for (TourVisit& visit : tour_.visits) {
      if (hand && visit.hand != *hand) continue;
      if (visit.kind == TourVisit::Kind::kTouch && !chosen) chosen = &visit;
      if (visit.kind != TourVisit::Kind::kLook) continue;
      if (skill_.fault == "nothing_seen" && chosen) continue;
      if (skill_.fault == "nothing_seen") {
        tour_.blind = blind_from(visit);
        if (tour_.blind) chosen = &visit;
        continue;
      }
      const double cost_m = cost_of_bump(case_, visit.place, tour_.tools[visit.hand]);
      if (cost_m < kBumpReach_m) bumps.emplace_back(cost_m, &visit);
    }
    if (!bumps.empty()) return bump(std::move(bumps));
    if (chosen) chosen->faulty = true;
    if (skill_.fault == "pressed_over" && chosen) press_again(*chosen);
  }

  // A window that meets bone aslant may slide off: it is pushed at the best few places.
  static void bump(std::vector<std::pair<double, TourVisit*>> at) {
    constexpr std::size_t kBumps = 3;
    std::stable_sort(at.begin(), at.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < std::min(kBumps, at.size()); ++i) at[i].second->faulty = true;
  }

  // Between two bones a hook leans on both, and neither may be pressed too hard: the touch after
  // the chosen one is as hard.
  void press_again(const TourVisit& chosen) {
    bool after = false;
    for (TourVisit& visit : tour_.visits) {
      if (after && visit.kind == TourVisit::Kind::kTouch && visit.hand == chosen.hand) {
        visit.faulty = true;
        return;
      }
      after = after || &visit == &chosen;
    }
  }

  void leave_out() {
    const auto last =
        std::find_if(tour_.visits.rbegin(), tour_.visits.rend(),
                     [](const TourVisit& v) { return v.kind == TourVisit::Kind::kTouch; });
    if (last != tour_.visits.rend()) tour_.visits.erase(std::next(last).base());
  }

  // Drawn back and leant over until no mark is in the picture.
  std::optional<TourPlace> blind_from(const TourVisit& visit) const {
    const TourTool& tool = tour_.tools[visit.hand];
    for (int roll = 0; roll < 4; ++roll)
      for (int k = 0; k < 12; ++k) {
        const double angle = kTourCircle_rad * k / 12;
        const Eigen::AngleAxisd lean(kBlindLean_rad, Vec3(std::cos(angle), std::sin(angle), 0));
        const Eigen::AngleAxisd rolled(roll * kTourCircle_rad / 4, Vec3::UnitZ());
        const Quat q(Eigen::Quaterniond(lean) * Eigen::Quaterniond(visit.place.q) *
                     Eigen::Quaterniond(rolled));
        const TourPlace place{visit.place.portal_W, q.normalized(), kTourRest_m};
        const Pose pose = pose_at(place, tool);
        if (pose.rotate(Vec3::UnitZ()).z() < 0.25) continue;
        if (shaft_room_m(case_, pose, pose.p + 0.06 * pose.rotate(Vec3::UnitZ()),
                         tool.shaft_radius_m) < 0.0005)
          continue;
        if (sees_a_mark(tool, pose)) continue;
        return place;
      }
    return std::nullopt;
  }

  bool sees_a_mark(const TourTool& tool, const Pose& pose) const {
    for (const auto& goals : plan_.goals)
      for (const PlannedRule& goal : goals)
        for (const std::uint32_t mark : goal.bones)
          if (goal.about == SubjectKind::kLandmark && goal.rule.kind != "through" &&
              is_in_picture(case_, *tool.optics, pose, case_.landmarks[mark].p_W))
            return true;
    return false;
  }

  const ScenarioPlan& plan_;
  const Case& case_;
  const Skill& skill_;
  Random random_;
  TourPlan tour_;
  std::vector<std::optional<TourPlace>> last_look_;
};

}  // namespace

TourPlan plan_tour(const ScenarioPlan& plan, const Case& the_case, const Skill& skill,
                   std::vector<TourTool> tools) {
  return TourPlanner(plan, the_case, skill, std::move(tools)).run();
}

TourHand::TourHand(std::shared_ptr<const TourPlan> plan, std::shared_ptr<TourProgress> progress,
                   std::size_t hand, const Skill& skill)
    : plan_(std::move(plan)), progress_(std::move(progress)), hand_(hand), skill_(skill) {
  Random random(skill.seed + hand);
  for (double& phase : phases_) phase = random.uniform(0, kTourCircle_rad);
  const auto first = std::find_if(plan_->visits.begin(), plan_->visits.end(),
                                  [&](const TourVisit& v) { return v.hand == hand_; });
  place_ =
      first == plan_->visits.end() ? TourPlace{tool().portal_W, Quat::Identity(), 0} : first->place;
  place_.depth_m = -kTourOut_m;
  from_ = place_;
}

Pose TourHand::start() const { return pose_at(place_, tool()); }

bool TourHand::done() const {
  return progress_->at >= plan_->visits.size() && phase_ == Phase::kWait;
}

const std::vector<std::string>& TourHand::unreachable() const {
  static const std::vector<std::string> nothing;
  return hand_ == 0 ? plan_->unreachable : nothing;
}

void TourHand::enter(Phase phase) {
  phase_ = phase;
  phase_s_ = pressed_s_ = 0;
  yielded_s_ = kBumpNotYet;
  from_ = place_;
}

// True once it is there.
bool TourHand::go_deep(double depth_m, double metres) {
  const double rest = depth_m - place_.depth_m;
  place_.depth_m += std::clamp(rest, -metres, metres);
  return std::abs(rest) <= metres;
}

void TourHand::go_on() {
  ++progress_->at;
  enter(Phase::kWait);
}

// The force on the hand is the bone's answer and the skin's friction.
void TourHand::press(double dt_s) {
  const double wanted_n =
      visit().faulty ? kTourTooHard_n : std::max(0.6, skill_.press_n) + kTourFriction_n;
  place_.depth_m += std::clamp((wanted_n - known_n_) * kTourCorrects_m_per_n_s, -0.02, 0.02) * dt_s;
  if (known_n_ > 0.7 * wanted_n) pressed_s_ += dt_s;
  const bool over = pressed_s_ >= std::max(skill_.dwell_s, 1.5 * visit().for_s) ||
                    phase_s_ > kTourLongest_s || place_.depth_m > visit().place.depth_m + 0.02;
  if (over) go_on();
}

// Looks away, or pushes the window onto what is before it.
void TourHand::fault(double dt_s) {
  const double stay_s = plan_->fault_numbers.at("for_s") + 0.7;
  if (plan_->blind) {
    constexpr double kRamp_s = 1.2;
    const double f = smooth_tour(std::min(phase_s_, 2 * kRamp_s + stay_s - phase_s_) / kRamp_s);
    const double drawn = std::min(1.0, 2 * f), leant = std::max(0.0, 2 * f - 1);
    place_.depth_m = from_.depth_m + drawn * (kTourRest_m - from_.depth_m);
    place_.q = from_.q.slerp(leant, plan_->blind->q);
    if (phase_s_ > 2 * kRamp_s + stay_s) go_on();
    return;
  }
  const double enough_n = 1.3 * plan_->fault_numbers.at("force_n") + kTourFriction_n;
  // Pushed farther it would slide past what it has met, and wedge.
  const bool enough = known_n_ > enough_n || place_.depth_m > from_.depth_m + kBumpPush_m;
  if (yielded_s_ == kBumpNotYet && enough) yielded_s_ = phase_s_;
  const bool back = yielded_s_ >= 0 && phase_s_ > yielded_s_ + stay_s;
  if (yielded_s_ == kBumpNotYet) place_.depth_m += kTourPush_m_per_s * dt_s;
  const double step_m = kTourPush_m_per_s * dt_s;
  // The skin's friction holds a window that only comes back deeper than it was: it goes in again.
  if (back && go_deep(from_.depth_m - kTourPastBack_m, step_m))
    yielded_s_ = kBumpDrawnBack;
  else if (yielded_s_ == kBumpDrawnBack && go_deep(from_.depth_m, step_m))
    go_on();
}

void TourHand::move(double dt_s) {
  const double go = kGoShare * skill_.travel_m_per_s * dt_s;
  if (progress_->at >= plan_->visits.size()) {
    if (phase_ != Phase::kWait) enter(Phase::kWait);
    return;
  }
  switch (phase_) {
    case Phase::kWait:
      // Who has touched draws back at once; who looks goes on looking while the other works.
      if (visit().hand == hand_ && phase_s_ >= skill_.think_s) return enter(Phase::kBack);
      if (!tool().optics && inside_) go_deep(kTourRest_m, go);
      return;
    case Phase::kBack: {
      const bool elsewhere = (visit().place.portal_W - place_.portal_W).norm() > 1e-9;
      // A hook that turned far in the joint would lean on what is about it, and two handles could
      // meet: it is drawn out for that.
      const bool out =
          elsewhere || (!tool().optics && place_.q.angularDistance(visit().place.q) > kFarTurn_rad);
      const double to = out ? -kTourOut_m : std::min(place_.depth_m, kTourRest_m);
      if (!go_deep(to, go)) return;
      inside_ = inside_ && !out;
      return enter(elsewhere || (out && visit().lift_m > 0) ? Phase::kOver : Phase::kTurn);
    }
    case Phase::kOver: {
      TourPlace above = visit().place;
      above.depth_m = std::min(above.depth_m, -kTourOut_m);
      const Vec3 from_W = pose_at(from_, tool()).p, to_W = pose_at(above, tool()).p;
      const double lift_m = visit().lift_m;
      const double way_m = (to_W - from_W).norm() + 2 * lift_m;
      const double seconds = 0.5 + 1.9 * way_m / (kOverShare * skill_.travel_m_per_s);
      place_ = place_between(from_, above, lift_m, smooth_tour(phase_s_ / seconds));
      if (phase_s_ < seconds) return;
      place_ = above;
      return enter(Phase::kEnter);
    }
    case Phase::kTurn: {
      const double angle = from_.q.angularDistance(visit().place.q);
      const double seconds = 0.1 + 1.9 * angle / (kTurnShare_rad_per_m * skill_.travel_m_per_s);
      place_.q = from_.q.slerp(smooth_tour(phase_s_ / seconds), visit().place.q);
      if (phase_s_ >= seconds) enter(Phase::kEnter);
      return;
    }
    case Phase::kEnter: {
      const TourPlace& to = visit().place;
      inside_ = to.depth_m > 0;
      if (visit().kind != TourVisit::Kind::kTouch) {
        if (go_deep(to.depth_m, go)) enter(Phase::kLook);
        return;
      }
      const bool slow = place_.depth_m > to.depth_m - kTourNear_m;
      go_deep(to.depth_m + kTourTooDeep_m, slow ? skill_.approach_m_per_s * dt_s : go);
      if (slow && (known_n_ > kTourNoticed_n || place_.depth_m >= to.depth_m + kTourTooDeep_m))
        enter(Phase::kPress);
      return;
    }
    case Phase::kLook:
      if (phase_s_ < 1.1 * visit().for_s + 0.3) return;
      return visit().faulty ? enter(Phase::kFault) : go_on();
    case Phase::kPress:
      return press(dt_s);
    case Phase::kFault:
      return fault(dt_s);
  }
}

Vec3 TourHand::tremor() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 6; ++k)
    sum[static_cast<Eigen::Index>(k % 3)] +=
        0.5 * skill_.tremor_m *
        std::sin(kTourCircle_rad * (k < 3 ? 8.3 : 10.7) * time_s_ + phases_[k]);
  return sum;
}

Pose TourHand::step(double dt_s) {
  dt_s_ = dt_s;
  time_s_ += dt_s;
  phase_s_ += dt_s;
  move(dt_s);
  Pose pose = pose_at(place_, tool());
  pose.p += tremor();
  return pose;
}

void TourHand::feel(const Vec3& force_W) {
  felt_n_.push_back(is_finite(force_W) ? force_W.norm() : 0);
  if (felt_n_.size() <= static_cast<std::size_t>(skill_.delay_s / dt_s_)) return;
  known_n_ = felt_n_.front();
  felt_n_.pop_front();
}

}  // namespace osteon
