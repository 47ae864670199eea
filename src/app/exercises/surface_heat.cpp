#include "exercises/surface_heat.h"

#include <utility>

namespace osteon {

SurfaceHeat::Place SurfaceHeat::make_place(const Carving& carving,
                                           const CarvingReadout& first) const {
  Place place{BoneHeat(carving.setup().table, first), {}};
  const Aabb& box = place.heat.box_B();
  for (const Vec3& p_B : case_->bones[first.bone].mesh.vertices)
    if (box.overlaps({p_B, p_B})) place.points_B.push_back(p_B);
  return place;
}

void SurfaceHeat::see(const Session& session, DamageMaker& damage) {
  const Carving* const carving = session.carving();
  const BoneSnapshot& bones = session.bones();
  if (!carving || bones.step == step_ || bones.step == 0) return;
  step_ = bones.step;
  const double step_s = bones.time_s / static_cast<double>(bones.step);
  for (std::size_t h = 0; h < session.hands(); ++h) {
    const CarvingReadout& readout = carving->readout(h);
    if (!makes_heat(readout) || readout.bone >= case_->bones.size()) continue;
    auto it = places_.find(readout.bone);
    if (it == places_.end())
      it = places_.emplace(readout.bone, make_place(*carving, readout)).first;
    it->second.heat.warm(readout, step_s);
  }
  for (auto& [bone, place] : places_)
    if (place.heat.pass(step_s))
      for (const Vec3& p_B : place.points_B)
        damage.warm(bone, p_B, place.heat.grid()->temperature_at(p_B));
}

}  // namespace osteon
