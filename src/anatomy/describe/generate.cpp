#include "osteon/anatomy/generate.h"

#include <algorithm>

#include "bone/bone_field.h"
#include "bone/bone_places.h"
#include "bone/grow.h"
#include "finding/displace.h"
#include "joint/roll_glide.h"
#include "osteon/base/file.h"
#include "osteon/mesh/isosurface.h"
#include "soft/skin_places.h"
#include "soft/soft_grow.h"

namespace osteon {
Result<GeneratedBone> grow_bone(const AnatomyDescription& anatomy, const BoneDescription& bone,
                                const GenerateOptions& options, const std::string& file) {
  const BoneField field(anatomy, bone);
  IsosurfaceOptions surface;
  surface.cell_m = std::min(options.cell_m.value_or(bone.cell_m), bone.coarsest_cell_m);
  surface.uncrossed = !bone.defects.empty();
  auto mesh = isosurface(field, bounds(bone.solid).grown(surface.cell_m), surface);
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
  for (const LandmarkDescription& landmark : anatomy.landmarks) {
    const auto moved = landmark.bone ? displacement_of(anatomy, *landmark.bone) : std::nullopt;
    generated.landmarks.push_back({landmark.name, moved ? *moved * landmark.p_W : landmark.p_W});
    if (landmark.bone) generated.landmarks.back().bone = anatomy.bones[*landmark.bone].name;
  }
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
  PlacedBones placed;
  if (options.soft_parts || !anatomy->joints.empty()) placed = PlacedBones(*grown, options);
  if (auto ok = bend_joints(*anatomy, file, placed, *grown); !ok) return tl::unexpected(ok.error());
  lay_on_skin(*anatomy, *grown);
  if (!options.soft_parts)
    lay_on_bones(*anatomy, *grown);
  else if (auto ok = grow_soft_parts(*anatomy, options, file, *grown, std::move(placed)); !ok)
    return tl::unexpected(ok.error());
  return grown;
}

}  // namespace osteon
