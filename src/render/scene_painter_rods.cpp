// Pins that stay in bone and sleeves of aimers, and the lines along which they lead.
#include "scene_painter.h"

namespace osteon {
namespace {

const Eigen::Vector4f kRodSteel(0.62f, 0.65f, 0.69f, 1.0f);
constexpr double kSleeveWall_m = 0.0015;
constexpr double kLineRadius_m = 0.0005;
constexpr float kLineBehindBone = 0.5f;  // opacity: it lies in bone for the most part
constexpr double kLineBeyond_m = 0.06;   // the line goes on into the bone so far

struct DrawnRod {
  Pose X_WR;
  double radius_m = 0, length_m = 0;
};

// The sleeve of an aimer stays fixed until another takes its place. With a graft in the tunnels it
// leads nothing any more, and its line would cross the picture to the end.
bool is_drawn(const GuideRod& rod, const BoneSnapshot& bones) {
  if (rod.kind == GuideRod::Kind::kNone || rod.bone >= bones.count) return false;
  return rod.kind != GuideRod::Kind::kSleeve || !bones.placing.on;
}

std::vector<DrawnRod> drawn_rods(const BoneSnapshot& bones) {
  std::vector<DrawnRod> out;
  for (const GuideRod& rod : bones.rods) {
    if (!is_drawn(rod, bones)) continue;
    const bool sleeve = rod.kind == GuideRod::Kind::kSleeve;
    // What of a sleeve is near the bone is not there: it ends where the bone begins.
    const double from = sleeve ? 0.5 * rod.length_m : 0;
    Pose X_WR = bones.bones[rod.bone].X_WB * rod.X_BR;
    X_WR.p += X_WR.rotate(Vec3(0, 0, from));
    if (!is_finite(X_WR) || !(rod.length_m > from)) continue;
    out.push_back({X_WR, rod.radius_m + (sleeve ? kSleeveWall_m : 0), rod.length_m - from});
  }
  return out;
}

// From where the rod's inner end is, on into the bone, and out along the rod.
std::vector<DrawnRod> drawn_lines(const BoneSnapshot& bones) {
  std::vector<DrawnRod> out;
  for (const GuideRod& rod : bones.rods) {
    if (!is_drawn(rod, bones)) continue;
    Pose X_WR = bones.bones[rod.bone].X_WB * rod.X_BR;
    X_WR.p -= X_WR.rotate(Vec3(0, 0, kLineBeyond_m));
    if (is_finite(X_WR)) out.push_back({X_WR, kLineRadius_m, kLineBeyond_m + rod.length_m});
  }
  return out;
}

}  // namespace

std::vector<ScenePainter::Capsule> ScenePainter::rod_capsules(const RenderSnapshot& snapshot) {
  std::vector<Capsule> out;
  for (const auto& list : {drawn_rods(snapshot.bones), drawn_lines(snapshot.bones)})
    for (const DrawnRod& rod : list)
      out.push_back({rod.X_WR.p, rod.X_WR * Vec3(0, 0, rod.length_m), rod.radius_m});
  return out;
}

void ScenePainter::paint_rods(const RenderSnapshot& snapshot, const Frame& frame) const {
  for (const DrawnRod& rod : drawn_rods(snapshot.bones)) {
    shared_->metal.use();
    shared_->metal.set("u_view_from_model",
                       scaled(frame.X_CW * rod.X_WR, rod.radius_m, rod.length_m));
    shared_->metal.set("u_color", kRodSteel);
    shared_->shaft.draw();
  }
}

void ScenePainter::paint_lines(const RenderSnapshot& snapshot, const Frame& frame) const {
  const std::vector<DrawnRod> lines = drawn_lines(snapshot.bones);
  if (lines.empty()) return;
  shared_->mark.use();
  shared_->mark.set("u_form", 0.25f);
  shared_->mark.set("u_edge", 0.0f);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  for (const DrawnRod& line : lines)
    paint_mark(shared_->shaft, scaled(frame.X_CW * line.X_WR, line.radius_m, line.length_m),
               kLineBehindBone);
  glDisable(GL_CULL_FACE);
}

}  // namespace osteon
