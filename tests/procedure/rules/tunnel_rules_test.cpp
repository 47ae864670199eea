#include <gtest/gtest.h>

#include <array>

#include "../report_fixtures.h"
#include "osteon/procedure/judge.h"
#include "osteon/procedure/scope_watch.h"
#include "osteon/procedure/tunnel_events.h"

namespace osteon {
namespace {

const char* const kKneeText = R"(format = 1
name = "tunnels"
title = "Tunnels"
text = "Locate."
version = 1
anatomy = "knee"
felt = "femur=field,flexion=120"

[[hands]]
name = "scope"
instrument = "arthroscope_30"

[[stages]]
name = "in"
title = "A"
instruction = "Go in and press."
[[stages.goals]]
rule = "through"
for_s = 0
marks = ["portal_al"]
[[stages.goals]]
rule = "felt"
marks = ["spot"]
within_mm = 5
force_n = 0.5

[[stages]]
name = "locate"
title = "B"
instruction = "Locate."
[[stages.goals]]
rule = "tunnel_located"
bones = ["femur"]
[[stages.goals]]
rule = "graft_tested"
most_difference_mm = 3

[[errors]]
name = "wrong_portal"
title = "Wrong portal"
severity = "major"
consequence = "-"
source = "D"
rule = "entered_by"
marks = ["portal_am"]

[[errors]]
name = "blind"
title = "Blind"
severity = "major"
consequence = "-"
source = "D"
rule = "located_unseen"
marks = ["spot", "portal_al"]

[[errors]]
name = "blow_out"
title = "Blow-out"
severity = "major"
consequence = "-"
source = "D"
rule = "outside_back_wall_mm"
least = 0
)";

constexpr double kTick_s = 0.001;

class TunnelRules : public ::testing::Test {
 protected:
  void SetUp() override {
    auto scenario = parse_scenario(kKneeText, "tunnels.toml");
    ASSERT_TRUE(scenario) << scenario.error().message();
    case_ = testing::named_case({"femur", "tibia"});
    for (const char* name : {"portal_al", "portal_am", "spot"})
      case_.landmarks.push_back({name, Vec3::Zero()});
    auto plan = plan_scenario(*scenario, case_);
    ASSERT_TRUE(plan) << plan.error().message();
    plan_ = std::move(*plan);
    state_ = begin_scenario(plan_);
  }
  void tell(EventKind kind, SubjectKind about, std::uint32_t subject,
            std::array<double, 3> values = {}) {
    judge(plan_, {++tick_, kind, 0, about, subject, Vec3::Zero(), values}, kTick_s, state_);
  }
  std::vector<std::string> errors() const {
    std::vector<std::string> names;
    for (const MadeError& made : state_.errors)
      names.push_back(plan_.scenario.errors[made.error].name);
    return names;
  }

