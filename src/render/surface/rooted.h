#pragma once

#include <vector>

#include "osteon/render/prepare.h"
#include "osteon/scene/case.h"
#include "surface/surface.h"

namespace osteon {

/// Where a ligament, a tendon or a meniscus grows into the bones that it names: how its surface, in
/// World at rest, is drawn into them, so that it meets them in a smooth line and widens towards it.
/// Its own rim lies in steps of the cells that it was grown in. Empty for other kinds.
std::vector<ShadedMesh::Root> find_roots(const Case& the_case, const SoftPart& soft,
                                         const Surface& surface);
/// How high the surface lies over the bones that the soft part names, by its vertices; where
/// cartilage ends that is nothing.
std::vector<double> heights_over_bones(const Case& the_case, const SoftPart& soft,
                                       const Surface& surface);
/// Moves the points and makes their normals anew, near bone as the bone's.
void draw_in(const std::vector<ShadedMesh::Root>& roots, Surface& surface);
/// Vertices that lie in bone take the values of those beside them that do not: what a vertex in
/// bone sees of the sky darkens the triangles that come out of it.
void fill_buried(const std::vector<ShadedMesh::Root>& roots, const Surface& surface,
                 std::vector<float>& values);

}  // namespace osteon
