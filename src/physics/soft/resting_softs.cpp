#include "soft/resting_softs.h"

#include <algorithm>

#include "soft/solid_presses.h"

namespace osteon {

void RestingSofts::place(const BoneSnapshot& bones) {
  for (std::size_t b = 0; b < setup_.bands.size(); ++b) {
    const SoftBand& band = setup_.bands[b];
    spans_[b] = {bones.bones[band.from.index].X_WB * band.from_B,
                 bones.bones[band.to.index].X_WB * band.to_B};
  }
  for (std::size_t s = 0; solids_ && s < setup_.solids.size(); ++s) {
    X_WB_[s] = bones.bones[setup_.solids[s].bone.index].X_WB;
    X_BW_[s] = X_WB_[s].inverse();
  }
}

bool RestingSofts::may_meet(const Vec3& center_W, double radius_m) const {
  for (std::size_t s = 0; solids_ && s < setup_.solids.size(); ++s)
    if (is_there(s) && in_box(solids_->view(s).box().grown(radius_m), X_BW_[s] * center_W))
      return true;
  for (std::size_t b = 0; b < setup_.bands.size(); ++b)
    if (is_whole(b) && off_band(b, center_W).norm() <= setup_.bands[b].radius_m + radius_m)
      return true;
  return false;
}

PiecePush RestingSofts::at(const Vec3& p_W) const {
  PiecePush out;
  for (std::size_t s = 0; solids_ && s < setup_.solids.size(); ++s) in_solid(s, p_W, out);
  for (std::size_t b = 0; b < setup_.bands.size(); ++b) in_band(b, p_W, out);
  return out;
}

bool RestingSofts::is_there(std::size_t s) const {
  return !state_.solid_lost[s] && is_finite(X_WB_[s]);
}

bool RestingSofts::is_whole(std::size_t b) const {
  return setup_.bands[b].left > 0 && !state_.bands[b].torn && !state_.bands[b].lost;
}

void RestingSofts::in_solid(std::size_t s, const Vec3& p_W, PiecePush& out) const {
  if (!is_there(s)) return;
  const FieldView field = solids_->view(s);
  const Vec3 p_B = X_BW_[s] * p_W;
  if (!in_box(field.box(), p_B)) return;
  const FieldSample at = field.at(p_B);
  const double slope = at.gradient.norm();
  if (!(-at.distance > out.depth_m) || !(slope > 0)) return;
  out = {-at.distance, X_WB_[s].rotate(at.gradient / slope)};
}

// From the string's middle line, straight from bone to bone.
Vec3 RestingSofts::off_band(std::size_t b, const Vec3& p_W) const {
  const Vec3 way = spans_[b].b_W - spans_[b].a_W;
  const double share = std::clamp((p_W - spans_[b].a_W).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return p_W - (spans_[b].a_W + share * way);
}

void RestingSofts::in_band(std::size_t b, const Vec3& p_W, PiecePush& out) const {
  if (!is_whole(b)) return;
  const double radius_m = setup_.bands[b].radius_m;
  const Vec3 off = off_band(b, p_W);
  const double away = off.norm();
  if (radius_m - away > out.depth_m && away > 1e-9)
    out = {radius_m - away, off / away, 1 - away / radius_m};
}

}  // namespace osteon
