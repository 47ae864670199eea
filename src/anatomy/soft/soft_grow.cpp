#include "soft/soft_grow.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bone/grow.h"
#include "finding/displace.h"
#include "osteon/mesh/measure.h"
#include "soft/band_course.h"
#include "soft/soft_field.h"

namespace osteon {
namespace {

/// A band as it lies before anything moves it, and its defects there.
struct RestingBand {
  LaidBand laid;
  std::vector<BoundPart> defects;
};

/// A place that a defect belongs to: its middle; of one without end, a point of its plane.
Vec3 place_of(const Primitive& defect) {
  if (const auto* crack = std::get_if<Crack>(&defect)) return crack->point;
  if (const auto* half = std::get_if<HalfSpace>(&defect)) return half->point;
  return bounds(defect).center();
}

/// Grows one description's soft parts, those that others give way to first.
class SoftGrower {
 public:
  SoftGrower(const AnatomyDescription& anatomy, const GenerateOptions& options,
             const std::string& file, GeneratedAnatomy& grown, PlacedBones placed)
      : anatomy_(anatomy),
        options_(options),
        file_(file),
        grown_(grown),
        placed_(std::move(placed)),
        resting_(anatomy.softs.size()),
        surfaces_(anatomy.softs.size()) {}

  Result<void> run() {
    if (auto ok = grow_whole_bones(); !ok) return ok;
    make_grounds();
    lay_resting_bands();
    grown_.softs.resize(anatomy_.softs.size());
    if (auto ok = grow_round(Round::kCartilage); !ok) return ok;
    displace();
    make_obstacles();
    for (const Round round : {Round::kBands, Round::kFillings})
      if (auto ok = grow_round(round); !ok) return ok;
    return {};
  }

  /// Lays landmarks that lie on a surface onto it; those on the skin lie there already.
  void lay_landmarks() {
    for (std::size_t i = 0; i < anatomy_.landmarks.size(); ++i) {
      const LandmarkDescription& landmark = anatomy_.landmarks[i];
      Vec3& p_W = grown_.landmarks[i].p_W;
      if (landmark.on_bone) p_W = grounds_[*landmark.on_bone]->surface.closest(p_W).point;
      if (landmark.on_soft && !is_skin(anatomy_.softs[*landmark.on_soft]))
        p_W = surfaces_[*landmark.on_soft]->closest(p_W).point;
    }
  }

 private:
  /// What grows together, in this order. The skin gives way to nothing: it grows with the fillings
  /// to keep a thread at work while there is little else.
  enum class Round { kCartilage, kBands, kFillings };

  static Round round_of(const SoftDescription& soft) {
    if (std::holds_alternative<LayerDescription>(soft.shape)) return Round::kCartilage;
    return std::holds_alternative<BandDescription>(soft.shape) ? Round::kBands : Round::kFillings;
  }

  /// A bone with defects as it was before: what lay on it and beside it grew then.
  Result<void> grow_whole_bones() {
    whole_.resize(anatomy_.bones.size());
    fine_.resize(anatomy_.bones.size());
    for (std::size_t i = 0; i < whole_.size(); ++i) {
      BoneDescription bone = anatomy_.bones[i];
      if (bone.defects.empty()) continue;
      bone.defects.clear();
      const auto fine = grow_bone(anatomy_, bone, options_, file_);
      if (!fine) return tl::unexpected(fine.error());
      fine_[i] = ground_of(fine->mesh, rest_pose(bone));
      bone.coarsest_cell_m = 1;
      auto whole = grow_bone(anatomy_, bone, options_, file_);
      if (!whole) return tl::unexpected(whole.error());
      whole_[i] = std::move(whole->mesh);
    }
    return {};
  }

