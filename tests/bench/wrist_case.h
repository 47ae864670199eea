#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cases/piece_work.h"
#include "osteon/mesh/hollows.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/repair.h"
#include "osteon/scene/build_case.h"
#include "osteon/scene/field_cache.h"
#include "osteon/scene/piece_cache.h"

namespace osteon::bench {

/// The bones of OSTEON_SHARED's wrist; empty when it is not there.
inline CaseDef wrist_def() {
  CaseDef def;
  def.name = "wrist";
  const char* shared = std::getenv("OSTEON_SHARED");
  if (!shared) return def;
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(shared) / "anatomy" / "wrist"))
    if (entry.path().extension() == ".stl") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  constexpr double kMetresPerUnit = 1;
  for (const auto& file : files) {
    auto mesh = load_mesh(file, kMetresPerUnit);
    if (!mesh) throw std::runtime_error(mesh.error().message());
    repair(*mesh);
    fill_hollows(*mesh);
    BoneDef bone;
    bone.name = canonical_bone_name(file.stem().string());
    bone.mesh = std::move(*mesh);
    def.bones.push_back(std::move(bone));
  }
  return def;
}

/// Built with what an earlier run left in the folder for temporary files: pieces take minutes.
inline std::shared_ptr<const Case> built(CaseDef def) {
  const auto folder = std::filesystem::temp_directory_path() / "osteon-bench";
  const auto stem = def.name + "-" + std::to_string(def.bones.size()) + "-" + def.bones[0].name;
  PieceCache pieces(folder / (stem + "-pieces.bin"));
  FieldCache fields(folder / (stem + "-fields.bin"));
  find_what_is_felt(def, pieces, fields, [](double) {});
  BuildOptions options;
  options.pieces = &pieces;
  options.fields = &fields;
  auto made = build_case(std::move(def), options);
  if (!made) throw std::runtime_error(made.error().message());
  (void)pieces.save();
  (void)fields.save();
  return std::make_shared<const Case>(std::move(*made));
}

}  // namespace osteon::bench
