// How skin that bends with a knee is painted: the graphics card moves its vertices, so that neither
// surface nor light is made anew while the knee bends.
#include <algorithm>
#include <string>

#include "scene_painter.h"

namespace osteon {
namespace {

constexpr std::size_t kMostWholes = 4;  // as in surface.vert
// Of a knee that was made bent thigh and shank are one in its hollow; opened by more than this they
// should have parted there.
constexpr double kFar_rad = 1.05;
constexpr float kFarOpacity = 0.28f;
constexpr double kBent_rad = 0.17;

Eigen::Vector4f with(const Vec3& v, double w) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
          static_cast<float>(w)};
}

}  // namespace

std::optional<CoverMotion> ScenePainter::cover_motion(const RenderSnapshot& snapshot,
                                                      std::size_t k) const {
  const auto& cover = shared_->bones[k].cover;
  if (!cover) return {};
  const CoverMotion motion = cover->motion(snapshot.bones, shared_->rest_X_WB);
  if (motion.angle_rad == 0 && motion.along_m == 0) return {};
  return motion;
}

ViewState ScenePainter::with_far_covers_clear(const RenderSnapshot& snapshot,
                                              ViewState view) const {
  for (std::size_t i = 0; i < view.softs.size(); ++i) {
    const std::size_t k = shared_->rest_X_WB.size() + i;
    if (k >= shared_->bones.size()) break;
    const auto motion = cover_motion(snapshot, k);
    if (!motion) continue;
    if (motion->angle_rad > kFar_rad)
      view.softs[i].opacity = std::min(view.softs[i].opacity, kFarOpacity);
    // Skin that is bent does not follow the kneecap, which glides on the femur: it would stand out.
    const std::size_t kneecap = shared_->bones[k].cover->kneecap().index;
    const bool hides = view.softs[i].visible && view.softs[i].opacity >= 1;
    if (!hides || motion->angle_rad <= kBent_rad || kneecap >= shared_->rest_X_WB.size()) continue;
    if (kneecap >= view.bones.size()) view.bones.resize(kneecap + 1);
    view.bones[kneecap].visible = false;
  }
  return view;
}

std::array<Pose, 2> ScenePainter::end_poses(const RenderSnapshot& snapshot, std::size_t k) const {
  const Pose upper = pose(snapshot, k);
  const auto motion = cover_motion(snapshot, k);
  if (!motion) return {upper, upper};
  const Quat turn(Eigen::AngleAxisd(motion->angle_rad, motion->axis));
  return {upper, Pose{motion->moved(Vec3::Zero(), 1), upper.q * turn}};
}

void ScenePainter::set_cover(const Program& program, const LimbCover& cover,
                             const CoverMotion& motion) {
  const Vec3& n = cover.towards_lower_W();
  program.set("u_cover_axis", with(motion.axis, motion.angle_rad));
  program.set("u_cover_point", with(motion.point, motion.along_m));
  const Vec3& e = cover.forwards_W();
  program.set("u_cover_plane", with(n, n.dot(cover.middle_W())));
  program.set("u_cover_front", with(e, e.dot(cover.middle_W())));
  const auto narrow = [](double v) { return static_cast<float>(v); };
  program.set("u_cover_halves",
              Eigen::Vector3f(narrow(LimbCover::kHalfBehind_m), narrow(LimbCover::kHalfInFront_m),
                              narrow(LimbCover::kFront_m)));
  program.set("u_cover_reach",
              Eigen::Vector2f(narrow(LimbCover::kWholeTo_m), narrow(LimbCover::kWholeFrom_m)));
  Eigen::Vector4f shares = Eigen::Vector4f::Zero();
  const std::size_t count = std::min(cover.wholes().size(), kMostWholes);
  for (std::size_t i = 0; i < count; ++i) {
    const LimbCover::Whole& whole = cover.wholes()[i];
    program.set(("u_cover_wholes[" + std::to_string(i) + "]").c_str(), with(whole.center_W, 0));
    shares[static_cast<Eigen::Index>(i)] = static_cast<float>(whole.share);
  }
  program.set("u_cover_shares", shares);
  program.set("u_cover_count", static_cast<int>(count));
}

const Program& ScenePainter::begin_part(const Program& rigid, const Program& bending,
                                        const RenderSnapshot& snapshot, std::size_t k,
                                        const Frame& frame) const {
  const auto motion = cover_motion(snapshot, k);
  const Program& program = motion ? bending : rigid;
  program.use();
  program.set("u_view_from_model", to_matrix(frame.X_CW * pose(snapshot, k)));
  if (motion) set_cover(program, *shared_->bones[k].cover, *motion);
  return program;
}

}  // namespace osteon
