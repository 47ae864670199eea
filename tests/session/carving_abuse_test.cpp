// Wild hands with instruments that carve: whatever they do, the force stays below the profile, all
// numbers stay finite, the bone stays closed and the memory is that of the pool.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "drilling.h"
#include "osteon/base/random.h"
#include "osteon/base/turn.h"
#include "osteon/carve/carved_surface.h"
#include "osteon/carve/removed.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

using testing::Drilling;
using testing::kTop_m;

// A hand that leaps, spins, presses and pulls about the block, and now and then sends nonsense.
class WildHand {
 public:
  explicit WildHand(std::uint64_t seed) : random_(seed) {}

  HandInput next(std::size_t instruments) {
    HandInput hand;
    if (random_.uniform(0, 1) < 0.01) aim_anew();
    const Vec3 way = aim_ - p_;
    p_ += std::min(1.0, speed_ / std::max(way.norm(), 1e-9)) * way;
    q_ = (Quat(Eigen::AngleAxisd(spin_, axis_)) * q_).normalized();
    hand.input.X_WD = {p_, q_};
    hand.input.v_W = 1000 * std::min(speed_, way.norm()) * way.normalized();
    if (!is_finite(hand.input.v_W)) hand.input.v_W.setZero();
    const double die = random_.uniform(0, 1);
    if (die < 0.004)
      hand.command = {CommandKind::kTake,
                      std::floor(random_.uniform(0, static_cast<double>(instruments)))};
    else if (die < 0.02)
      hand.command = {CommandKind::kPower, random_.uniform(0, 1)};
    else if (die < 0.03)
      hand.command = {CommandKind::kJaw, random_.uniform(0, 1)};
    if (random_.uniform(0, 1) < 0.002)
      hand.input.X_WD.p.x() = std::numeric_limits<double>::quiet_NaN();
    return hand;
  }

 private:
  void aim_anew() {
    const auto some = [&](double most) {
      return Vec3(random_.uniform(-most, most), random_.uniform(-most, most),
                  random_.uniform(-most, most));
    };
    aim_ = some(0.008) + Vec3(0, 0, 0.5 * kTop_m);
    axis_ = (some(1) + Vec3(0, 0, 0.01)).normalized();
    // From still to 2 m/s, and to a turn a second.
    speed_ = 0.002 * std::pow(random_.uniform(0, 1), 3);
    spin_ = 0.006 * std::pow(random_.uniform(0, 1), 3);
    // Half of the time it stands as one that means to cut, and turns about its shaft.
    if (random_.uniform(0, 1) < 0.5) return;
    q_ = turn_between(Vec3::UnitZ(), Vec3(some(0.6) + Vec3::UnitZ()));
    axis_ = q_ * Vec3::UnitZ();
    aim_.z() = kTop_m - std::abs(aim_.z());
    speed_ = std::min(speed_, 2e-5);
  }

  Random random_;
  Vec3 p_{0, 0, kTop_m + 0.01}, aim_ = p_, axis_ = Vec3::UnitZ();
  Quat q_ = Quat::Identity();
  double speed_ = 0.0005, spin_ = 0;
};

const Drilling& all_that_remove() {
  static const Drilling made = [] {
    Drilling with("drill:3.2");
    for (const char* name : {"microdrill:4", "awl:8", "bone_curette:3", "osteotome:6",
                             "kerrison_punch:3", "cannulated_drill:6", "guide_pin:2.4"})
      with.also(name);
    return with;
  }();
  return made;
}

// Says how much was removed, mm^3.
void go_wild(std::uint64_t seed, int ticks, double& all_gone) {
  const Drilling& with = all_that_remove();
  Session session = with.session();
  WildHand hand(seed);
  const std::size_t most_blocks = session.carving()->field(0)->most_blocks();
  for (int n = 0; n < ticks; ++n) {
    const HandInput input = hand.next(with.settings.tray.size());
    (void)session.tick(std::span(&input, 1));
    const ToolState& tool = session.tool_state();
    ASSERT_TRUE(is_finite(tool.force_W) && is_finite(tool.X_WP)) << seed << " at " << n;
    ASSERT_LE(tool.force_W.norm(), with.settings.haptic.max_force_n + 1e-9) << seed << " at " << n;
    ASSERT_LE(session.carving()->field(0)->block_count(), most_blocks);
  }
  const CarvedField& field = *session.carving()->field(0);
  const double gone = 1e9 * total(removed_volume(field)), whole = 1e9 * 0.01 * 0.01 * 2 * kTop_m;
  EXPECT_TRUE(std::isfinite(gone) && gone >= 0 && gone < 1.02 * whole) << seed;
  all_gone += gone;
  const auto mesh = carved_mesh(field);
  ASSERT_TRUE(mesh) << mesh.error().message();
  EXPECT_TRUE(topology(*mesh).closed()) << seed;
  // What a hand has made can be stored and taken up again, bit by bit.
  const auto back = state_from_bytes(to_bytes(session.save()));
  ASSERT_TRUE(back) << back.error().message();
  Session other = with.session();
  ASSERT_TRUE(other.restore(*back));
  EXPECT_EQ(other.state_hash(), session.state_hash()) << seed;
}

TEST(CarvingAbuse, WildHandsLeaveASoundBoneAndNoForceBeyondTheProfile) {
  const bool is_long = std::getenv("OSTEON_LONG") != nullptr;
  const std::uint64_t hands = is_long ? 40 : 2;
  double gone = 0;
  for (std::uint64_t seed = 1; seed <= hands; ++seed) go_wild(seed, is_long ? 10000 : 3000, gone);
  // They do cut: a hand now and then next to nothing.
  EXPECT_GT(gone, 0.3 * static_cast<double>(hands));
}

}  // namespace
}  // namespace osteon
