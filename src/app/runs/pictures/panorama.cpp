#include "runs/pictures/panorama.h"

#include "osteon/render/anatomical_view.h"
#include "osteon/scene/graft_bench.h"

namespace osteon {
namespace {

constexpr float kClearBone = 0.42f;
constexpr std::array<float, 4> kYellow{1.0f, 0.86f, 0.16f, 0.30f};

// What is operated on. Of a knee that is cut off near the joint the long fibula would make it small
// in the picture.
Aabb seen_whole(const Case& the_case) {
  constexpr double kMuchSmaller = 0.7;
  const Aabb all = the_case.bounds_W();
  Aabb knee;
  for (const char* name : {"femur", "tibia", "patella"}) {
    const BoneId id = the_case.find(name);
    if (!id.valid()) return all;
    const Bone& bone = the_case.bone(id);
    for (const Vec3& p_B : bone.mesh.vertices) knee.include(bone.X_WB * p_B);
  }
  return knee.extent().norm() < kMuchSmaller * all.extent().norm() ? knee : all;
}

}  // namespace

Result<Camera> panorama_camera(const Case& the_case, const std::string& side, double aspect) {
  Camera camera = preset_camera(ViewPreset::kDorsal, the_case, aspect);
  const AnatomicalFrame frame = anatomical_frame(the_case);
  const Aabb seen = seen_whole(the_case);
  const double share =
      seen.empty() ? 1 : seen.extent().norm() / the_case.bounds_W().extent().norm();
  if (share < 1) {
    camera.target_W = seen.center();
    camera.distance_m *= share;
  }
  if (side == "front") return camera;
  if (side == "top")
    camera.q_WC = look_rotation(frame.distal_W, frame.dorsal_W);
  else if (side == "left")
    camera.q_WC = look_rotation(-frame.distal_W.cross(frame.dorsal_W), frame.distal_W);
  else
    return fail("'" + side + "' is not a side", "the panorama", "Choose front, top or left");
  camera.target_W = seen.empty() ? Vec3::Zero() : seen.center();
  return camera;
}

ViewState panorama_view(const Case& the_case, const Camera& camera) {
  ViewState view = default_view(the_case);
  view.camera = camera;
  view.show_hand_ghost = false;
  view.show_force = false;
  const bool has_bench = find_graft_bench(the_case).has_value();
  for (std::size_t k = 0; k < view.bones.size(); ++k) {
    view.bones[k].opacity = kClearBone;
    // What lies on a bench is in no anatomy.
    if (has_bench && the_case.bones[k].fma_id == 0) view.bones[k].visible = false;
  }
  for (std::size_t k = 0; k < the_case.softs.size(); ++k) {
    const std::string& kind = the_case.softs[k].kind;
    view.softs[k].visible = kind == "meniscus" || kind == "disc";
    view.softs[k].opacity = kClearBone;
  }
  return view;
}

std::vector<SolidMark> sight_marks(const Lenses& lenses, std::span<const ToolState> tools) {
  std::vector<SolidMark> cones;
  for (const ToolState& tool : tools)
    if (const ScopeDef* held = lens_of_tool(lenses, tool))
      cones.push_back({sight_cone(tool.X_WP, *held), kYellow});
  return cones;
}

}  // namespace osteon
