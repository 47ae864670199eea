#pragma once

#include <string>

#include "cases/mesh_source.h"
#include "osteon/mesh/tetrahedra.h"

namespace osteon {

/// What `osteon mesh tetrahedra` prints: a few lines, then the dihedral angles by ten degrees as
/// the lattice gave them and as they are now.
std::string tet_report_text(const MeshSource& source, const Tetrahedra& made);
/// The same as JSON; SI units but where a key says otherwise.
std::string tet_report_json(const MeshSource& source, const Tetrahedra& made);

/// Of a mesh that was read: how good its elements are.
std::string tet_quality_text(const std::string& name, const TetMesh& mesh);
std::string tet_quality_json(const std::string& name, const TetMesh& mesh);

}  // namespace osteon
