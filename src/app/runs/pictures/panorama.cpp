#include "runs/pictures/panorama.h"

#include "osteon/render/anatomical_view.h"

namespace osteon {
namespace {

constexpr float kClearBone = 0.42f;
constexpr std::array<float, 4> kYellow{1.0f, 0.86f, 0.16f, 0.30f};

}  // namespace

Result<Camera> panorama_camera(const Case& the_case, const std::string& side, double aspect) {
  Camera camera = preset_camera(ViewPreset::kDorsal, the_case, aspect);
  const AnatomicalFrame frame = anatomical_frame(the_case);
  if (side == "front") return camera;
  if (side == "top")
    camera.q_WC = look_rotation(frame.distal_W, frame.dorsal_W);
  else if (side == "left")
    camera.q_WC = look_rotation(-frame.distal_W.cross(frame.dorsal_W), frame.distal_W);
  else
    return fail("'" + side + "' is not a side", "the panorama", "Choose front, top or left");
  camera.target_W = the_case.bounds_W().empty() ? Vec3::Zero() : the_case.bounds_W().center();
  return camera;
}

ViewState panorama_view(const Case& the_case, const Camera& camera) {
  ViewState view = default_view(the_case);
  view.camera = camera;
  view.show_hand_ghost = false;
  view.show_force = false;
  for (BoneAppearance& bone : view.bones) bone.opacity = kClearBone;
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
