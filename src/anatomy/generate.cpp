#include "osteon/anatomy/generate.h"

#include <algorithm>

#include "displace.h"
#include "grow.h"
#include "osteon/base/file.h"
#include "osteon/mesh/isosurface.h"
#include "roll_glide.h"
#include "soft_grow.h"

namespace osteon {
namespace {

/// A neighbour that keeps its distance, ready for evaluation in the frame of the bone it hollows.
struct Neighbour {
  const Solid* solid;
  Aabb reach_N;  ///< outside this box the neighbour changes nothing
  Mat3 R_NB;
  Vec3 p_NB;
  double gap, blend;
};

class BoneField {
 public:
  BoneField(const AnatomyDescription& anatomy, const BoneDescription& bone)
      : bone_(bone), solid_(bone.solid) {
    stretch_ = osteon::stretch(solid_);
    for (const Part& part : solid_.parts) slack_ += 0.25 * part.blend;
    for (const Clearance& c : bone.clearances) add(anatomy.bones[c.other_bone], bone, c);
    for (const BoundPart& defect : bone.defects) {
      stretch_ = std::max(stretch_, osteon::stretch(defect.part.primitive));
      slack_ += 0.25 * defect.part.blend;
    }
  }

  double operator()(const Vec3& p_B) const {
    double d = distance(solid_, p_B);
    for (const Neighbour& n : neighbours_) {
      const Vec3 p_N = n.R_NB * p_B + n.p_NB;
      const Aabb at{p_N, p_N};
      if (n.reach_N.overlaps(at)) d = smooth_max(d, n.gap - distance(*n.solid, p_N), n.blend);
    }
    if (bone_.defects.empty()) return d;
    const Vec3 p_W = bone_.R_WB * p_B + bone_.p_WB;
    for (const BoundPart& defect : bone_.defects) d = less(d, defect.part, p_W);
    return d;
  }
  double stretch() const { return stretch_; }
  double slack() const { return slack_; }

 private:
  void add(const BoneDescription& other, const BoneDescription& bone, const Clearance& c) {
    const double s = osteon::stretch(other.solid);
    Neighbour n;
    n.solid = &other.solid;
    n.reach_N = bounds(other.solid).grown((c.gap + c.blend) * s);
    n.R_NB = other.R_WB.transpose() * bone.R_WB;
    n.p_NB = other.R_WB.transpose() * (bone.p_WB - other.p_WB);
    n.gap = c.gap;
    n.blend = c.blend;
    neighbours_.push_back(n);
    stretch_ = std::max(stretch_, s);
    slack_ += c.gap + 0.25 * c.blend;
    for (const Part& part : other.solid.parts) slack_ += 0.25 * part.blend;
  }

  const BoneDescription& bone_;
  const Solid& solid_;
  std::vector<Neighbour> neighbours_;
  double stretch_ = 1;
  double slack_ = 0;
};

}  // namespace

Result<GeneratedBone> grow_bone(const AnatomyDescription& anatomy, const BoneDescription& bone,
                                const GenerateOptions& options, const std::string& file) {
  const BoneField field(anatomy, bone);
  IsosurfaceOptions surface;
  surface.cell_m = std::min(options.cell_m.value_or(bone.cell_m), bone.coarsest_cell_m);
  surface.stretch = field.stretch();
  surface.slack_m = field.slack();
  surface.uncrossed = !bone.defects.empty();
  auto mesh = isosurface([&field](const Vec3& p_B) { return field(p_B); },
                         bounds(bone.solid).grown(surface.cell_m), surface);
  if (!mesh)
    return fail("its surface cannot be found: " + mesh.error().what,
                file + ": bone '" + bone.name + "'", mesh.error().todo);
  GeneratedBone grown;
  grown.name = bone.name;
  grown.fma_id = bone.fma_id;
  grown.X_WB = rest_pose(bone);
  grown.mesh = std::move(*mesh);
  grown.density_kg_per_m3 = bone.density_kg_per_m3;
  return grown;
}

void run_tasks(const GenerateOptions& options, std::size_t count,
               const std::function<void(std::size_t)>& task,
               const std::function<void(double)>& progress) {
  if (options.run)
    return options.run(
        count, task, progress ? progress : [](double) {});
  for (std::size_t i = 0; i < count; ++i) {
    task(i);
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(count));
  }
}

Result<GeneratedAnatomy> grow_bones(const AnatomyDescription& anatomy,
                                    const GenerateOptions& options, const std::string& file) {
  GeneratedAnatomy generated;
  generated.name = anatomy.name;
  generated.side = anatomy.side;
  std::vector<Result<GeneratedBone>> bones(anatomy.bones.size());
  if (options.progress) options.progress(0);
  run_tasks(
      options, bones.size(),
      [&](std::size_t i) { bones[i] = grow_bone(anatomy, anatomy.bones[i], options, file); },
      options.progress);
  for (std::size_t i = 0; i < bones.size(); ++i) {
    if (!bones[i]) return tl::unexpected(bones[i].error());
    if (const auto moved = displacement_of(anatomy, i)) bones[i]->X_WB = *moved * bones[i]->X_WB;
    generated.bones.push_back(std::move(*bones[i]));
  }
  for (const LandmarkDescription& landmark : anatomy.landmarks)
    generated.landmarks.push_back({landmark.name, landmark.p_W});
  return generated;
}

Result<GeneratedAnatomy> generate_anatomy(const std::filesystem::path& description,
                                          const GenerateOptions& options) {
  const std::string file = description.string();
  const auto text = read_file(description, 1 << 22);
  if (!text) return tl::unexpected(text.error());
  auto anatomy = parse_description(*text, file);
  if (!anatomy) return tl::unexpected(anatomy.error());
  auto grown = grow_bones(*anatomy, options, file);
  if (!grown) return grown;
  if (auto ok = bend_joints(*anatomy, file, *grown); !ok) return tl::unexpected(ok.error());
  if (options.soft_parts)
    if (auto ok = grow_soft_parts(*anatomy, options, file, *grown); !ok)
      return tl::unexpected(ok.error());
  return grown;
}

}  // namespace osteon
