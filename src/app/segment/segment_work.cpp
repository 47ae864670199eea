#include "segment/segment_work.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "cases/label_case.h"
#include "cases/whole_folder.h"
#include "osteon/image/load_volume.h"
#include "osteon/image/segment.h"
#include "osteon/mesh/bone_surface.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

constexpr int kPreviewMargin = 4;         // voxels around a bone, which its surface looks into
constexpr double kPreviewCells = 96;      // along the longest side
constexpr double kPreviewDecimate = 0.2;  // of a cell

std::vector<LabelledBone> bones_to_save(const SegmentSaveOrder& order) {
  std::vector<LabelledBone> bones;
  for (const Region& region : measure_regions(order.labels)) {
    const auto name = order.names.find(region.label);
    if (name != order.names.end())
      bones.push_back({name->second, region.label, region.voxels, region.box});
  }
  return bones;
}

/// Puts the old case aside until the new one has its name.
Result<void> write_case(const CaseDef& def, const fs::path& out, bool replace) {
  fs::path aside = out;
  aside += ".before";
  std::error_code ec;
  const auto written = write_whole_folder(out, [&](const fs::path& part) -> Result<void> {
    if (auto saved = save_case(def, part); !saved) return saved;
    if (!replace || !fs::exists(out, ec)) return {};
    fs::remove_all(aside, ec);
    fs::rename(out, aside, ec);
    return ec ? fail("cannot be replaced (" + ec.message() + ")", out.string(),
                     "Choose another folder")
              : Result<void>();
  });
  if (!replace) return written;
  if (written)
    fs::remove_all(aside, ec);
  else if (fs::exists(aside, ec) && !fs::exists(out, ec))
    fs::rename(aside, out, ec);
  return written;
}

}  // namespace

Result<OpenedScan> open_scan(const ScanOrder& order, const Progress& progress) {
  LoadVolumeOptions load;
  load.series = order.series;
  load.spacing_m = order.spacing_m;
  load.progress = part_of(progress, 0, 0.9);
  auto volume = load_volume(order.source, load);
  if (!volume) return tl::unexpected(volume.error());
  if (!goes_on(progress, "Looking for bone", 0.9)) return stopped();
  const BoneLevels levels = find_bone_levels(*volume);
  auto edit = LabelEdit::begin(std::make_shared<const Volume>(std::move(*volume)));
  if (!edit) return tl::unexpected(edit.error());
  return OpenedScan{std::move(*edit), levels};
}

Result<SuggestedLabels> suggest_labels(const Volume& volume, const BoneLevels& levels,
                                       const Progress& progress) {
  auto scan = find_scan_bones(volume, levels.threshold_hu, false, progress);
  if (!scan) return tl::unexpected(scan.error());
  LabelledBones& found = scan->labelled;
  SuggestedLabels out;
  for (const LabelledBone& bone : found.bones) out.names[bone.label] = bone.name;
  out.X_WP = scan_pose_WP(found, volume.frame);
  if (found.recognised) out.side = found.fit.mirrored ? "left" : "right";
  out.outside = scan->outside;
  out.labels = std::move(found.labels);
  return out;
}

Result<SavedSegments> save_segments(const SegmentSaveOrder& order, const Progress& progress) {
  const fs::path out = plain_folder(order.out);
  if (!order.replace)
    if (auto free = refuse_existing(out); !free) return tl::unexpected(free.error());
  if (!goes_on(progress, "Measuring bones", 0)) return stopped();
  const std::vector<LabelledBone> bones = bones_to_save(order);
  if (bones.empty()) return fail("there is no bone to save yet", {}, "Grow or paint one first");
  if (bones.size() > kMaxBones)
    return fail("a case has at most " + std::to_string(kMaxBones) + " bones, but this one has " +
                    std::to_string(bones.size()),
                {}, "Merge or remove some");
  LabelCaseOptions options;
  options.threshold_hu = order.levels.threshold_hu;
  options.soft_hu = order.levels.soft_hu;
  options.most_bones = kMaxBones;
  options.progress = part_of(progress, 0.02, 0.98);
  auto made = bones_of_labels(*order.volume, order.labels, bones, order.X_WP, options);
  if (!made) return tl::unexpected(made.error());
  CaseDef def;
  def.name = out.filename().string();
  def.side = order.side;
  def.bones = std::move(made->bones);
  if (!goes_on(progress, "Writing the case", 0.98)) return stopped();
  if (auto written = write_case(def, out, order.replace); !written)
    return tl::unexpected(written.error());
  SavedSegments saved{out, bones.size(), 0, order.names.size() - bones.size()};
  for (const ImportedCtBone& bone : made->figures) saved.open_surfaces += bone.closed ? 0 : 1;
  return saved;
}

PreviewOrder preview_order(const LabelEdit& edit, std::uint16_t label, const BoneLevels& levels) {
  const EditedLabel& bone = edit.bones().at(label);
  const VoxelBox around = grown(bone.box, kPreviewMargin, edit.labels().frame);
  PreviewOrder order;
  order.volume = crop(edit.volume(), around);
  order.labels = crop(edit.labels(), around);
  for (std::size_t a = 0; a < 3; ++a) {
    order.box.lo[a] = bone.box.lo[a] - around.lo[a];
    order.box.hi[a] = bone.box.hi[a] - around.lo[a];
  }
  order.label = label;
  order.version = bone.version;
  order.levels = levels;
  return order;
}

Result<PreviewSurface> draw_preview(const PreviewOrder& order) {
  const GridFrame& frame = order.labels.frame;
  double longest_m = 0;
  for (std::size_t a = 0; a < 3; ++a)
    longest_m = std::max(longest_m, frame.spacing_m[static_cast<Eigen::Index>(a)] *
                                        (order.box.hi[a] - order.box.lo[a]));
  BoneSurfaceOptions options;
  options.threshold_hu = order.levels.threshold_hu;
  options.soft_hu = order.levels.soft_hu;
  options.cell_m = std::max(frame.spacing_m.minCoeff(), longest_m / kPreviewCells);
  options.decimate_m = kPreviewDecimate * options.cell_m;
  auto mesh = bone_surface(order.volume, order.labels, order.label, order.box, options);
  if (!mesh) return tl::unexpected(mesh.error());
  return PreviewSurface{order.label, order.version, std::move(*mesh)};
}

}  // namespace osteon
