#include "osteon/render/joint_room.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "osteon/mesh/decimate.h"
#include "surface/joint_wall.h"

namespace osteon {
namespace {

constexpr double kCoarse_m = 2e-4;  // the wall is smooth and centimetres away
constexpr double kWallCoarse_m =
    1e-4;  // of fewer triangles, which take a processor less time to draw

}  // namespace

struct JointRoom::Impl {
  std::vector<MeshDistance> surfaces;
  std::vector<std::string> names;
  std::vector<Pose> rest_X_WB;
  bool open = false;  ///< a box for exercises: nothing closes it
};

JointRoom::JointRoom(const Case& the_case) {
  auto impl = std::make_unique<Impl>();
  impl->open = the_case.name.starts_with("fast_");
  for (const Bone& bone : the_case.bones) {
    TriMesh coarse = bone.mesh;
    decimate(coarse, kCoarse_m);
    impl->surfaces.emplace_back(std::move(coarse));
    impl->names.push_back(bone.name);
    impl->rest_X_WB.push_back(bone.X_WB);
  }
  impl_ = std::move(impl);
}

JointRoom::~JointRoom() = default;
JointRoom::JointRoom(JointRoom&&) noexcept = default;
JointRoom& JointRoom::operator=(JointRoom&&) noexcept = default;

Result<TriMesh> JointRoom::wall(const BoneSnapshot& bones, const Vec3& tip_W) const {
  if (impl_->open) return TriMesh{};
  std::vector<WalledBone> stand;
  for (std::size_t k = 0; k < impl_->surfaces.size(); ++k) {
    const bool known = k < bones.count && is_finite(bones.bones[k].X_WB);
    stand.push_back(
        {&impl_->surfaces[k], known ? bones.bones[k].X_WB : impl_->rest_X_WB[k], &impl_->names[k]});
  }
  auto wall = joint_wall(stand, tip_W);
  if (wall) decimate(*wall, kWallCoarse_m);
  return wall;
}

}  // namespace osteon