  Case case_;
  ScenarioPlan plan_;
  ScenarioState state_;
  std::uint64_t tick_ = 0;
};

TEST_F(TunnelRules, StagesEndOnceAllWasDoneWellEnough) {
  tell(kThroughPortal, SubjectKind::kLandmark, 0);
  tell(kMarkFelt, SubjectKind::kLandmark, 2, {6, 2, 0});
  tell(kMarkFelt, SubjectKind::kLandmark, 2, {2, 0.4, 0});
  EXPECT_EQ(state_.stage, 0u);
  tell(kMarkFelt, SubjectKind::kLandmark, 2, {2, 0.6, 0});
  EXPECT_EQ(state_.stage, 1u);
  tell(kTunnelLocated, SubjectKind::kBone, 1, {40, 0, 0});  // of the tibia: not asked for
  tell(kGraftTested, SubjectKind::kNothing, kNoSubject, {4, 0, 0});
  tell(kTunnelLocated, SubjectKind::kBone, 0, {25, 0, 0});
  EXPECT_FALSE(state_.over);
  tell(kGraftTested, SubjectKind::kNothing, kNoSubject, {0.5, 0, 0});
  EXPECT_TRUE(state_.over);
  EXPECT_TRUE(errors().empty());
}

TEST_F(TunnelRules, AGraftThatIsTooLooseIsNoEnd) {
  tell(kThroughPortal, SubjectKind::kLandmark, 0);
  tell(kMarkFelt, SubjectKind::kLandmark, 2, {2, 0.6, 0});
  tell(kTunnelLocated, SubjectKind::kBone, 0, {25, 0, 0});
  tell(kGraftTested, SubjectKind::kNothing, kNoSubject, {3.5, 0, 0});
  EXPECT_FALSE(state_.over);
  tell(kGraftTested, SubjectKind::kNothing, kNoSubject, {0.5, 0, 0});
  EXPECT_TRUE(state_.over);
  EXPECT_TRUE(errors().empty());
}

TEST_F(TunnelRules, ErrorsAreTold) {
  tell(kThroughPortal, SubjectKind::kLandmark, 1);
  tell(kThroughPortal, SubjectKind::kLandmark, 1);  // it stays there
  EXPECT_EQ(errors(), std::vector<std::string>{"wrong_portal"});
  // One mark seen is not both; the error comes once.
  tell(kMarkSeen, SubjectKind::kLandmark, 2, {0.2, 10, 0});
  tell(kMarkSeen, SubjectKind::kLandmark, 0, {0.2, 45, 0});
  for (std::uint32_t mark = 0; mark < 3; ++mark) tell(kTunnelBegun, SubjectKind::kLandmark, mark);
  EXPECT_EQ(errors(), (std::vector<std::string>{"wrong_portal", "blind"}));
  for (std::uint32_t mark = 0; mark < 3; ++mark) tell(kTunnelBegun, SubjectKind::kLandmark, mark);
  const auto wall = static_cast<double>(TunnelValue::kBackWall);
  const auto socket = static_cast<double>(TunnelValue::kFemoralSocket);
  tell(kTunnelMeasured, SubjectKind::kNothing, kNoSubject, {socket, -5, 0});
  tell(kTunnelMeasured, SubjectKind::kNothing, kNoSubject, {wall, 2.5, 0});
  EXPECT_EQ(errors().size(), 2u);
  tell(kTunnelMeasured, SubjectKind::kNothing, kNoSubject, {wall, -0.5, 0});
  EXPECT_EQ(errors().back(), "blow_out");
}

TEST_F(TunnelRules, WhoSawBothMayLocate) {
  for (const std::uint32_t mark : {0u, 2u})
    tell(kMarkSeen, SubjectKind::kLandmark, mark, {0.2, 10, 0});
  for (std::uint32_t mark = 0; mark < 3; ++mark) tell(kTunnelBegun, SubjectKind::kLandmark, mark);
  EXPECT_TRUE(errors().empty());
}

const char* const kDrilledText = R"(format = 1
name = "drilled"
title = "Drilled"
text = "Drill."
version = 1
anatomy = "knee"
felt = "femur=field,tibia=field,flexion=120"

[[hands]]
name = "pin"
instrument = "guide_pin"
also = ["cannulated_drill:8"]

[[stages]]
name = "tunnel"
title = "A"
instruction = "Drill."
[[stages.goals]]
rule = "tunnel_drilled"
bones = ["tibia"]
least_mm = 20

[[stages]]
name = "socket"
title = "B"
instruction = "Drill."
[[stages.goals]]
rule = "socket_drilled"
bones = ["femur"]
least_mm = 12

[[errors]]
name = "no_pin"
title = "No pin"
severity = "major"
consequence = "-"
source = "D"
rule = "drilled_free"
bones = ["femur", "tibia"]

[[errors]]
name = "plunged"
title = "Plunged"
severity = "major"
consequence = "-"
source = "D"
rule = "plunged_past"
bones = ["tibia"]
most_mm = 10

[[errors]]
name = "sound_one"
title = "Drilled what is sound"
severity = "major"
consequence = "-"
source = "D"
rule = "drilled_into"
bones = ["tibia"]

[[errors]]
name = "into_old"
title = "Opened the old one"
severity = "major"
consequence = "-"
source = "D"
rule = "outside_tibial_to_old_mm"
least = 1
)";

