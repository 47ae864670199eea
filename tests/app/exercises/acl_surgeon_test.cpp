// How the virtual surgeon looks on while he clears the stumps of a torn ligament.
#include "osteon/surgeon/acl_surgeon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "cases/open_case.h"
#include "commands/teaching/opened_knee.h"
#include "exercises/scenario_files.h"
#include "osteon/collide/segments.h"
#include "osteon/mesh/distance.h"
#include "osteon/procedure/judge.h"
#include "osteon/scene/marks_now.h"
#include "osteon/surgeon/graft_surgeon.h"
#include "osteon/surgeon/puncture_surgeon.h"

namespace osteon {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

AclTools tools_with_shaver() {
  AclTools tools;
  tools.optics = {30 * kDegree, 52.5 * kDegree};
  tools.scope = "arthroscope_30";
  tools.probe = "hook_probe";
  tools.pin = "guide_pin";
  tools.drills = tools.examines = true;
  tools.tour = {"acl_femur", "acl_tibia"};
  tools.felt = {"acl_femur"};
  tools.shaver = "shaver";
  return tools;
}

// Where a hand is then, as a path goes straight from sample to sample, and what its power is.
struct HandThen {
  Pose X_WT;
  double power = 0;
};
HandThen hand_at(const ProbePath& path, double time_s) {
  const auto after = std::find_if(path.samples.begin(), path.samples.end(),
                                  [&](const PathSample& one) { return one.time_s >= time_s; });
  if (after == path.samples.end()) return {path.samples.back().X_WD, path.samples.back().power};
  if (after == path.samples.begin()) return {after->X_WD, after->power};
  const PathSample& a = *(after - 1);
  const double f = (time_s - a.time_s) / (after->time_s - a.time_s);
  return {{a.X_WD.p + f * (after->X_WD.p - a.X_WD.p), a.X_WD.q.slerp(f, after->X_WD.q)}, a.power};
}

// Both lie along the z of their tools.
double between_shafts_m(const Pose& a, const Pose& b) {
  const auto shaft = [](const Pose& X) {
    return Capsule{X.p, X.p + 0.08 * X.rotate(Vec3::UnitZ()), 0};
  };
  const AxisPoints nearest = nearest_on_axes(shaft(a), shaft(b));
  return (nearest.a - nearest.b).norm();
}

// Bones as their meshes are, for what no other shape of them says.
class KneeInSight {
 public:
  explicit KneeInSight(const Case& knee) {
    for (const Bone& bone : knee.bones) {
      bones_.emplace_back(bone.mesh);
      X_BW_.push_back(bone.X_WB.inverse());
    }
  }
  double gap_m(const Vec3& p_W) const {
    double least = 1;
    for (std::size_t b = 0; b < bones_.size(); ++b)
      least = std::min(least, bones_[b].closest(X_BW_[b] * p_W).signed_distance);
    return least;
  }
  // The least gap on the way, in strides of half a millimetre.
  double least_gap_m(const Vec3& from_W, const Vec3& to_W) const {
    const int strides = 1 + static_cast<int>((to_W - from_W).norm() / 0.0005);
    double least = 1;
    for (int k = 0; k <= strides; ++k)
      least = std::min(least, gap_m(from_W + static_cast<double>(k) / strides * (to_W - from_W)));
    return least;
  }

