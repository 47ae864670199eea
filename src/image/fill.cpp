#include "osteon/image/fill.h"

#include <algorithm>

#include "runs.h"

namespace osteon {
namespace {

constexpr double kWidestMarrow_m2 = 1.5e-3;

/// Voxel (u, v) of face `side` (0 or 1) across `axis`.
std::array<int, 3> on_face(const GridFrame& frame, std::size_t axis, int side, int u, int v) {
  std::array<int, 3> at{};
  at[axis] = side == 0 ? 0 : frame.size[axis] - 1;
  at[(axis + 1) % 3] = u;
  at[(axis + 2) % 3] = v;
  return at;
}

void fill_enclosed(Mask& mask) {
  const Parts outside = connected_parts(mask, 0);
  for (const Run& run : outside.runs)
    if (!outside.parts[run.part].touches_rim)
      std::fill_n(mask.values.begin() +
                      static_cast<std::ptrdiff_t>(mask.frame.index(run.begin, run.j, run.k)),
                  run.end - run.begin, std::uint8_t{1});
}

void fill_face(Mask& mask, std::size_t axis, int side) {
  const int nu = mask.frame.size[(axis + 1) % 3], nv = mask.frame.size[(axis + 2) % 3];
  Mask face;
  face.frame.size = {nu, nv, 1};
  face.values.resize(face.frame.count());
  for (int v = 0; v < nv; ++v)
    for (int u = 0; u < nu; ++u) {
      const auto at = on_face(mask.frame, axis, side, u, v);
      face.at(u, v, 0) = mask.at(at[0], at[1], at[2]);
    }
  const Parts outside = connected_parts(face, 0);
  const int iu = static_cast<int>((axis + 1) % 3), iv = static_cast<int>((axis + 2) % 3);
  for (const Run& run : outside.runs) {
    const RunPart& part = outside.parts[run.part];
    // A wide area is a cavity of the body that the grid cuts, such as the skull's: no marrow.
    const double area_m2 =
        static_cast<double>(part.voxels) * mask.frame.spacing_m[iu] * mask.frame.spacing_m[iv];
    const bool open = area_m2 > kWidestMarrow_m2 || part.box.lo[0] == 0 || part.box.lo[1] == 0 ||
                      part.box.hi[0] == nu || part.box.hi[1] == nv;
    for (int u = run.begin; !open && u < run.end; ++u) {
      const auto at = on_face(mask.frame, axis, side, u, run.j);
      mask.at(at[0], at[1], at[2]) = 1;
    }
  }
}

}  // namespace

void fill_holes(Mask& mask) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) fill_face(mask, axis, side);
  fill_enclosed(mask);
}

}  // namespace osteon