class DrilledRules : public TunnelRules {
 protected:
  void SetUp() override {
    auto scenario = parse_scenario(kDrilledText, "drilled.toml");
    ASSERT_TRUE(scenario) << scenario.error().message();
    EXPECT_EQ(scenario->hands[0].also, std::vector<std::string>{"cannulated_drill:8"});
    case_ = testing::named_case({"femur", "tibia"});
    auto plan = plan_scenario(*scenario, case_);
    ASSERT_TRUE(plan) << plan.error().message();
    plan_ = std::move(*plan);
    state_ = begin_scenario(plan_);
  }
};

TEST_F(DrilledRules, ATunnelMustBeLongWideAndOpenOnBothSides) {
  for (const std::array<double, 3>& bad :
       {std::array<double, 3>{19, 8, 1}, {40, 6.9, 1}, {40, 8, 0}})
    tell(kTunnelDrilled, SubjectKind::kBone, 1, bad);
  tell(kTunnelDrilled, SubjectKind::kBone, 0, {40, 8, 1});  // of the femur: not asked for
  EXPECT_EQ(state_.stage, 0u);
  tell(kTunnelDrilled, SubjectKind::kBone, 1, {40, 8, 1});
  EXPECT_EQ(state_.stage, 1u);
}

TEST_F(DrilledRules, ASocketMustBeDeepWideAndHaveItsChannel) {
  tell(kTunnelDrilled, SubjectKind::kBone, 1, {40, 8, 1});
  for (const std::array<double, 3>& bad :
       {std::array<double, 3>{11, 8, 4.5}, {25, 6, 4.5}, {25, 8, 0}, {25, 8, 2.4}})
    tell(kSocketDrilled, SubjectKind::kBone, 0, bad);
  EXPECT_FALSE(state_.over);
  tell(kSocketDrilled, SubjectKind::kBone, 0, {25, 8, 4.5});
  EXPECT_TRUE(state_.over);
}

TEST_F(DrilledRules, DrillingWithoutAPinAndPlungingAreToldOnceForEachBone) {
  tell(kDrillPlunged, SubjectKind::kBone, 1, {9, 0, 0});
  tell(kDrillPlunged, SubjectKind::kBone, 0, {30, 0, 0});  // not asked about
  EXPECT_TRUE(errors().empty());
  for (const double beyond : {10.5, 11.5})
    tell(kDrillPlunged, SubjectKind::kBone, 1, {beyond, 0, 0});
  for (int n = 0; n < 2; ++n) tell(kDrilledFree, SubjectKind::kBone, 0, {4, 0, 0});
  EXPECT_EQ(errors(), (std::vector<std::string>{"plunged", "no_pin"}));
}

TEST_F(DrilledRules, ABoneThatShallNotBeDrilledAndAnOldTunnelThatIsOpenedCount) {
  tell(kBoneDrilled, SubjectKind::kBone, 0, {});
  const auto measured = [&](TunnelValue which, double mm) {
    tell(kTunnelMeasured, SubjectKind::kNothing, kNoSubject, {static_cast<double>(which), mm, 0});
  };
  measured(TunnelValue::kTibialToOld, 1.1);
  measured(TunnelValue::kFemoralToOld, 0.2);
  EXPECT_TRUE(errors().empty());
  for (int n = 0; n < 2; ++n) tell(kBoneDrilled, SubjectKind::kBone, 1, {});
  measured(TunnelValue::kTibialToOld, 0.9);
  EXPECT_EQ(errors(), (std::vector<std::string>{"sound_one", "into_old"}));
}

}  // namespace
}  // namespace osteon
