// What was asked of a field before. Asking anew is the oracle: the same bits, and as many looks.
#include "met_before.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "collide/stepped_hole.h"
#include "contact_field.h"
#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "test_scene.h"

namespace osteon {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

MetBefore::Question question() { return {7, 3, {Vec3(1, 2, 3), Quat::Identity()}, 0.003, kNone}; }

PrimitiveContact contact(double gap) {
  PrimitiveContact out;
  out.status = LpStatus::kOptimal;
  out.gap = gap;
  return out;
}

TEST(MetBefore, KnowsNothingAtFirst) {
  MetBefore before;
  EXPECT_EQ(before.find(question()), nullptr);
  EXPECT_EQ(before.find({}), nullptr);
}

TEST(MetBefore, AnswersTheSameQuestionAlone) {
  MetBefore before;
  before.keep(question(), {contact(0.5), 4});
  ASSERT_NE(before.find(question()), nullptr);
  EXPECT_EQ(before.find(question())->looks, 4u);
  for (int i = 0; i < 5; ++i) {
    MetBefore::Question other = question();
    if (i == 0) other.pair = 8;
    if (i == 1) other.cuts = 4;
    if (i == 2) other.X_BT.p.x() = std::nextafter(1.0, 2.0);
    if (i == 3) other.X_BT.q = Quat(Eigen::AngleAxisd(1e-12, Vec3::UnitX()));
    if (i == 4) other.far_m = 0.002;
    EXPECT_EQ(before.find(other), nullptr) << i;
  }
  MetBefore::Question nowhere = question();
  nowhere.X_BT.p.x() = std::numeric_limits<double>::quiet_NaN();
  before.keep(nowhere, {contact(0.5), 1});
  EXPECT_EQ(before.find(nowhere), nullptr);
}

TEST(MetBefore, ABoundBelowTheLowerLimitAnswersNoOtherLimit) {
  MetBefore before;
  MetBefore::Question low = question();
  low.low_m = 1e-6;
  before.keep(low, {contact(-1e-3), 1});
  EXPECT_NE(before.find(low), nullptr);
  EXPECT_EQ(before.find(question()), nullptr);
  before.keep(low, {contact(1e-3), 1});
  EXPECT_NE(before.find(question()), nullptr);
}

TEST(MetBefore, KeepsTheLastTwoOfAPair) {
  MetBefore before;
  for (int i = 0; i < 3; ++i) {
    MetBefore::Question at = question();
    at.X_BT.p.y() = i;
    before.keep(at, {contact(i), 0});
  }
  for (int i = 0; i < 3; ++i) {
    MetBefore::Question at = question();
    at.X_BT.p.y() = i;
    const MetBefore::Answer* found = before.find(at);
    EXPECT_EQ(found != nullptr, i > 0) << i;
    if (found) {
      EXPECT_EQ(found->contact.gap, i);
    }
  }
}

// A tool that is held fast begins each tick at one pose, and tries many from there.
TEST(MetBefore, KeepsTheFirstOfATickForTheNext) {
  MetBefore before;
  for (int tick = 0; tick < 3; ++tick) {
    before.begin_tick();
    for (int i = 0; i < 5; ++i) {
      MetBefore::Question at = question();
      at.X_BT.p.y() = i == 0 ? 0 : tick * 10 + i;
      EXPECT_EQ(before.find(at) != nullptr, i == 0 && tick > 0) << tick << ", " << i;
      if (!before.find(at)) before.keep(at, {contact(i), 0});
    }
  }
}

TEST(MetBefore, WhatLookedAboutPlacesIsRightInItsTickAlone) {
  MetBefore before;
  before.begin_tick();
  MetBefore::Answer about{contact(1), 0};
  about.places.looked_about = true;
  before.keep(question(), about);
  EXPECT_NE(before.find(question()), nullptr);
  before.begin_tick();
  EXPECT_EQ(before.find(question()), nullptr);
}

Tool drill() {
  Tool tool;
  tool.name = "drill";
  tool.parts = {make_rod(Vec3(0, 0, 0.00215), Vec3(0, 0, 0.05), 0.00215),
                make_box({Vec3(0, 0, 0.02), Quat::Identity()}, Vec3(0.002, 0.001, 0.004))};
  return tool;
}

// Few places and limits, asked for in any order, while the hole is cut and filled.
TEST(ContactField, WhatIsKeptHasTheBitsAndLooksOfAskingAnew) {
  const test::SteppedHole hole;
  Case the_case;
  the_case.bones.push_back(test::field_bone(test::cube(0.008)));
  const Tool tool = drill();
  ContactField field(the_case, tool);
  CutField cut = hole.cuts(), whole = hole.cuts();
  whole.clear();
  Random random(5);
  std::vector<Pose> places;
  for (int i = 0; i < 3; ++i) {
    const double height = random.uniform(0.002, 0.012), turn = random.uniform(0, 0.02);
    const Vec3 aside = 1e-4 * random.direction(), axis = random.direction();
    places.push_back({Vec3(0, 0, height) + aside, Quat(Eigen::AngleAxisd(turn, axis))});
  }
  MetBefore before;
  std::uint32_t kept = 0;
  for (int i = 0; i < 600; ++i) {
    if (i % 40 == 0) {
      const CutField* one[] = {i % 80 == 0 ? &cut : &whole};
      field.set_cuts(one);
    }
    const std::uint64_t choice = random.next();
    const Pose& at = places[choice % 3];
    const auto pair = static_cast<std::uint32_t>(choice >> 8 & 1u);
    const ContactField::Wanted wanted{(choice >> 16 & 1u) ? 0.003 : 0.0005,
                                      (choice >> 24 & 1u) ? kNone : 1e-6};
    ContactField::Looks with{0, &before}, anew;
    const double a = field.gap(pair, at, with, wanted);
    const double b = field.gap(pair, at, anew, wanted);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << i;
    ASSERT_EQ(with.asked, anew.asked) << i;
    kept += with.asked;
  }
  EXPECT_GT(kept, 0u) << "nothing carved was looked at";
}

}  // namespace
}  // namespace osteon
