#pragma once

#include <cstdint>
#include <vector>

#include "osteon/scene/graft_bench.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What is seen of tendons and graft at a bench: round rods in World.
struct BenchRod {
  enum class Is : std::uint8_t {
    kTendon,
    kUnderSkin,
    kMuscle,
    kBand,
    kThread,
    kLoop,
    kButton,
    kFascia,  ///< the lips of its slit
    kSlit,    ///< what is seen between them
    kMark     ///< along which it is to be opened
  };
  Is is = Is::kTendon;
  Vec3 a_W = Vec3::Zero(), b_W = Vec3::Zero();
  double radius_m = 0;
};

/// The fascia's slit and the mark for it; a tendon's course and its bands under the skin, what a
/// stripper has freed of it; once it is out, the tendon on the table with what is left of its
/// muscle and with its stitches; once it is folded, the strands in the holder with loop and button.
/// Empty: nothing is at the bench, as when the graft hangs on the thread in the knee. A function of
/// the plan and the snapshot.
std::vector<BenchRod> bench_rods(const GraftBenchPlan& plan, const BoneSnapshot& bones);

}  // namespace osteon