  void make_grounds() {
    grounds_.resize(grown_.bones.size());
    run_tasks(options_, grounds_.size(), [&](std::size_t i) {
      const Pose X_WB = rest_pose(anatomy_.bones[i]);
      auto surface_W = whole_[i] ? std::nullopt : placed_.take(i, X_WB);
      grounds_[i] =
          surface_W ? make_ground(std::move(*surface_W)) : ground_of(healthy_mesh(i), X_WB);
    });
    for (const auto& ground : grounds_) all_ground_.push_back(&*ground);
  }

  /// Defects of a band that a joint bends go along with its course: they are given for this one.
  void lay_resting_bands() {
    for (std::size_t i = 0; i < anatomy_.softs.size(); ++i) {
      const SoftDescription& soft = anatomy_.softs[i];
      const auto* band = std::get_if<BandDescription>(&soft.shape);
      if (band && !soft.defects.empty() && is_bent(*band))
        resting_[i] = RestingBand{lay_band(*band, all_ground_), soft.defects};
    }
  }

  std::vector<BoundPart> defects_on(const LaidBand& laid, std::size_t soft) const {
    const auto& resting = resting_[soft];
    if (!resting) return anatomy_.softs[soft].defects;
    std::vector<BoundPart> defects = resting->defects;
    for (BoundPart& defect : defects) {
      Primitive& part = defect.part.primitive;
      move_rigidly(motion_along(resting->laid, laid, place_of(part)), part);
    }
    return defects;
  }

  const TriMesh& healthy_mesh(std::size_t bone) const {
    return whole_[bone] ? *whole_[bone] : grown_.bones[bone].mesh;
  }

  static SoftGround ground_of(TriMesh mesh_W, const Pose& X_WB) {
    for (Vec3& v : mesh_W.vertices) v = X_WB * v;
    return make_ground(MeshDistance(std::move(mesh_W)));
  }

  /// Cartilage has grown with the bones at rest: it goes with those that findings move, and so
  /// does what the rest is bound to.
  void displace() {
    run_tasks(options_, grounds_.size(), [&](std::size_t i) {
      const auto moved = displacement_of(anatomy_, i);
      if (!moved) return;
      grounds_[i] = ground_of(healthy_mesh(i), grown_.bones[i].X_WB);
      for (std::size_t k = 0; k < anatomy_.softs.size(); ++k)
        if (round_of(anatomy_.softs[k]) == Round::kCartilage && carrier(anatomy_.softs[k]) == i)
          for (Vec3& v : grown_.softs[k].mesh_W.vertices) v = *moved * v;
    });
    move_bound_along(anatomy_);
    for (std::size_t i = 0; i < grounds_.size(); ++i)
      obstacles_.push_back({&grounds_[i]->surface, grounds_[i]->box, i});
  }

  Result<void> grow_round(Round round) {
    std::vector<std::size_t> which;
    for (std::size_t i = 0; i < anatomy_.softs.size(); ++i)
      if (round_of(anatomy_.softs[i]) == round) which.push_back(i);
    // It takes longest: whoever takes it should not be the last.
    std::stable_sort(which.begin(), which.end(), [&](std::size_t a, std::size_t b) {
      return is_skin(anatomy_.softs[a]) && !is_skin(anatomy_.softs[b]);
    });
    std::vector<std::optional<Error>> errors(which.size());
    run_tasks(options_, which.size(), [&](std::size_t k) {
      if (auto ok = grow(which[k]); !ok) errors[k] = ok.error();
    });
    for (const auto& error : errors)
      if (error) return tl::unexpected(*error);
    return {};
  }

  static bool is_skin(const SoftDescription& soft) {
    return std::holds_alternative<SkinDescription>(soft.shape);
  }

  /// Cartilage hinders all that follows.
  void make_obstacles() {
    run_tasks(options_, anatomy_.softs.size(), [&](std::size_t i) {
      if (round_of(anatomy_.softs[i]) == Round::kCartilage)
        surfaces_[i].emplace(grown_.softs[i].mesh_W);
    });
    for (std::size_t i = 0; i < surfaces_.size(); ++i)
      if (const auto& surface = surfaces_[i])
        obstacles_.push_back({&*surface, bounds(surface->mesh()), carrier(anatomy_.softs[i])});
  }

