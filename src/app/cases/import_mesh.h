#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/mesh/repair.h"
#include "osteon/scene/build_case.h"

namespace osteon {

struct ImportOptions {
  std::filesystem::path source;  ///< a folder of meshes in one common frame, or one mesh
  std::vector<std::filesystem::path> files;  ///< these meshes instead; empty: what `source` names
  double metres_per_unit = 1;
  std::filesystem::path out;  ///< the case folder to make
  std::string name;           ///< of the case; empty: that of the folder
  std::string side;           ///< "left", "right" or empty
  bool keep_hollows = false;  ///< else they are walled up (fill_hollows)
  /// Takes bones that are three times as large or small as usual, and parts that overlap.
  bool force = false;
  bool in_window = false;  ///< remedies name what the window offers, not the command's options
  std::function<void(double)> progress = {};  ///< told the share of files read; may throw to stop
};

/// One mesh file as it came in.
struct ImportedBone {
  std::filesystem::path file;
  std::size_t triangles = 0;  ///< after repair
  bool closed = false;
  RepairReport repair;
  std::size_t hollows = 0;    ///< walled up
  std::size_t crossings = 0;  ///< pairs of triangles that pass through each other, the first
                              ///< kListedCrossings
};

struct ImportResult {
  CaseDef def;
  std::vector<ImportedBone> bones;  ///< parallel to def.bones
};

/// Refuses what cannot be a bone: a mesh without a volume, one in the wrong unit, one whose closed
/// parts overlap. Reads, mends and names every mesh of the source in the order of their file names.
/// World is the frame of the files; each bone's own frame sits in its centre of volume, axes along
/// World.
Result<ImportResult> read_meshes(const ImportOptions& options);

/// Reads the meshes and writes the case: into a folder beside `out` that is renamed at the end, so
/// that a stop leaves no half case under its name.
Result<ImportResult> import_meshes(const ImportOptions& options);

}  // namespace osteon
