#include "vary/vary_bound.h"

#include <algorithm>
#include <variant>

namespace osteon {
namespace {

class BoundMover {
 public:
  BoundMover(std::vector<bool> moved, const BoundMove& move)
      : moved_(std::move(moved)), move_(move) {}

  bool moves(std::size_t bone) const { return moved_[bone]; }
  void point(BoundPoint& p) const {
    if (moves(p.bone)) p.p_W = move_.point_W(p.p_W);
  }
  void parts(std::vector<BoundPart>& parts) const {
    for (BoundPart& p : parts) {
      if (p.to_bone && moves(*p.to_bone) != moves(p.bone)) move_one_end(p);
      if (!moves(p.bone) || (p.to_bone && !moves(*p.to_bone))) continue;
      move_.part_W(p.part.primitive);
      p.part.blend *= move_.scale;
    }
  }

 private:
  // Of a tube between two bones of which one moves: each point by its share of the way.
  void move_one_end(BoundPart& bound) const {
    auto* tube = std::get_if<Tube>(&bound.part.primitive);
    if (!tube || tube->points.size() < 2) return;
    Primitive whole = *tube;
    move_.part_W(whole);
    const Tube& moved = std::get<Tube>(whole);
    const double last = static_cast<double>(tube->points.size() - 1);
    for (std::size_t i = 0; i < tube->points.size(); ++i) {
      const double along = static_cast<double>(i) / last,
                   share = moves(bound.bone) ? 1 - along : along;
      tube->points[i] += share * (moved.points[i] - tube->points[i]);
      tube->radii[i] += share * (moved.radii[i] - tube->radii[i]);
    }
    find_reach(*tube);
  }

  std::vector<bool> moved_;
  const BoundMove& move_;
};

struct PlaceMover {
  const BoundMover& mover;
  void operator()(LayerDescription& layer) const { mover.parts(layer.region); }
  void operator()(BandDescription& band) const {
    for (BandPoint& p : band.path) mover.point(p.at);
  }
  void operator()(VolumeDescription& volume) const { mover.parts(volume.parts); }
  void operator()(SkinDescription& skin) const { mover.parts(skin.parts); }
};

struct LengthScaler {
  double s;
  void operator()(LayerDescription& layer) const {
    for (double* length :
         {&layer.thickness, &layer.reach, &layer.taper, &layer.clearance, &layer.rim})
      *length *= s;
  }
  void operator()(BandDescription& band) const {
    for (BandPoint& p : band.path) {
      p.width *= s;
      p.thickness *= s;
    }
  }
  void operator()(VolumeDescription&) const {}
  void operator()(SkinDescription& skin) const {
    skin.offset *= s;
    skin.blend *= s;
  }
};

}  // namespace

void move_bound(AnatomyDescription& anatomy, const std::vector<std::string>& bones,
                const BoundMove& move) {
  std::vector<bool> moved;
  for (const BoneDescription& bone : anatomy.bones)
    moved.push_back(std::any_of(bones.begin(), bones.end(), [&](const std::string& name) {
      return name == "*" || name == bone.name;
    }));
  const BoundMover mover(std::move(moved), move);
  for (LandmarkDescription& landmark : anatomy.landmarks)
    if (landmark.bone && mover.moves(*landmark.bone)) landmark.p_W = move.point_W(landmark.p_W);
  for (BoneDescription& bone : anatomy.bones) mover.parts(bone.defects);
  for (Displacement& d : anatomy.displacements) mover.point(d.pivot);
  for (BoneSplit& split : anatomy.splits)
    for (BoneSplit::Fragment& fragment : split.fragments) mover.point(fragment.near);
  for (RollingJoint& joint : anatomy.joints) {
    mover.point(joint.medial);
    mover.point(joint.lateral);
    if (mover.moves(joint.fixed))
      for (double& back : joint.back) back *= move.scale;
  }
  for (SoftDescription& soft : anatomy.softs) {
    std::visit(PlaceMover{mover}, soft.shape);
    mover.parts(soft.defects);
    if (mover.moves(carrier(soft))) std::visit(LengthScaler{move.scale}, soft.shape);
  }
}

}  // namespace osteon