  /// Whether landmarks lie on it or volumes name it, which it then hinders.
  bool is_asked_for(std::size_t i) const {
    const auto on_it = [&](const LandmarkDescription& landmark) { return landmark.on_soft == i; };
    const auto names_it = [&](const SoftDescription& soft) {
      const auto* volume = std::get_if<VolumeDescription>(&soft.shape);
      return volume && std::count(volume->clear_of.begin(), volume->clear_of.end(),
                                  anatomy_.softs[i].name) > 0;
    };
    if (is_skin(anatomy_.softs[i])) return false;
    return std::any_of(anatomy_.landmarks.begin(), anatomy_.landmarks.end(), on_it) ||
           std::any_of(anatomy_.softs.begin(), anatomy_.softs.end(), names_it);
  }

  Result<void> grow(std::size_t i) {
    const SoftDescription& soft = anatomy_.softs[i];
    GeneratedSoft& out = grown_.softs[i];
    out.name = soft.name;
    out.fma_id = soft.fma_id;
    out.tissue = soft.tissue;
    out.kind = soft.kind;
    auto mesh =
        std::visit([&](const auto& shape) { return mesh_of(shape, soft, out); }, soft.shape);
    const std::string where = file_ + ": soft part '" + soft.name + "'";
    if (!mesh) return fail("its surface cannot be found: " + mesh.error().what, where);
    if (mesh->triangles.empty()) return fail("nothing of it is left", where);
    out.mesh_W = std::move(*mesh);
    if (round_of(soft) != Round::kCartilage && is_asked_for(i)) surfaces_[i].emplace(out.mesh_W);
    return {};
  }

  const std::string& bone_name(std::size_t bone) const { return anatomy_.bones[bone].name; }

  Result<TriMesh> mesh_of(const LayerDescription& layer, const SoftDescription& soft,
                          GeneratedSoft& out) const {
    std::vector<const LayerDescription*> on_same_bone;
    for (const SoftDescription& other : anatomy_.softs)
      if (const auto* l = std::get_if<LayerDescription>(&other.shape))
        if (l->bone == layer.bone) on_same_bone.push_back(l);
    out.thickness_m = layer.thickness;
    out.bones = {bone_name(layer.bone)};
    std::vector<BoundPart> defects = soft.defects;
    const auto& of_bone = anatomy_.bones[layer.bone].defects;
    defects.insert(defects.end(), of_bone.begin(), of_bone.end());
    GroundView ground = all_ground_;
    if (fine_[layer.bone]) ground[layer.bone] = &*fine_[layer.bone];
    return grow_layer(layer, on_same_bone, ground, defects);
  }

  Result<TriMesh> mesh_of(const BandDescription& band, const SoftDescription& soft,
                          GeneratedSoft& out) const {
    const LaidBand laid = lay_band(band, all_ground_, bend_of_band(band));
    std::size_t next = 0;
    for (const BandPoint& point : band.path) {
      out.thickness_m = std::max(out.thickness_m, point.thickness);
      if (!point.attached) continue;
      const std::string& bone = bone_name(point.at.bone);
      out.attachments.push_back({point.name, bone, laid.attachments[next++]});
      if (std::find(out.bones.begin(), out.bones.end(), bone) == out.bones.end())
        out.bones.push_back(bone);
    }
    SoftDescription cut = soft;
    cut.defects = defects_on(laid, static_cast<std::size_t>(&soft - anatomy_.softs.data()));
    return grow_band(laid, band.sink, cut, obstacles_);
  }

  /// How joints turn the bones of a band's ends.
  std::pair<Quat, Quat> turns_of_ends(const BandDescription& band) const {
    return {bend_of(anatomy_, band.path.front().at.bone).value_or(Pose{}).q,
            bend_of(anatomy_, band.path.back().at.bone).value_or(Pose{}).q};
  }
  bool is_bent(const BandDescription& band) const {
    const auto [first, last] = turns_of_ends(band);
    return first.coeffs() != last.coeffs();
  }

