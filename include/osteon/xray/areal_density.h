#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/xray/attenuation.h"
#include "osteon/xray/c_arm.h"

namespace osteon {

/// A surface that is closed and faces outwards, as xray_surface checks; M is its own frame.
struct XraySurface {
  std::shared_ptr<const TriMesh> mesh_M;
  Pose X_WM;
};

/// All that lies in any of its surfaces is of one material.
struct XrayLayer {
  std::string name;
  XrayMaterial material;
  std::vector<XraySurface> surfaces;
};

/// What the rays go through. Where layers overlap, the first of them is there: metal before bone,
/// bone before what surrounds it. Outside all is vacuum.
struct XrayBody {
  std::vector<XrayLayer> layers;  ///< at most kMaxXrayLayers
};
inline constexpr std::size_t kMaxXrayLayers = 64;

/// Takes a mesh, turns it outwards where it faces inwards. Fails with `name` when it is empty, not
/// finite, has an index out of range or is not closed: how far a ray goes in it could not be told.
Result<std::shared_ptr<const TriMesh>> xray_surface(TriMesh mesh, const std::string& name);

/// Runs task(0) to task(count - 1), in any order, on as many threads as it likes.
using RunXrayTasks =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>&)>;

/// Mass that each pixel's ray meets between source and detector, g/cm2, rows from the top.
struct ArealDensity {
  int width = 0, height = 0;
  std::array<std::vector<float>, kXraySubstances> of;  ///< by substance

  std::vector<float> total() const;
};

/// Follows the ray from the source to the middle of each pixel. The lengths are those of a straight
/// line through the triangles (a pixel's place is rounded to 1/4096 of a pixel), so a closed mesh
/// is never counted half. What lies within 10 mm of the source's plane, or behind it, is left out.
/// The same input gives the same bits, however the tasks run. Fails on a view or a body out of
/// range.
Result<ArealDensity> areal_density(const XrayBody& body, const XrayView& view,
                                   const RunXrayTasks& run = {});

}  // namespace osteon
