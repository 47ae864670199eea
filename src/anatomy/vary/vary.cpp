#include "vary/vary.h"

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "vary/vary_bound.h"

namespace osteon {
namespace {

/// Maps of a primitive's places and directions, in the frame of its bone.
struct Bend {
  const TurnStep& step;
  double units;
  const BoneDescription& bone;

  Mat3 R_at(const Vec3& p_W) const {
    const double t = std::clamp((step.none_x - p_W.x()) / (step.none_x - step.full_x), 0.0, 1.0);
    const double share = t * t * (3 - 2 * t);
    return rotation_xyz_deg(step.degrees_per_unit * (units * share));
  }
  Vec3 to_W(const Vec3& p_B) const { return bone.R_WB * p_B + bone.p_WB; }
  Vec3 moved(const Vec3& p_B) const {
    const Vec3 p_W = to_W(p_B);
    const Vec3 turned_W = R_at(p_W) * (p_W - step.pivot_W) + step.pivot_W;
    return bone.R_WB.transpose() * (turned_W - bone.p_WB);
  }
  Mat3 turn_B(const Vec3& p_B) const { return bone.R_WB.transpose() * R_at(to_W(p_B)) * bone.R_WB; }

  void operator()(Ellipsoid& e) const { turn_about_center(e.center, e.R_local); }
  void operator()(RoundedBox& b) const { turn_about_center(b.center, b.R_local); }
  void operator()(HalfSpace& h) const {
    h.normal = turn_B(h.point) * h.normal;
    h.point = moved(h.point);
  }
  void operator()(Crack& c) const {
    c.normal = turn_B(c.point) * c.normal;
    c.point = moved(c.point);
  }
  void operator()(Tube& t) const {
    for (Vec3& p : t.points) p = moved(p);
    find_reach(t);
  }

