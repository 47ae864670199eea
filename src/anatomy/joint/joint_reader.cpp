#include "joint/joint_reader.h"

#include <algorithm>
#include <variant>

#include "describe/part_reader.h"

namespace osteon {
namespace {

constexpr Range kTurn_deg{-180, 180};
constexpr Range kWay_mm{-100, 100};

/// Where the item of that name stands; rejects the key where there is none.
template <class Item>
std::size_t find_item(TomlReader& in, const std::vector<Item>& items, const std::string& name,
                      const char* kind, const std::string& key) {
  const auto at =
      std::find_if(items.begin(), items.end(), [&](const Item& i) { return i.name == name; });
  if (at == items.end()) in.reject(std::string("names no ") + kind + ": '" + name + "'", key);
  return at == items.end() ? 0 : static_cast<std::size_t>(at - items.begin());
}

std::size_t read_bone(TomlReader& in, const AnatomyDescription& anatomy, const std::string& key) {
  return find_item(in, anatomy.bones, in.text(key), "bone", key);
}

/// A soft part of that shape on that bone.
template <class Shape>
std::size_t read_soft_of(TomlReader& in, const AnatomyDescription& anatomy, const std::string& key,
                         const char* kind, std::size_t bone) {
  const std::size_t soft = find_item(in, anatomy.softs, in.text(key), "soft part", key);
  if (in.failed()) return 0;
  const SoftDescription& found = anatomy.softs[soft];
  if (!std::holds_alternative<Shape>(found.shape) || carrier(found) != bone)
    in.reject(std::string("must name ") + kind + " of the bone", key);
  return soft;
}

/// One number a step, as many as `count` where that is not 0; the first is 0: the bones at rest.
std::vector<double> read_rows(TomlReader& in, const std::string& key, Range range,
                              std::size_t count) {
  std::vector<double> rows = in.numbers(key, range);
  if (in.failed()) return rows;
  if (rows.size() < 3 || rows[0] != 0)
    in.reject("must hold three numbers or more and begin with 0", key);
  if (count > 0 && rows.size() != count) in.reject("must hold as many numbers as the others", key);
  return rows;
}

GlidingBone read_gliding(TomlReader& in, const AnatomyDescription& anatomy, std::size_t rows) {
  GlidingBone glides;
  glides.bone = read_bone(in, anatomy, "glides");
  glides.cartilage = read_soft_of<LayerDescription>(in, anatomy, "glides_on",
                                                    "cartilage of the gliding bone", glides.bone);
  glides.tendon = read_soft_of<BandDescription>(
      in, anatomy, "tendon", "a band that begins at the gliding bone", glides.bone);
  glides.turn_deg = read_rows(in, "glide_turn_deg", kTurn_deg, rows);
  return glides;
}

/// The gliding bone's tendon must hold on to both ends, the far one on a bone that moves.
void check_tendon(TomlReader& in, const AnatomyDescription& anatomy, const RollingJoint& joint) {
  const auto& band = std::get<BandDescription>(anatomy.softs[joint.glides->tendon].shape);
  const BandPoint& end = band.path.back();
  const bool moves =
      std::find(joint.moves.begin(), joint.moves.end(), end.at.bone) != joint.moves.end();
  if (!band.path.front().attached || !end.attached || !moves)
    in.reject("must hold on to a bone that moves", "tendon");
}

}  // namespace

RollingJoint read_joint(TomlReader& in, const AnatomyDescription& anatomy) {
  RollingJoint joint;
  joint.name = in.text("name");
  joint.fixed = read_bone(in, anatomy, "fixed");
  for (const std::string& name : in.texts("moves"))
    joint.moves.push_back(find_item(in, anatomy.bones, name, "bone", "moves"));
  if (joint.moves.empty()) in.reject("must name a bone", "moves");
  joint.step_deg = in.number("step_deg", {1, 45});
  joint.medial = {joint.fixed, in.vec3("medial_center_mm", kPlace_mm) * kMm};
  joint.lateral = {joint.fixed, in.vec3("lateral_center_mm", kPlace_mm) * kMm};
  if ((joint.medial.p_W - joint.lateral.p_W).norm() < 1e-3)
    in.reject("must not be the medial one", "lateral_center_mm");
  const std::size_t tibia = joint.moves.empty() ? 0 : joint.moves[0];
  joint.medial_plateau = read_soft_of<LayerDescription>(in, anatomy, "medial_plateau",
                                                        "cartilage of the moved bone", tibia);
  joint.lateral_plateau = read_soft_of<LayerDescription>(in, anatomy, "lateral_plateau",
                                                         "cartilage of the moved bone", tibia);
  joint.inward_deg = read_rows(in, "inward_deg", kTurn_deg, 0);
  joint.back = read_rows(in, "medial_back_mm", kWay_mm, joint.inward_deg.size());
  for (double& back : joint.back) back *= kMm;
  if (!in.has("glides")) return joint;
  joint.glides = read_gliding(in, anatomy, joint.inward_deg.size());
  if (!in.failed()) check_tendon(in, anatomy, joint);
  return joint;
}

}  // namespace osteon
