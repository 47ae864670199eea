#pragma once

#include "osteon/base/result.h"
#include "osteon/scene/build_case.h"

namespace osteon {

class FieldCache;
class PieceCache;

/// A closed mesh less what lies beyond a plane, closed again by a flat end: n . p <= c is left.
/// Every place where the plane cuts it must be seen whole from its own middle, as a shaft's is.
/// Empty where nothing is left.
TriMesh cut_off(const TriMesh& mesh, const Vec3& n, double c);

/// Of a knee that was grown: femur and tibia end so far from the joint. What an operation does not
/// reach need not be prepared. Fails on another case.
Result<void> crop_knee(CaseDef& def, double near_m);

/// Of bones that are felt as fields in such a case: fields with cells of 0.5 mm, and one hull a
/// bone for physics, in the places where build_case looks for finer ones.
void prepare_cropped(const CaseDef& def, PieceCache& pieces, FieldCache& fields);

}  // namespace osteon
