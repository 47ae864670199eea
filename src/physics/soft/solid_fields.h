#pragma once

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/physics/soft_solid_setup.h"

namespace osteon {

/// The fields of a soft solid's surface, for who touches it and for who cuts it. `what`: named in
/// errors. `known`: where the first of them is looked for, and put; null: it is made. Fails on a
/// surface that is open.
Result<void> make_solid_fields(const TriMesh& mesh_B, const std::string& what, FieldCache* known,
                               SoftSolid& out);

}  // namespace osteon
