#include "cases/mesh_source.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "cases/open_case.h"
#include "osteon/mesh/mesh_io.h"

namespace osteon {
namespace {

constexpr double kMillimetre = 0.001;

Result<MeshSource> from_case(const std::string& spec, const std::string& part_name) {
  auto def = open_case_def(spec);
  if (!def) return tl::unexpected(def.error());
  std::string names;
  for (BoneDef& bone : def->bones) {
    if (bone.name == part_name) {
      for (Vec3& v : bone.mesh.vertices) v = bone.X_WB * v;
      return MeshSource{bone.name, std::move(bone.mesh), kMillimetre, {}};
    }
    names += (names.empty() ? "" : ", ") + bone.name;
  }
  for (SoftDef& soft : def->softs) {
    if (soft.name == part_name)
      return MeshSource{soft.name, std::move(soft.mesh_W), kMillimetre, {}};
    names += ", " + soft.name;
  }
  return fail("has no bone and no soft part '" + part_name + "'", spec, "It has " + names);
}

Result<MeshSource> from_file(const std::string& file, const std::string& unit) {
  const auto metres = unit_from_text(unit);
  if (!metres) return fail("has no unit", file, "Give --unit m, cm or mm");
  auto mesh = load_mesh(file, *metres);
  if (!mesh) return tl::unexpected(mesh.error());
  MeshSource source{std::filesystem::path(file).filename().string(), std::move(*mesh), *metres, {}};
  source.repair = repair(source.mesh);
  return source;
}

}  // namespace

std::optional<double> unit_from_text(const std::string& text) {
  if (text == "m") return 1.0;
  if (text == "cm") return 0.01;
  if (text == "mm") return kMillimetre;
  return std::nullopt;
}

Result<MeshSource> load_mesh_source(const std::string& spec, const std::string& unit) {
  const std::size_t mark = spec.rfind('#');
  std::error_code ec;
  if (mark == std::string::npos || std::filesystem::exists(spec, ec)) {
    if (std::filesystem::is_directory(spec, ec) || spec.starts_with("builtin:"))
      return fail("is a case", spec, "Name one of its parts: " + spec + "#PART");
    return from_file(spec, unit);
  }
  return from_case(spec.substr(0, mark), spec.substr(mark + 1));
}

}  // namespace osteon