 private:
  void turn_about_center(Vec3& center, Mat3& R_local) const {
    R_local = R_local * turn_B(center).transpose();
    center = moved(center);
  }
};

struct Shifter {
  Vec3 by_B;
  void operator()(Ellipsoid& e) const { e.center += by_B; }
  void operator()(RoundedBox& b) const { b.center += by_B; }
  void operator()(HalfSpace& h) const { h.point += by_B; }
  void operator()(Crack& c) const { c.point += by_B; }
  void operator()(Tube& t) const {
    for (Vec3& p : t.points) p += by_B;
  }
};

/// About the bone's origin.
struct Scaler {
  double s;
  void operator()(Ellipsoid& e) const {
    e.center *= s;
    e.radii *= s;
  }
  void operator()(RoundedBox& b) const {
    b.center *= s;
    b.half *= s;
    b.round *= s;
  }
  void operator()(HalfSpace& h) const { h.point *= s; }
  void operator()(Crack& c) const {
    c.point *= s;
    c.gap *= s;
    c.rough *= s;
    c.grain *= s;
  }
  void operator()(Tube& t) const {
    for (Vec3& p : t.points) p *= s;
    for (double& r : t.radii) r *= s;
    find_reach(t);
  }
};

/// Calls `act` with the bone's parts that the targets name, all where they name none.
template <class Act>
void for_parts(BoneDescription& bone, const StepTargets& targets, const Act& act) {
  for (Part& part : bone.solid.parts)
    if (targets.parts.empty() ||
        std::find(targets.parts.begin(), targets.parts.end(), part.name) != targets.parts.end())
      act(part);
}

void shift_parts(BoneDescription& bone, const StepTargets& targets, const Vec3& by_W) {
  const Vec3 by_B = bone.R_WB.transpose() * by_W;
  for_parts(bone, targets, [&](Part& part) { std::visit(Shifter{by_B}, part.primitive); });
}

void scale_parts(BoneDescription& bone, const StepTargets& targets, const Vec3& center_W,
                 double s) {
  const Vec3 center_B = bone.R_WB.transpose() * (center_W - bone.p_WB);
  const Vec3 back_B = center_B - s * center_B;
  for_parts(bone, targets, [&](Part& part) {
    std::visit(Scaler{s}, part.primitive);
    std::visit(Shifter{back_B}, part.primitive);
    part.blend *= s;
  });
}

void scale_bone(BoneDescription& bone, const Vec3& center_W, double s) {
  bone.p_WB = center_W + s * (bone.p_WB - center_W);
  for (Part& part : bone.solid.parts) {
    std::visit(Scaler{s}, part.primitive);
    part.blend *= s;
  }
  for (Clearance& c : bone.clearances) {
    c.gap *= s;
    c.blend *= s;
  }
}

/// Calls `act` with each item that is named, or with all for "*"; says which name is not there.
template <class Item, class Act>
Result<void> for_each_named(std::vector<Item>& items, const std::vector<std::string>& names,
                            const std::string& kind, const Act& act) {
  for (const std::string& name : names) {
    bool found = false;
    for (Item& item : items)
      if (name == "*" || item.name == name) {
        act(item);
        found = true;
      }
    if (!found) return fail("names no " + kind + " of the description: '" + name + "'");
  }
  return {};
}

/// The first named part that no named bone has.
Result<void> find_parts(const AnatomyDescription& anatomy, const StepTargets& targets) {
  for (const std::string& name : targets.parts) {
    bool found = false;
    for (const BoneDescription& bone : anatomy.bones)
      for (const Part& part : bone.solid.parts)
        found = found || (part.name == name && std::find(targets.bones.begin(), targets.bones.end(),
                                                         bone.name) != targets.bones.end());
    if (!found) return fail("names no part of its bones: '" + name + "'");
  }
  return {};
}

/// Landmarks that are bound to a bone move with it instead, by `move_bound`.
template <class OnBone, class OnLandmark>
Result<void> for_targets(AnatomyDescription& anatomy, const StepTargets& targets,
                         const OnBone& on_bone, const OnLandmark& on_landmark,
                         const BoundMove& bound) {
  if (auto ok = find_parts(anatomy, targets); !ok) return ok;
  if (auto ok = for_each_named(anatomy.bones, targets.bones, "bone", on_bone); !ok) return ok;
  if (targets.parts.empty()) move_bound(anatomy, targets.bones, bound);
  return for_each_named(anatomy.landmarks, targets.landmarks, "landmark",
                        [&](LandmarkDescription& landmark) {
                          if (!landmark.bone) on_landmark(landmark);
                        });
}

Result<void> apply(AnatomyDescription& anatomy, const TurnStep& step, double units) {
  const BoneDescription world{};
  const Bend bend{step, units, world};
  return for_targets(
      anatomy, step.targets,
      [&](BoneDescription& bone) {
        for_parts(bone, step.targets, [&](Part& part) {
          std::visit(Bend{step, units, bone}, part.primitive);
        });
      },
      [&](LandmarkDescription& landmark) { landmark.p_W = bend.moved(landmark.p_W); },
      {[&](const Vec3& p_W) { return bend.moved(p_W); },
       [&](Primitive& part) { std::visit(bend, part); }});
}

Result<void> apply(AnatomyDescription& anatomy, const ShiftStep& step, double units) {
  const Vec3 by_W = step.metres_per_unit * units;
  return for_targets(
      anatomy, step.targets,
      [&](BoneDescription& bone) {
        if (step.targets.parts.empty())
          bone.p_WB += by_W;
        else
          shift_parts(bone, step.targets, by_W);
      },
      [&](LandmarkDescription& landmark) { landmark.p_W += by_W; },
      {[&](const Vec3& p_W) { return Vec3(p_W + by_W); },
       [&](Primitive& part) { std::visit(Shifter{by_W}, part); }});
}

Result<void> apply(AnatomyDescription& anatomy, const ScaleStep& step, double units) {
  const double s = 1 + step.share_per_unit * units;
  if (s < 0.1 || s > 10) return fail("scales by " + std::to_string(s) + ", out of 0.1 to 10");
  const auto scaled = [&](const Vec3& p) { return Vec3(step.center_W + s * (p - step.center_W)); };
  return for_targets(
      anatomy, step.targets,
      [&](BoneDescription& bone) {
        if (step.targets.parts.empty())
          scale_bone(bone, step.center_W, s);
        else
          scale_parts(bone, step.targets, step.center_W, s);
      },
      [&](LandmarkDescription& landmark) { landmark.p_W = scaled(landmark.p_W); },
      {scaled,
       [&](Primitive& part) {
         std::visit(Scaler{s}, part);
         std::visit(Shifter{scaled(Vec3::Zero())}, part);
       },
       s});
}

Result<void> bend(AnatomyDescription& anatomy, const std::string& name, double degrees) {
  for (RollingJoint& joint : anatomy.joints) {
    if (joint.name != name) continue;
    const double most = joint.step_deg * (static_cast<double>(joint.inward_deg.size()) - 1);
    if (degrees < 0 || degrees > most) return fail("bends a joint beyond its tables");
    joint.at_deg = degrees;
    return {};
  }
  return fail("names no joint of the description: '" + name + "'");
}

Result<void> apply_rule(AnatomyDescription& anatomy, const VariationRule& rule, double units) {
  const auto all = [&](const auto& steps) -> Result<void> {
    for (const auto& step : steps)
      if (auto ok = apply(anatomy, step, units); !ok) return ok;
    return {};
  };
  if (auto ok = all(rule.turns); !ok) return ok;
  if (auto ok = all(rule.shifts); !ok) return ok;
  return all(rule.scales);
}

}  // namespace

Result<void> vary(AnatomyDescription& anatomy, const VariationTable& table,
                  const std::vector<double>& values) {
  const VariationRule& size = table.rules[table.overall_size];
  const double size_units = values[table.overall_size] - size.parameter.built_in;
  const double size_factor = 1 + size.scales[0].share_per_unit * size_units;
  const auto act = [&](std::size_t i) -> Result<void> {
    const VariationParameter& p = table.rules[i].parameter;
    // Millimetres are those of the finished anatomy, which the overall size scales last.
    const bool length = p.name.ends_with("_mm");
    const double units = (length ? values[i] / size_factor : values[i]) - p.built_in;
    const std::string where = table.file + ": parameter '" + p.name + "'";
    if (const std::string& joint = table.rules[i].joint; !joint.empty())
      if (auto ok = bend(anatomy, joint, values[i]); !ok) return fail(ok.error().what, where);
    if (units == 0) return {};
    if (auto ok = apply_rule(anatomy, table.rules[i], units); !ok)
      return fail(ok.error().what, where);
    return {};
  };
  for (std::size_t i = 0; i < table.rules.size(); ++i)
    if (i != table.overall_size)
      if (auto ok = act(i); !ok) return ok;
  return act(table.overall_size);
}

void mirror(GeneratedAnatomy& anatomy) {
  const auto flip = [](Vec3& p) { p.y() = -p.y(); };
  const auto flip_pose = [&](Pose& X) {
    flip(X.p);
    // The same turn seen in a mirror at y = 0: S R S with S = diag(1, -1, 1).
    X.q.x() = -X.q.x();
    X.q.z() = -X.q.z();
  };
  for (GeneratedBone& bone : anatomy.bones) {
    flip_pose(bone.X_WB);
    for (Vec3& v : bone.mesh.vertices) flip(v);
    for (Triangle& t : bone.mesh.triangles) std::swap(t[1], t[2]);
  }
  for (GeneratedSoft& soft : anatomy.softs) {
    for (Vec3& v : soft.mesh_W.vertices) flip(v);
    for (Triangle& t : soft.mesh_W.triangles) std::swap(t[1], t[2]);
    for (GeneratedAttachment& attachment : soft.attachments) flip(attachment.p_W);
  }
  for (GeneratedLandmark& landmark : anatomy.landmarks) {
    flip(landmark.p_W);
    flip(landmark.inwards_W);
  }
  for (GeneratedJoint& joint : anatomy.joints)
    for (GeneratedJoint::Moved& moved : joint.bones)
      for (Pose& X : moved.X_FB.poses) flip_pose(X);
  anatomy.side = anatomy.side == "left" ? "right" : "left";
}

}  // namespace osteon
