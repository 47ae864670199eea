#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "osteon/image/label_edit.h"
#include "osteon/image/progress.h"
#include "osteon/image/threshold.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// What to open, as `osteon import ct` takes it.
struct ScanOrder {
  std::filesystem::path source;
  std::string series;
  std::optional<Vec3> spacing_m;
};

struct OpenedScan {
  LabelEdit edit;
  BoneLevels levels;
};

Result<OpenedScan> open_scan(const ScanOrder& order, const Progress& progress = {});

/// The bones that the import finds by itself, and where it puts the patient.
struct SuggestedLabels {
  LabelVolume labels;
  std::map<std::uint16_t, std::string> names;
  Pose X_WP;
  std::string side;         ///< "left" or "right" where a wrist was recognised
  std::size_t outside = 0;  ///< parts outside the body, such as a head rest, that are no bones
};

Result<SuggestedLabels> suggest_labels(const Volume& volume, const BoneLevels& levels,
                                       const Progress& progress = {});

/// Everything that a case is made of, at one moment of the editing.
struct SegmentSaveOrder {
  std::shared_ptr<const Volume> volume;
  LabelVolume labels;
  std::map<std::uint16_t, std::string> names;
  BoneLevels levels;
  Pose X_WP;
  std::string side;
  std::filesystem::path out;
  bool replace = false;  ///< a case that is there already; else that is an error
};

struct SavedSegments {
  std::filesystem::path folder;
  std::size_t bones = 0;
  std::size_t open_surfaces = 0;   ///< of bones whose surface is not closed
  std::size_t without_voxels = 0;  ///< bones of the list that had nothing to save
};

/// Saves the labelled bones as a case, with the surfaces that `osteon import ct` draws of the same
/// labels: whole or not at all. Fails when no bone has voxels, when there are more than kMaxBones,
/// and when told to stop.
Result<SavedSegments> save_segments(const SegmentSaveOrder& order, const Progress& progress = {});

/// One bone as it stands, cut out of the scan: for a surface that is drawn beside the editing.
struct PreviewOrder {
  Volume volume;
  LabelVolume labels;
  VoxelBox box;
  std::uint16_t label = 0;
  std::uint64_t version = 0;  ///< EditedLabel's
  BoneLevels levels;
};

PreviewOrder preview_order(const LabelEdit& edit, std::uint16_t label, const BoneLevels& levels);

struct PreviewSurface {
  std::uint16_t label = 0;
  std::uint64_t version = 0;
  TriMesh mesh_P;
};

/// A surface for the picture alone: at most about a hundred cells along the bone.
Result<PreviewSurface> draw_preview(const PreviewOrder& order);

}  // namespace osteon
