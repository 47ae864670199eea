#include "cases/import_mesh.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "cases/whole_folder.h"
#include "osteon/mesh/hollows.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

Result<std::vector<fs::path>> mesh_files(const fs::path& source) {
  std::error_code ec;
  if (fs::is_regular_file(source, ec)) return std::vector<fs::path>{source};
  std::vector<fs::path> files;
  fs::directory_iterator entries(source, ec);
  if (ec) return fail("cannot be read (" + ec.message() + ")", source.string(), "Check the name");
  for (const fs::directory_entry& entry : entries)
    if (entry.is_regular_file(ec) && is_mesh_file(entry.path())) files.push_back(entry.path());
  if (files.empty())
    return fail("holds no mesh", source.string(), "Put STL, OBJ, PLY, glTF or GLB files there");
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

Result<void> read_bone(const fs::path& file, const ImportOptions& options, ImportResult& result) {
  auto mesh = load_mesh(file, options.metres_per_unit);
  if (!mesh) return tl::unexpected(mesh.error());
  ImportedBone imported;
  imported.file = file;
  imported.repair = repair(*mesh);
  if (!options.keep_hollows) imported.hollows = fill_hollows(*mesh);
  if (mesh->triangles.empty())
    return fail("holds no triangle with an area", file.string(), "Check the unit and the file");
  imported.triangles = mesh->triangles.size();
  imported.closed = topology(*mesh).closed();
  const std::string name = canonical_bone_name(file.stem().string());
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
  const auto files = mesh_files(options.source);
  if (!files) return tl::unexpected(files.error());
  ImportResult result;
  result.def.name =
      options.name.empty() ? plain_folder(options.out).filename().string() : options.name;
  result.def.side = options.side;
  for (const fs::path& file : *files)
    if (auto read = read_bone(file, options, result); !read) return tl::unexpected(read.error());
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
