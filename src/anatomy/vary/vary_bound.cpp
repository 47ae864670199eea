#include "vary/vary_bound.h"

#include <algorithm>

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
      if (!moves(p.bone)) continue;
      move_.part_W(p.part.primitive);
      p.part.blend *= move_.scale;
    }
  }

 private:
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
