#include "cases/import_mesh.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "cases/whole_folder.h"
#include "osteon/hull/hull.h"
#include "osteon/mesh/hollows.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/self_crossing.h"
#include "osteon/scene/bone_size.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

Result<std::vector<fs::path>> mesh_files(const ImportOptions& options) {
  const fs::path& source = options.source;
  std::error_code ec;
  if (fs::is_regular_file(source, ec) && options.files.empty()) return std::vector{source};
  std::vector<fs::path> files = options.files;
  if (files.empty()) {
    fs::directory_iterator entries(source, ec);
    if (ec) return fail("cannot be read (" + ec.message() + ")", source.string(), "Check the name");
    for (const fs::directory_entry& entry : entries)
      if (entry.is_regular_file(ec) && is_mesh_file(entry.path())) files.push_back(entry.path());
  }
  if (files.empty())
    return fail("holds no mesh", source.string(),
                "Put STL, OBJ, PLY, VTK, VTP, glTF or GLB files there");
  if (files.size() > kMaxBones)
    return fail("holds more than " + std::to_string(kMaxBones) + " meshes", source.string(),
                "Import them in several cases");
  std::sort(files.begin(), files.end());
  return files;
}

// The frame moves into the centre, the bone stays where it is in World.
BoneDef center_bone(std::string name, TriMesh mesh) {
  BoneDef bone;
  bone.name = std::move(name);
  bone.fma_id = fma_id_of(bone.name);
  bone.X_WB.p = centroid(mesh);
  for (Vec3& v : mesh.vertices) v -= bone.X_WB.p;
  bone.mesh = std::move(mesh);
  return bone;
}

std::string use_force(const ImportOptions& options) {
  return options.in_window ? "use `osteon import mesh --force` in a terminal" : "give --force";
}

std::string use_unit(const std::string& unit, const ImportOptions& options) {
  if (!options.in_window) return "Try --unit " + unit;
  if (unit == "m") return "Switch \"Meshes are in millimetres\" off under Open";
  if (unit == "mm") return "Switch \"Meshes are in millimetres\" on under Open";
  return "Try `osteon import mesh --unit " + unit + "` in a terminal";
}

// A bone has a volume, and about the size that its name says.
Result<void> refuse_no_bone(const std::string& name, const TriMesh& mesh, const fs::path& file,
                            const ImportOptions& options) {
  if (!build_hull(mesh.vertices).hull)
    return fail(mesh.triangles.size() == 1
                    ? "has no volume: it is one triangle"
                    : "has no volume: its " + std::to_string(mesh.triangles.size()) +
                          " triangles lie in one plane",
                file.string(), "Export the bone as a closed surface");
  const double exact_m = bounds(mesh).extent().maxCoeff();
  const double length_m = exact_m < 1e-3 ? exact_m : std::round(1e4 * exact_m) / 1e4;
  const std::string complaint = size_complaint(name, length_m);
  if (options.force || complaint.empty()) return {};
  const std::string unit = likely_unit(name, length_m, options.metres_per_unit);
  return fail(complaint, file.string(),
              (unit.empty() ? "Check the file" : use_unit(unit, options)) + ", or " +
                  use_force(options) + " to accept it");
}

// Parts that overlap are not one solid: what is felt and filled with tetrahedra would be wrong.
Result<void> refuse_overlap(const TriMesh& mesh, const fs::path& file,
                            const ImportOptions& options) {
  if (options.force) return {};
  const auto pair = crossing_parts(mesh);
  if (!pair) return {};
  return fail("has parts that pass through each other (triangles " + std::to_string(pair->first) +
                  " and " + std::to_string(pair->second) + " of the repaired mesh)",
              file.string(),
              "Merge them into one surface (a Boolean union) in the program that made them, or " +
                  use_force(options));
}

// Parts that only touch, along edges or faces, are not one solid either. An open surface is felt as
// its hull, whatever its edges are.
Result<void> refuse_touch(const TriMesh& mesh, const fs::path& file, const ImportOptions& options) {
  const Topology shape = topology(mesh);
  if (options.force || shape.boundary_edges > 0 || shape.non_manifold_edges == 0) return {};
  return fail("has " + std::to_string(shape.non_manifold_edges) +
                  (shape.non_manifold_edges == 1 ? " edge" : " edges") +
                  " with more than two triangles: parts of it touch there",
              file.string(),
              "Merge or separate them in the program that made them, or " + use_force(options));
}

Result<void> read_bone(const fs::path& file, const ImportOptions& options, ImportResult& result) {
  auto mesh = load_mesh(file, options.metres_per_unit);
  if (!mesh) return tl::unexpected(mesh.error());
  ImportedBone imported;
  imported.file = file;
  imported.repair = repair(*mesh);
  if (mesh->triangles.empty())
    return fail("holds no triangle with an area", file.string(), "Check the unit and the file");
  const std::string name = canonical_bone_name(file.stem().string());
  if (auto may = refuse_no_bone(name, *mesh, file, options); !may) return may;
  imported.crossings = self_crossings(*mesh).size();
  if (auto may = refuse_overlap(*mesh, file, options); !may) return may;
  if (auto may = refuse_touch(*mesh, file, options); !may) return may;
  // Which side of a surface is inside is not certain where it crosses itself.
  if (!options.keep_hollows && imported.crossings == 0) imported.hollows = fill_hollows(*mesh);
  imported.triangles = mesh->triangles.size();
  imported.closed = topology(*mesh).closed();
  for (std::size_t i = 0; i < result.def.bones.size(); ++i)
    if (result.def.bones[i].name == name)
      return fail("gives the bone '" + name + "', which " +
                      result.bones[i].file.filename().string() + " gives too",
                  file.string(), "Rename or remove one of the files");
  result.def.bones.push_back(center_bone(name, std::move(*mesh)));
  result.bones.push_back(std::move(imported));
  return {};
}

}  // namespace

Result<ImportResult> read_meshes(const ImportOptions& options) {
  const auto files = mesh_files(options);
  if (!files) return tl::unexpected(files.error());
  ImportResult result;
  result.def.name =
      options.name.empty() ? plain_folder(options.out).filename().string() : options.name;
  result.def.side = options.side;
  for (std::size_t i = 0; i < files->size(); ++i) {
    if (options.progress)
      options.progress(static_cast<double>(i) / static_cast<double>(files->size()));
    if (auto read = read_bone((*files)[i], options, result); !read)
      return tl::unexpected(read.error());
  }
  return result;
}

Result<ImportResult> import_meshes(const ImportOptions& options) {
  const fs::path out = plain_folder(options.out);
  if (auto free = refuse_existing(out); !free) return tl::unexpected(free.error());
  auto result = read_meshes(options);
  if (!result) return result;
  const auto saved =
      write_whole_folder(out, [&](const fs::path& part) { return save_case(result->def, part); });
  if (!saved) return tl::unexpected(saved.error());
  return result;
}

}  // namespace osteon
