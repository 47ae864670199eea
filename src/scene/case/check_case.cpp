#include <cmath>
#include <set>

#include "case/hull_height.h"
#include "case/mesh_indices.h"
#include "case/soft_parts.h"
#include "numbers.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/self_crossing.h"
#include "osteon/scene/bone_size.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

constexpr double kFarthestLandmark_m = 0.5;

class Findings {
 public:
  void add(const std::string& subject, const std::string& what) {
    lines_.push_back(subject + ": " + what);
  }
  std::vector<std::string> take() { return std::move(lines_); }

 private:
  std::vector<std::string> lines_;
};

void check_mesh(const BoneDef& bone, Findings& found) {
  const Topology shape = topology(bone.mesh);
  if (bone.mesh.triangles.empty()) return found.add(bone.name, "the mesh has no triangles");
  if (shape.boundary_edges > 0)
    found.add(bone.name,
              "the mesh is open (" + std::to_string(shape.boundary_edges) +
                  " edges have one triangle only), so it is felt as its convex hull, up to " +
                  in_mm(std::round(1e5 * hull_height(bone.mesh)) / 1e5) +
                  " off. Close it where the scan cut it, and import it again");
  if (shape.non_manifold_edges > 0)
    found.add(bone.name,
              std::to_string(shape.non_manifold_edges) + " edges have more than two triangles");
  if (shape.misoriented_edges > 0)
    found.add(bone.name,
              "triangles face both ways at " + std::to_string(shape.misoriented_edges) + " edges");
  if (shape.closed() && !(volume(bone.mesh) > 0)) found.add(bone.name, "the mesh is inside out");
}

// What an import refuses unless it is forced: volume and mass count the common room twice.
void check_parts(const BoneDef& bone, Findings& found) {
  const auto pair = crossing_parts(bone.mesh);
  if (!pair) return;
  found.add(bone.name, "parts of the mesh pass through each other (triangles " +
                           std::to_string(pair->first) + " and " + std::to_string(pair->second) +
                           "), so its volume and mass are wrong. Merge them into one surface and "
                           "import it again");
}

void check_size(const BoneDef& bone, Findings& found) {
  const Aabb box = bounds(bone.mesh);
  if (box.empty()) return;
  const double size = std::round(1e4 * box.extent().maxCoeff()) / 1e4;
  const BoneSize any;
  if (const std::string complaint = size_complaint(bone.name, size); !complaint.empty())
    found.add(bone.name, complaint);
  else if (size < any.least_m || size > any.most_m)
    found.add(bone.name, "is " + in_mm(size) + " long, so the unit may be wrong");
}

void check_material(const BoneDef& bone, Findings& found) {
  const Material& m = bone.material;
  if (!(m.stiffness_n_per_m >= 50 && m.stiffness_n_per_m <= 20'000))
    found.add(bone.name, "the stiffness is not between 50 and 20 000 N/m");
  if (!(m.static_friction >= 0 && m.static_friction <= 1))
    found.add(bone.name, "the static friction is not between 0 and 1");
  if (!(m.dynamic_friction >= 0 && m.dynamic_friction <= m.static_friction))
    found.add(bone.name, "the dynamic friction is not between 0 and the static one");
  if (!(bone.density_kg_per_m3 >= 200 && bone.density_kg_per_m3 <= 3000))
    found.add(bone.name, "the density is not between 200 and 3000 kg/m3");
}

void check_pose(const BoneDef& bone, Findings& found) {
  if (!is_finite(bone.X_WB) || std::abs(bone.X_WB.q.norm() - 1) > 1e-6)
    found.add(bone.name, "the pose is not finite with a unit quaternion");
}

void check_landmarks(const CaseDef& def, Findings& found) {
  Aabb box;
  for (const BoneDef& bone : def.bones)
    for (const Vec3& p_B : bone.mesh.vertices) box.include(bone.X_WB * p_B);
  const Aabb near = box.grown(kFarthestLandmark_m);
  std::set<std::string> names;
  for (const Landmark& landmark : def.landmarks) {
    const std::string subject = "landmark " + landmark.name;
    if (!names.insert(landmark.name).second) found.add(subject, "the name is used twice");
    if (!near.overlaps({landmark.p_W, landmark.p_W}))
      found.add(subject, "lies more than " + in_mm(kFarthestLandmark_m) + " from the bones");
  }
}

}  // namespace

std::vector<std::string> check_case(const CaseDef& def) {
  Findings found;
  if (def.bones.empty()) found.add("case", "it has no bones");
  if (def.bones.size() > kMaxBones) found.add("case", "it has too many bones");
  if (def.side != "left" && def.side != "right" && !def.side.empty())
    found.add("case", "the side is neither left nor right");
  std::set<std::string> names;
  for (const BoneDef& bone : def.bones) {
    if (!names.insert(bone.name).second) found.add(bone.name, "the name is used twice");
    check_pose(bone, found);
    if (indices_fit(bone.mesh)) {
      check_mesh(bone, found);
      check_parts(bone, found);
    } else {
      found.add(bone.name, "a triangle refers to a vertex that does not exist");
    }
    check_size(bone, found);
    check_material(bone, found);
  }
  check_landmarks(def, found);
  std::vector<std::string> findings = found.take();
  for (std::string& finding : check_softs(def)) findings.push_back(std::move(finding));
  return findings;
}

}  // namespace osteon