  /// Bands between bones that a joint has bent apart are taut from kTaut_deg on.
  BandBend bend_of_band(const BandDescription& band) const {
    constexpr double kTaut_deg = 20;
    BandBend bend;
    if (!is_bent(band)) return bend;
    const auto [first, last] = turns_of_ends(band);
    bend.R_first = first.toRotationMatrix();
    bend.R_last = last.toRotationMatrix();
    for (const RollingJoint& joint : anatomy_.joints) {
      const double t = std::min(joint.at_deg / kTaut_deg, 1.0);
      bend.taut = std::max(bend.taut, t * t * (3 - 2 * t));
    }
    return bend;
  }

  /// Of cartilage or a band.
  const MeshDistance* surface_named(const std::string& name) const {
    for (std::size_t i = 0; i < surfaces_.size(); ++i)
      if (anatomy_.softs[i].name == name && round_of(anatomy_.softs[i]) != Round::kFillings)
        return &*surfaces_[i];
    return nullptr;
  }

  const BandDescription* band_named(const std::string& name) const {
    for (const SoftDescription& soft : anatomy_.softs)
      if (soft.name == name) return std::get_if<BandDescription>(&soft.shape);
    return nullptr;
  }

  Result<TriMesh> mesh_of(const VolumeDescription& volume, const SoftDescription& soft,
                          GeneratedSoft& out) const {
    std::vector<Obstacle> obstacles = obstacles_;
    for (const std::string& name : volume.clear_of) {
      const MeshDistance* surface = surface_named(name);
      if (!surface)
        return fail("'clear_of' names no cartilage, ligament or tendon: '" + name + "'");
      obstacles.push_back({surface, bounds(surface->mesh())});
    }
    const auto add = [&](std::size_t bone) {
      if (std::find(out.bones.begin(), out.bones.end(), bone_name(bone)) == out.bones.end())
        out.bones.push_back(bone_name(bone));
    };
    for (const BoundPart& part : volume.parts) {
      add(part.bone);
      if (part.to_bone) add(*part.to_bone);
      if (part.along.empty()) continue;
      const BandDescription* band = band_named(part.along);
      if (!band) return fail("'along' names no ligament or tendon: '" + part.along + "'");
      for (const BandPoint& point : band->path)
        if (point.attached) add(point.at.bone);
    }
    return grow_volume(volume, soft, obstacles);
  }

  Result<TriMesh> mesh_of(const SkinDescription& skin, const SoftDescription& soft,
                          GeneratedSoft&) const {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < anatomy_.bones.size(); ++i)
      poses.push_back(bend_of(anatomy_, i).value_or(Pose{}) * rest_pose(anatomy_.bones[i]));
    return grow_skin(skin, soft.cell, anatomy_.bones, poses);
  }

  AnatomyDescription anatomy_;
  const GenerateOptions& options_;
  const std::string& file_;
  GeneratedAnatomy& grown_;
  PlacedBones placed_;
  std::vector<std::optional<TriMesh>> whole_;    ///< of bones with defects: without, in Bone
  std::vector<std::optional<SoftGround>> fine_;  ///< of the same, in the detail of the defects
  std::vector<std::optional<SoftGround>> grounds_;
  GroundView all_ground_;
  std::vector<Obstacle> obstacles_;
  std::vector<std::optional<RestingBand>> resting_;    ///< of bent bands with defects
  std::vector<std::optional<MeshDistance>> surfaces_;  ///< of finished soft parts, if asked for
};

}  // namespace

Result<void> grow_soft_parts(const AnatomyDescription& anatomy, const GenerateOptions& options,
                             const std::string& file, GeneratedAnatomy& grown, PlacedBones placed) {
  SoftGrower grower(anatomy, options, file, grown, std::move(placed));
  if (auto ok = grower.run(); !ok) return ok;
  grower.lay_landmarks();
  return {};
}

}  // namespace osteon
