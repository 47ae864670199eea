#include "osteon/render/joint_roof.h"

#include <cstddef>
#include <utility>

#include "osteon/scene/soft_motion.h"
#include "surface/ray_bvh.h"

namespace osteon {

struct JointRoof::Surface {
  explicit Surface(const TriMesh& mesh) : rays(mesh.vertices, mesh.triangles) {
    for (const Triangle& t : mesh.triangles) {
      const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
      outward.push_back((b - a).cross(c - a).cast<float>());
    }
  }
  RayBvh rays;
  std::vector<Eigen::Vector3f> outward;  ///< of each triangle, of any length

  /// The first surface along a ray.
  struct Ray {
    Vec3 p_W, dir_W;
    double first_m;
    bool any = false, from_within = false;

    void meet(const Surface& surface, const Pose& X_WM) {
      const Pose X_MW = X_WM.inverse();
      const Vec3 dir_M = X_MW.rotate(dir_W);
      const auto hit = surface.rays.closest(X_MW * p_W, dir_M, first_m);
      if (!hit) return;
      first_m = hit->t;
      any = true;
      from_within = surface.outward[hit->triangle].dot(dir_M.cast<float>()) > 0;
    }
  };
};

namespace {

Vec3 middle_of(const TriMesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : mesh.vertices) sum += v;
  return mesh.vertices.empty() ? sum : sum / static_cast<double>(mesh.vertices.size());
}

}  // namespace

struct JointRoof::Parts {
  struct Soft {
    Surface surface;
    std::vector<std::size_t> rides_on;
    Vec3 middle = Vec3::Zero();  ///< at rest
  };
  std::vector<Surface> bones;
  std::vector<Soft> softs;
  std::vector<Pose> rest_X_WB;
};

struct JointRoof::Wall {
  Surface surface;
};

JointRoof::JointRoof(const Case& the_case) {
  auto parts = std::make_shared<Parts>();
  for (const Bone& bone : the_case.bones) {
    parts->bones.emplace_back(bone.mesh);
    parts->rest_X_WB.push_back(bone.X_WB);
  }
  for (const SoftPart& soft : the_case.softs) {
    if (soft.kind == "skin" || soft.kind == "fat") continue;
    Parts::Soft part{Surface(soft.mesh_W), {}, middle_of(soft.mesh_W)};
    for (const BoneId bone : soft.bones) part.rides_on.push_back(bone.index);
    parts->softs.push_back(std::move(part));
  }
  parts_ = std::move(parts);
}

JointRoof JointRoof::with_wall(const TriMesh& wall_W) const {
  JointRoof out = *this;
  out.wall_ = std::make_shared<const Wall>(Wall{Surface(wall_W)});
  return out;
}

// The wall is left from within everywhere.
std::optional<double> JointRoof::distance(const BoneSnapshot& bones, const Vec3& p_W,
                                          const Vec3& dir_W, double most_m) const {
  if (!is_finite(p_W)) return std::nullopt;
  Surface::Ray ray{p_W, dir_W, most_m};
  for (std::size_t k = 0; k < parts_->bones.size() && k < bones.count; ++k)
    if (is_finite(bones.bones[k].X_WB)) ray.meet(parts_->bones[k], bones.bones[k].X_WB);
  for (const Parts::Soft& soft : parts_->softs)
    ray.meet(soft.surface, mean_motion(bones, parts_->rest_X_WB, soft.rides_on, soft.middle));
  if (ray.from_within) return std::nullopt;
  if (wall_) ray.meet(wall_->surface, Pose{});
  return ray.any ? std::optional(ray.first_m) : std::nullopt;
}

}  // namespace osteon
