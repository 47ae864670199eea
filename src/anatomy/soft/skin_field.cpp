#include "soft/skin_field.h"

#include <utility>

#include "bone/nearby_surface.h"

namespace osteon {

SkinField::SkinField(const SkinDescription& skin, const std::vector<BoneDescription>& bones,
                     const std::vector<Pose>& poses)
    : offset_(skin.offset), blend_(skin.blend) {
  std::vector<const Part*> flesh;
  Solid all;
  for (const BoundPart& part : skin.parts)
    (part.part.operation == Operation::kAdd ? flesh : cuts_).push_back(&part.part);
  flesh_ = NearSolid(flesh);
  for (const Part* part : flesh) all.parts.push_back(*part);
  box_W_ = bounds(all);
  const Vec3 margin = Vec3::Constant(skin.offset + 0.5 * skin.blend);
  for (std::size_t i = 0; i < bones.size(); ++i) {
    bones_.push_back(place(bones[i], poses[i]));
    box_W_.include(bones_.back().box_W.lo - margin);
    box_W_.include(bones_.back().box_W.hi + margin);
  }
}

SkinField::Bone SkinField::place(const BoneDescription& bone, const Pose& X_WB) {
  const Mat3 R_WB = X_WB.q.toRotationMatrix();
  Bone placed{NearSolid(bone.solid), {}, R_WB.transpose(), {}};
  placed.p_BW = -(placed.R_BW * X_WB.p);
  const Aabb box_B = bounds(bone.solid);
  const Vec3 center_W = R_WB * box_B.center() + X_WB.p;
  const Vec3 half = R_WB.cwiseAbs() * (0.5 * box_B.extent());
  placed.box_W = {center_W - half, center_W + half};
  return placed;
}

double SkinField::at(const Vec3& p_W) const {
  double d = flesh_(p_W);
  for (const Bone& bone : bones_) {
    if (distance_to_box(p_W, bone.box_W) - offset_ > d + blend_) continue;
    const Vec3 p_B = bone.R_BW * p_W + bone.p_BW;
    d = smooth_min(d, bone.solid(p_B) - offset_, blend_);
  }
  for (const Part* cut : cuts_) d = less(d, *cut, p_W);
  return d;
}

LocalField::Near SkinField::near(const Vec3& center_W, double radius) const {
  const Vicinity where_W{center_W, radius};
  Spread values;
  auto here = std::make_unique<SkinField>();
  here->offset_ = offset_;
  here->blend_ = blend_;
  here->flesh_ = flesh_.within(where_W, values);
  here->keep_bones(*this, where_W, values);
  here->keep_cuts(*this, where_W, values);
  return {values.sign(), std::move(here)};
}

void SkinField::keep_bones(const SkinField& from, const Vicinity& where_W, Spread& values) {
  for (const Bone& bone : from.bones_) {
    const double away = distance_to_box(where_W.center, bone.box_W) - offset_;
    // Nothing of the box lies near enough to be asked for.
    if (away - where_W.radius > values.most + blend_) continue;
    Spread own;
    const Vec3 center_B = bone.R_BW * where_W.center + bone.p_BW;
    const NearSolid solid = bone.solid.within({center_B, where_W.radius}, own);
    own = {own.least - offset_, own.most - offset_};
    if (surely_less(values, own, blend_)) continue;
    const Spread both = smooth_min(values, own, blend_);
    const bool throughout = away + where_W.radius < values.least + blend_;
    values = {both.least, throughout ? both.most : values.most};
    bones_.push_back({solid, bone.box_W, bone.R_BW, bone.p_BW});
  }
}

void SkinField::keep_cuts(const SkinField& from, const Vicinity& where_W, Spread& values) {
  for (const Part* cut : from.cuts_) {
    const Spread own = spread(cut->primitive, where_W);
    if (surely_less(negated(values), own, cut->blend)) continue;
    values = smooth_max(values, negated(own), cut->blend);
    cuts_.push_back(cut);
  }
}

}  // namespace osteon
