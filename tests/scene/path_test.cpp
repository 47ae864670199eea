#include "osteon/scene/path.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>

#include "../mesh/shapes.h"
#include "osteon/base/file.h"
#include "osteon/base/random.h"
#include "slerp.h"

namespace osteon {
namespace {

const std::string kHeader = "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button\n";

TEST(Path, EmptyPathHoldsStill) {
  const ProbePath none;
  EXPECT_EQ(none.duration_s(), 0);
  EXPECT_EQ(none.at(1).X_WD.p, Vec3(0, 0, 0));
}

struct BadPath {
  const char* text;
  const char* complaint;
  const char* where;
};

TEST(Path, RefusesBadText) {
  const std::string good = "0,1,2,3,1,0,0,0,0\n";
  const BadPath table[] = {
      {"", "first line", "p.csv:1"},
      {"time_s,x_mm\n", "first line", "p.csv:1"},
      {"", "no sample", "p.csv"},
      {"0,1,2,3,1,0,0,0\n", "8 values", "p.csv:2"},
      {"0,1,2,3,1,0,0,0,0,0\n", "10 values", "p.csv:2"},
      {"0,1,2,3,1,0,0,0,0,\n", "10 values", "p.csv:2"},
      {"0,1,,3,1,0,0,0,0\n", "y_mm", "p.csv:2"},
      {"0,1,2,3x,1,0,0,0,0\n", "z_mm", "p.csv:2"},
      {"nan,1,2,3,1,0,0,0,0\n", "time_s", "p.csv:2"},
      {"0,inf,2,3,1,0,0,0,0\n", "x_mm", "p.csv:2"},
      {"0,1e999,2,3,1,0,0,0,0\n", "x_mm", "p.csv:2"},
      {"0,1,2,3,1,0x1,0,0,0\n", "qx", "p.csv:2"},
      {"0,1e6,2,3,1,0,0,0,0\n", "100 m", "p.csv:2"},
      {"1e8,1,2,3,1,0,0,0,0\n", "1e7 s", "p.csv:2"},
      {"0,1,2,3,0,0,0,0,0\n", "unit quaternion", "p.csv:2"},
      {"0,1,2,3,1,0.1,0,0,0\n", "unit quaternion", "p.csv:2"},
      {"0,1,2,3,1,0,0,0,2\n", "button", "p.csv:2"},
      {"0,1,2,3,1,0,0,0,0\n0,1,2,3,1,0,0,0,0\n", "not increase", "p.csv:3"},
      {"1,1,2,3,1,0,0,0,0\n0.5,1,2,3,1,0,0,0,0\n", "not increase", "p.csv:3"},
      {"0,1,2,3,1,0,0,0,0\n\n1,1,2,3,1,0,0,0,0\n", "1 values", "p.csv:3"},
  };
  for (std::size_t i = 0; i < std::size(table); ++i) {
    const std::string text = (i < 2 ? "" : kHeader) + table[i].text;
    const auto result = parse_path(text, "p.csv");
    ASSERT_FALSE(result) << i << ": " << table[i].text;
    EXPECT_NE(result.error().what.find(table[i].complaint), std::string::npos)
        << i << ": " << result.error().message();
    EXPECT_EQ(result.error().where, table[i].where) << i;
  }
  EXPECT_TRUE(parse_path(kHeader + good, "p.csv"));
}

TEST(Path, ReadsNumbersWhateverTheLocale) {
  const char* old = std::setlocale(LC_NUMERIC, nullptr);
  const std::string before = old ? old : "C";
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // where it is installed
  const auto path = parse_path(kHeader + "0.5, +1.5,-2.25e1 ,3,1,0,0,0,1\r\n\r\n", "p.csv");
  std::setlocale(LC_NUMERIC, before.c_str());
  ASSERT_TRUE(path) << path.error().message();
  ASSERT_EQ(path->samples.size(), 1u);
  EXPECT_EQ(path->samples[0].time_s, 0.5);
  EXPECT_EQ(path->samples[0].X_WD.p, Vec3(0.0015, -0.0225, 0.003));
  EXPECT_TRUE(path->samples[0].button);
}

TEST(Path, ScalesQuaternionsThatAreNearlyUnit) {
  const auto path = parse_path(kHeader + "0,0,0,0,0.9995,0,0,0,0\n", "p.csv");
  ASSERT_TRUE(path);
  EXPECT_EQ(path->samples[0].X_WD.q.w(), 1);
}

ProbePath random_path(std::uint64_t seed, int count) {
  Random random(seed);
  ProbePath path;
  double time = -1;
  for (int i = 0; i < count; ++i) {
    time += random.uniform(1e-6, 2);
    const Vec3 direction = random.direction();
    const double distance = random.uniform(0, 0.3);
    const Quat q = random.rotation();
    path.samples.push_back({time, {distance * direction, q}, random.uniform() < 0.5});
  }
  return path;
}

TEST(Path, WhatWasReadIsWrittenBackBitByBit) {
  const auto dir = test::fresh_folder("path_round");
  ASSERT_TRUE(save_path(random_path(3, 2000), dir / "a.csv"));
  const auto once = load_path(dir / "a.csv");
  ASSERT_TRUE(once) << once.error().message();
  ASSERT_TRUE(save_path(*once, dir / "b.csv"));
  const auto twice = load_path(dir / "b.csv");
  ASSERT_TRUE(twice);
  ASSERT_EQ(once->samples.size(), 2000u);
  for (std::size_t i = 0; i < 2000; ++i) {
    EXPECT_EQ(once->samples[i].time_s, twice->samples[i].time_s);
    EXPECT_EQ(once->samples[i].X_WD.p, twice->samples[i].X_WD.p);
    EXPECT_EQ(once->samples[i].X_WD.q.coeffs(), twice->samples[i].X_WD.q.coeffs());
    EXPECT_EQ(once->samples[i].button, twice->samples[i].button);
  }
  const ProbePath original = random_path(3, 2000);
  for (std::size_t i = 0; i < 2000; ++i)
    EXPECT_LT((original.samples[i].X_WD.p - once->samples[i].X_WD.p).norm(), 1e-15);
}

constexpr const char* kWithInstruments =
    "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button,instrument,size,power,jaw\n";

TEST(Path, MaySayWhatTheHandTakes) {
  const std::string text = std::string(kWithInstruments) +
                           "0,1,2,3,1,0,0,0,0,,0,0,0\n"
                           "1,1,2,3,1,0,0,0,1,shaver,4.5,0.5,0\n"
                           "2,1,2,3,1,0,0,0,0,grasper,0,0,1\n";
  const auto path = parse_path(text, "test");
  ASSERT_TRUE(path) << path.error().message();
  EXPECT_TRUE(path->with_instruments);
  EXPECT_EQ(path->at(0.9).instrument, "");
  EXPECT_EQ(path->at(1.2).instrument, "shaver");
  EXPECT_EQ(path->at(1.2).size_mm, 4.5);
  EXPECT_EQ(path->at(1.2).power, 0.5);
  EXPECT_TRUE(path->at(1.2).button);
  EXPECT_EQ(path->at(2.0).jaw, 1);
}

TEST(Path, RefusesBadInstrumentColumns) {
  for (const char* line :
       {"0,1,2,3,1,0,0,0,0,shaver,4.5,0.5", "0,1,2,3,1,0,0,0,0,shaver,4.5,0.5,0,0",
        "0,1,2,3,1,0,0,0,0,../shaver,4.5,0.5,0", "0,1,2,3,1,0,0,0,0,shaver,-1,0.5,0",
        "0,1,2,3,1,0,0,0,0,shaver,4.5,1.5,0", "0,1,2,3,1,0,0,0,0,shaver,4.5,0.5,nan",
        "0,1,2,3,1,0,0,0,0", "0"}) {
    const auto path = parse_path(std::string(kWithInstruments) + line + "\n", "test");
    ASSERT_FALSE(path) << line;
    EXPECT_EQ(path.error().where, "test:2") << line;
  }
}

TEST(Path, HoldsBothEndsAndHitsItsSamples) {
  const ProbePath path = random_path(5, 20);
  const PathSample &first = path.samples.front(), &last = path.samples.back();
  EXPECT_EQ(path.at(first.time_s - 1).X_WD.p, first.X_WD.p);
  EXPECT_EQ(path.at(last.time_s + 1).X_WD.p, last.X_WD.p);
  EXPECT_EQ(path.duration_s(), last.time_s - first.time_s);
  for (const PathSample& sample : path.samples) {
    const PathSample at = path.at(sample.time_s);
    EXPECT_LT((at.X_WD.p - sample.X_WD.p).norm(), 1e-15);
    EXPECT_LT(at.X_WD.q.angularDistance(sample.X_WD.q), 1e-7);
    EXPECT_EQ(at.button, sample.button);
    EXPECT_EQ(at.time_s, sample.time_s);
  }
}

TEST(Path, MovesStraightAtConstantSpeed) {
  ProbePath path;
  path.samples = {{1, {Vec3(0, 0, 0), Quat::Identity()}, false},
                  {3, {Vec3(0.2, 0, 0.4), Quat(0, 0, 0, 1)}, true}};
  const PathSample at = path.at(1.5);
  EXPECT_LT((at.X_WD.p - Vec3(0.05, 0, 0.1)).norm(), 1e-15);
  EXPECT_NEAR(at.X_WD.q.angularDistance(Quat::Identity()), M_PI / 4, 1e-8);
  EXPECT_FALSE(at.button);
}

// Oracle: Eigen's slerp by arc sine and cosine.
TEST(Slerp, AgreesWithTheClosedForm) {
  Random random(11);
  for (int i = 0; i < 5000; ++i) {
    const Quat a = random.rotation();
    Quat b = random.rotation();
    if (i % 3 == 0) b = a * Quat(Eigen::AngleAxisd(random.uniform(0, 0.02), random.direction()));
    const double t = i % 7 == 0 ? (i % 2) : random.uniform();
    const Quat mine = slerp(a, b, t);
    const Quat wanted = a.slerp(t, b);
    EXPECT_NEAR(mine.norm(), 1, 1e-15);
    EXPECT_LT(std::min((mine.coeffs() - wanted.coeffs()).norm(),
                       (mine.coeffs() + wanted.coeffs()).norm()),
              2e-9);
  }
}

TEST(Slerp, EndsOnHalfTurnsToo) {
  const Quat a = Quat::Identity();
  for (const Quat& b : {Quat(0, 1, 0, 0), Quat(-1, 0, 0, 0), Quat(1, 0, 0, 0)}) {
    for (const double t : {0.0, 0.25, 0.5, 1.0}) {
      const Quat q = slerp(a, b, t);
      ASSERT_TRUE(q.coeffs().array().isFinite().all());
      EXPECT_NEAR(q.norm(), 1, 1e-15);
    }
    EXPECT_NEAR(slerp(a, b, 1).angularDistance(b), 0, 1e-7);
  }
}

}  // namespace
}  // namespace osteon
