#pragma once

#include <optional>
#include <string>

#include "osteon/base/result.h"
#include "osteon/mesh/repair.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// A surface by what a user names it: a mesh file, or CASE#PART for one bone or soft
/// part of a case.
struct MeshSource {
  std::string name;            ///< of the file or the part
  TriMesh mesh;                ///< metres; a part's in World
  double metres_per_unit = 1;  ///< in which a file made from it is written: a part's in mm
  RepairReport repair;         ///< of a file: what was mended
};

/// "m", "cm" or "mm".
std::optional<double> unit_from_text(const std::string& text);

/// Reads and mends a mesh file, whose `unit` must be given, or takes a part from a case. Fails with
/// the names of the case's parts where it has none of that name.
Result<MeshSource> load_mesh_source(const std::string& spec, const std::string& unit);

}  // namespace osteon