 private:
  std::vector<MeshDistance> bones_;
  std::vector<Pose> X_BW_;
};

// While the shaver runs and is between the footprints.
struct Watched {
  double runs_s = 0, seen_s = 0;
  double least_between_m = 1, least_room_m = 1;
};
Watched watch(const Case& knee, const AclTools& tools, const AclWays& ways) {
  constexpr double kStep_s = 0.25, kAmong_m = 0.012, kNear_m = 0.06, kTip_m = 0.003;
  Watched out;
  const KneeInSight bones(knee);
  const auto at = [&](const char* name) { return knee.landmarks[*find_landmark(knee, name)].p_W; };
  const Capsule among{at("acl_femur"), at("acl_tibia"), 0};
  for (double t = 0; t < ways.probe.duration_s(); t += kStep_s) {
    const HandThen hand = hand_at(ways.probe, t);
    const Vec3& tip_W = hand.X_WT.p;
    const AxisPoints nearest = nearest_on_axes(among, {tip_W, tip_W, 0});
    if (hand.power <= 0 || (nearest.a - tip_W).norm() > kAmong_m) continue;
    const Pose scope = hand_at(ways.scope, t).X_WT;
    out.runs_s += kStep_s;
    const ScopeView view = view_through(tools.optics, scope);
    const Vec3 way = tip_W - view.eye_W;
    const bool in_picture =
        way.dot(view.along_W) > way.norm() * std::cos(tools.optics.half_field_rad);
    if (in_picture && way.norm() < kNear_m &&
        bones.least_gap_m(view.eye_W, tip_W - kTip_m * way.normalized()) > 0)
      out.seen_s += kStep_s;
    out.least_between_m = std::min(out.least_between_m, between_shafts_m(hand.X_WT, scope));
    out.least_room_m = std::min(out.least_room_m, bones.least_gap_m(scope.p, at("portal_al")));
  }
  return out;
}

TEST(AclSurgeon, WhileHeClearsTheStumpsTheScopeShowsTheTipAndIsInNothingsWay) {
  const auto knee = open_case("builtin:knee:0:right:acl_tear=midsubstance#hull,flexion=120");
  ASSERT_TRUE(knee) << knee.error().message();
  const AclTools tools = tools_with_shaver();
  const auto ways = plan_acl(**knee, tools, {});
  ASSERT_TRUE(ways) << ways.error().message();
  const Watched watched = watch(**knee, tools, *ways);
  EXPECT_GT(watched.runs_s, 20);
  EXPECT_GT(watched.seen_s, 0.95 * watched.runs_s);
  EXPECT_GT(watched.least_between_m, 0.0021 + 0.002);
  EXPECT_GT(watched.least_room_m, 0.002);
  // Out again before the knee is stretched.
  const Vec3 portal_W = (*knee)->landmarks[*find_landmark(**knee, "portal_al")].p_W;
  EXPECT_GT((ways->scope.samples.back().X_WD.p - portal_W).norm(), 0.2);
  EXPECT_LT(ways->scope.duration_s(), ways->third_begin_s + 1e-9);
  // Who clears blind has no scope in the joint.
  Skill skill;
  skill.name = "bad:cleared_blind";
  const auto blind = plan_acl(**knee, tools, skill);
  ASSERT_TRUE(blind) << blind.error().message();
  const Watched unseen = watch(**knee, tools, *blind);
  EXPECT_GT(unseen.runs_s, 20);
  EXPECT_EQ(unseen.seen_s, 0);
}

// For how long a scope's path shows a landmark near the middle of its picture, its bones as the
// case begins.
double shown_s(const Case& knee, const ProbePath& scope, const ScopeOptics& optics,
               const char* mark, double from_s) {
  constexpr double kStep_s = 0.05, kCentral = 0.5;
  const BoneSnapshot bones = begun_bones(knee);
  const Vec3 mark_W = place_now(knee, *find_landmark(knee, mark), bones);
  double shown = 0;
  for (double t = from_s; t < scope.duration_s(); t += kStep_s) {
    const ScopeView view = view_through(optics, hand_at(scope, t).X_WT);
    const auto at = place_in_picture(optics, view, knee, bones, mark_W, kMarkSpare_m);
    if (at && !at->hidden && at->share < kCentral && at->distance_m < 0.03) shown += kStep_s;
  }
  return shown;
}

TEST(AclSurgeon, WhatIsSeenBeforeTheKneeIsBentComesAfterThePortals) {
  ScenarioPlan plan;
  const auto stage = [&](const char* kind, std::vector<std::string> marks) {
    plan.scenario.stages.emplace_back();
    Rule rule;
    rule.kind = kind;
    rule.marks = std::move(marks);
    plan.scenario.stages.back().goals.push_back(rule);
    plan.goals.emplace_back();
    plan.goals.back().emplace_back();
    plan.goals.back().back().rule = rule;
  };
  stage("seen", {"portal_am"});
  stage("portal_made", {"portal_am"});
  stage("seen", {"medial_condyle", "medial_horn"});
  stage("felt", {"medial_horn"});
  EXPECT_TRUE(marks_before_bending(plan, "seen").empty()) << "the knee is not bent";
  stage("knee_bent", {});
  stage("seen", {"acl_femur"});
  EXPECT_EQ(marks_before_bending(plan, "seen"),
            (std::vector<std::string>{"medial_condyle", "medial_horn"}));
  EXPECT_EQ(marks_before_bending(plan, "felt"), std::vector<std::string>{"medial_horn"});
}

TEST(AclSurgeon, BeforeTheKneeIsBentTheScopeShowsTheInnerSide) {
  const auto knee = open_case(
      "builtin:knee:0:right:cartilage_lesion=small:acl_tear=midsubstance"
      "#femur=field,tibia=field,fibula=hull,patella=hull,flexion=120,begin_flexion=80,near=100",
      {}, CaseParts::kAll);
  ASSERT_TRUE(knee) << knee.error().message();
  const ScopeOptics optics{30 * kDegree, 52.5 * kDegree};
  const char* const marks[] = {"medial_condyle", "medial_horn"};
  const auto plain = plan_puncture(**knee, "arthroscope_30", optics, {}, {"hook_probe", true, {}});
  ASSERT_TRUE(plain) << plain.error().message();
  const auto ways = plan_puncture(**knee, "arthroscope_30", optics, {},
                                  {"hook_probe", true, {marks[0], marks[1], "nowhere"}});
  ASSERT_TRUE(ways) << ways.error().message();
  EXPECT_EQ(ways->unseen, std::vector<std::string>{"nowhere"});
  const double made_s = ways->worker.duration_s();
  for (const char* mark : marks) {
    EXPECT_GT(shown_s(**knee, ways->scope, optics, mark, made_s), 1.5) << mark;
    EXPECT_LT(shown_s(**knee, plain->scope, optics, mark, made_s), 0.5) << mark;
  }
}

TEST(AclSurgeon, CanMakeEachErrorThatAReconstructionNames) {
  for (const char* name : {"acl", "acl_second_look"}) {
    const auto scenario = open_scenario(name);
    ASSERT_TRUE(scenario) << scenario.error().message();
    ASSERT_FALSE(scenario->errors.empty());
    for (const ScenarioError& error : scenario->errors) {
      bool known = false;
      for (const auto faults : {acl_faults(), graft_faults_in_knee(), puncture_faults()})
        known = known || std::find(faults.begin(), faults.end(), error.name) != faults.end();
      EXPECT_TRUE(known) << name << ": " << error.name;
    }
  }
}

}  // namespace
}  // namespace osteon
