#include "soft_grow.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "grow.h"
#include "osteon/mesh/measure.h"
#include "soft_field.h"

namespace osteon {
namespace {

/// Grows one description's soft parts, those that others give way to first.
class SoftGrower {
 public:
  SoftGrower(const AnatomyDescription& anatomy, const GenerateOptions& options,
             const std::string& file, GeneratedAnatomy& grown)
      : anatomy_(anatomy), options_(options), file_(file), grown_(grown) {}

  Result<void> run() {
    make_grounds();
    grown_.softs.resize(anatomy_.softs.size());
    for (const int order : {0, 1, 2}) {
      if (auto ok = grow_in_order(order); !ok) return ok;
      make_obstacles(order);
    }
    return {};
  }

  /// Lays landmarks that lie on a surface onto it.
  void lay_landmarks() {
    for (std::size_t i = 0; i < anatomy_.landmarks.size(); ++i) {
      const LandmarkDescription& landmark = anatomy_.landmarks[i];
      Vec3& p_W = grown_.landmarks[i].p_W;
      if (landmark.on_bone) p_W = grounds_[*landmark.on_bone]->surface.closest(p_W).point;
      if (landmark.on_soft)
        p_W = MeshDistance(grown_.softs[*landmark.on_soft].mesh_W).closest(p_W).point;
    }
  }

 private:
  /// Cartilage, then bands and the skin, then what gives way to them.
  static int order_of(const SoftDescription& soft) {
    if (std::holds_alternative<LayerDescription>(soft.shape)) return 0;
    return std::holds_alternative<VolumeDescription>(soft.shape) ? 2 : 1;
  }

  void make_grounds() {
    grounds_.resize(grown_.bones.size());
    run_tasks(options_, grounds_.size(), [&](std::size_t i) {
      TriMesh mesh_W = grown_.bones[i].mesh;
      for (Vec3& v : mesh_W.vertices) v = grown_.bones[i].X_WB * v;
      grounds_[i] = make_ground(std::move(mesh_W));
    });
    for (const auto& ground : grounds_) {
      all_ground_.push_back(&*ground);
      obstacles_.push_back({&ground->surface, ground->box});
    }
  }

  Result<void> grow_in_order(int order) {
    std::vector<std::size_t> which;
    for (std::size_t i = 0; i < anatomy_.softs.size(); ++i)
      if (order_of(anatomy_.softs[i]) == order) which.push_back(i);
    // The skin takes longest: whoever takes it should not be the last.
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

  /// Cartilage hinders all that follows; bands hinder those volumes that name them.
  void make_obstacles(int order) {
    for (std::size_t i = 0; i < anatomy_.softs.size() && order < 2; ++i) {
      const SoftDescription& soft = anatomy_.softs[i];
      if (order_of(soft) != order || is_skin(soft)) continue;
      const TriMesh& mesh = grown_.softs[i].mesh_W;
      const auto [at, made] = surfaces_.try_emplace(soft.name, mesh);
      if (made && order == 0) obstacles_.push_back({&at->second, bounds(mesh)});
    }
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
    return {};
  }

  const std::string& bone_name(std::size_t bone) const { return anatomy_.bones[bone].name; }

  Result<TriMesh> mesh_of(const LayerDescription& layer, const SoftDescription&,
                          GeneratedSoft& out) const {
    std::vector<const LayerDescription*> on_same_bone;
    for (const SoftDescription& other : anatomy_.softs)
      if (const auto* l = std::get_if<LayerDescription>(&other.shape))
        if (l->bone == layer.bone) on_same_bone.push_back(l);
    out.thickness_m = layer.thickness;
    out.bones = {bone_name(layer.bone)};
    return grow_layer(layer, on_same_bone, all_ground_);
  }

  Result<TriMesh> mesh_of(const BandDescription& band, const SoftDescription& soft,
                          GeneratedSoft& out) const {
    const LaidBand laid = lay_band(band, all_ground_);
    std::size_t next = 0;
    for (const BandPoint& point : band.path) {
      out.thickness_m = std::max(out.thickness_m, point.thickness);
      if (!point.attached) continue;
      const std::string& bone = bone_name(point.at.bone);
      out.attachments.push_back({point.name, bone, laid.attachments[next++]});
      if (std::find(out.bones.begin(), out.bones.end(), bone) == out.bones.end())
        out.bones.push_back(bone);
    }
    return grow_band(laid, band.sink, soft.cell, obstacles_);
  }

  Result<TriMesh> mesh_of(const VolumeDescription& volume, const SoftDescription& soft,
                          GeneratedSoft& out) const {
    std::vector<Obstacle> obstacles = obstacles_;
    for (const std::string& name : volume.clear_of) {
      const auto found = surfaces_.find(name);
      if (found == surfaces_.end())
        return fail("'clear_of' names no cartilage, ligament or tendon: '" + name + "'");
      obstacles.push_back({&found->second, bounds(found->second.mesh())});
    }
    for (const BoundPart& part : volume.parts)
      if (std::find(out.bones.begin(), out.bones.end(), bone_name(part.bone)) == out.bones.end())
        out.bones.push_back(bone_name(part.bone));
    return grow_volume(volume, soft.cell, obstacles);
  }

  Result<TriMesh> mesh_of(const SkinDescription& skin, const SoftDescription& soft,
                          GeneratedSoft&) const {
    return grow_skin(skin, soft.cell, anatomy_.bones);
  }

  const AnatomyDescription& anatomy_;
  const GenerateOptions& options_;
  const std::string& file_;
  GeneratedAnatomy& grown_;
  std::vector<std::optional<SoftGround>> grounds_;
  GroundView all_ground_;
  std::vector<Obstacle> obstacles_;
  std::map<std::string, MeshDistance> surfaces_;  ///< of finished soft parts, by name
};

}  // namespace

Result<void> grow_soft_parts(const AnatomyDescription& anatomy, const GenerateOptions& options,
                             const std::string& file, GeneratedAnatomy& grown) {
  SoftGrower grower(anatomy, options, file, grown);
  if (auto ok = grower.run(); !ok) return ok;
  grower.lay_landmarks();
  return {};
}

}  // namespace osteon
