#include "window/jobs/window_jobs.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "osteon/hull/hull.h"

namespace osteon {
namespace {

using FeltJob = SideJob<PreparedCase>;

/// A tetrahedron felt as one that is twice as large, at every place.
std::shared_ptr<const Case> one_bone() {
  Bone bone;
  const std::vector<Vec3> corners{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}};
  bone.mesh.vertices = corners;
  bone.mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::vector<Vec3> larger;
  for (const Vec3& p : corners) larger.push_back(2 * p - Vec3::Constant(0.002));
  bone.pieces = {*build_hull(larger).hull};
  auto out = std::make_shared<Case>();
  out->bones.push_back(std::move(bone));
  return out;
}

TEST(FeltJob, ACaseWithoutBones) {
  FeltJob job(measure_felt(std::make_shared<Case>(), {}));
  job.wait();
  const auto measured = job.take();
  ASSERT_TRUE(measured);
  EXPECT_TRUE(measured->bones.empty());
}

TEST(FeltJob, GivesWhatPrepareFeltGives) {
  const auto the_case = one_bone();
  PreparedCase expected = prepare_case(*the_case);
  FeltJob job(measure_felt(the_case, expected));
  job.wait();
  EXPECT_DOUBLE_EQ(job.progress().fraction, 1);
  prepare_felt(*the_case, expected);
  const auto taken = job.take();
  ASSERT_TRUE(taken);
  const PreparedCase& got = *taken;
  ASSERT_EQ(got.bones.size(), 1u);
  ASSERT_FALSE(got.bones[0].shades.empty());
  for (std::size_t v = 0; v < got.bones[0].shades.size(); ++v) {
    EXPECT_EQ(got.bones[0].shades[v].felt, expected.bones[0].shades[v].felt);
    EXPECT_GT(got.bones[0].shades[v].felt, 128);
  }
}

TEST(FeltJob, MayBeLeftBeforeItIsDone) {
  auto the_case = one_bone();
  const std::weak_ptr<const Case> watched = the_case;
  {
    auto work = measure_felt(the_case, prepare_case(*the_case));
    the_case.reset();
    EXPECT_FALSE(watched.expired()) << "the work holds what it works on";
    const FeltJob job(std::move(work));
  }
  EXPECT_TRUE(watched.expired()) << "its thread has ended and holds nothing any more";
}

}  // namespace
}  // namespace osteon
