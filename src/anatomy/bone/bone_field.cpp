#include "bone/bone_field.h"

#include <utility>

namespace osteon {
namespace {

bool holds(const Aabb& outer, const Aabb& inner) {
  return outer.overlaps({inner.lo, inner.lo}) && outer.overlaps({inner.hi, inner.hi});
}

}  // namespace

BoneField::BoneField(const AnatomyDescription& anatomy, const BoneDescription& bone)
    : bone_(bone), solid_(bone.solid) {
  for (const Clearance& c : bone.clearances)
    neighbours_.push_back(neighbour(anatomy.bones[c.other_bone], bone, c));
  for (const BoundPart& defect : bone.defects) defects_.push_back(&defect.part);
}

BoneField::Neighbour BoneField::neighbour(const BoneDescription& other, const BoneDescription& bone,
                                          const Clearance& c) {
  Neighbour n;
  n.solid = NearSolid(other.solid);
  n.reach_N = bounds(other.solid).grown((c.gap + c.blend) * stretch(other.solid));
  n.R_NB = other.R_WB.transpose() * bone.R_WB;
  n.p_NB = other.R_WB.transpose() * (bone.p_WB - other.p_WB);
  n.gap = c.gap;
  n.blend = c.blend;
  return n;
}

double BoneField::at(const Vec3& p_B) const {
  double d = solid_(p_B);
  for (const Neighbour& n : neighbours_) {
    const Vec3 p_N = n.R_NB * p_B + n.p_NB;
    if (n.reach_N.overlaps({p_N, p_N})) d = smooth_max(d, n.gap - n.solid(p_N), n.blend);
  }
  if (defects_.empty()) return d;
  const Vec3 p_W = bone_.R_WB * p_B + bone_.p_WB;
  for (const Part* defect : defects_) d = less(d, *defect, p_W);
  return d;
}

LocalField::Near BoneField::near(const Vec3& center_B, double radius) const {
  const Vicinity where_B{center_B, radius};
  Spread values;
  auto here = std::unique_ptr<BoneField>(new BoneField(bone_));
  here->solid_ = solid_.within(where_B, values);
  if (values.least > 0) return {1};  // hollows and defects only raise it
  here->keep_neighbours(*this, where_B, values);
  here->keep_defects(*this, where_B, values);
  return {values.sign(), std::move(here)};
}

void BoneField::keep_neighbours(const BoneField& from, const Vicinity& where_B, Spread& values) {
  for (const Neighbour& n : from.neighbours_) {
    const Vicinity where_N{n.R_NB * where_B.center + n.p_NB, where_B.radius};
    const Aabb box_N = Aabb{where_N.center, where_N.center}.grown(where_B.radius);
    if (!n.reach_N.overlaps(box_N)) continue;
    Spread to_other;
    const NearSolid solid = n.solid.within(where_N, to_other);
    const Spread hollow{n.gap - to_other.most, n.gap - to_other.least};
    if (surely_less(negated(values), negated(hollow), n.blend)) continue;
    const Spread both = smooth_max(values, hollow, n.blend);
    const bool throughout = holds(n.reach_N, box_N);
    values = {throughout ? both.least : values.least, both.most};
    neighbours_.push_back({solid, n.reach_N, n.R_NB, n.p_NB, n.gap, n.blend});
  }
}

void BoneField::keep_defects(const BoneField& from, const Vicinity& where_B, Spread& values) {
  const Vicinity where_W{bone_.R_WB * where_B.center + bone_.p_WB, where_B.radius};
  for (const Part* defect : from.defects_) {
    const Spread own = spread(defect->primitive, where_W);
    if (surely_less(negated(values), own, defect->blend)) continue;
    values = smooth_max(values, negated(own), defect->blend);
    defects_.push_back(defect);
  }
}

}  // namespace osteon
