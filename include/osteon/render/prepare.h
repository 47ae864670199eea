#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/scene/case.h"

namespace osteon {

/// A bone's surface as it is drawn: smooth unit normals and light that does not depend on the view.
/// Index k of all three vectors is one vertex, in Bone.
struct ShadedMesh {
  struct Shade {
    std::uint8_t openness;  ///< 255: sees the whole sky; lower: other bone is near (occlusion)
    std::uint8_t cavity;    ///< 128: flat; below: hollow; above: ridge
    std::uint8_t mottle;    ///< 128: the bone's own colour; the rest is its slight variation. Of
                            ///< cartilage: 0 at its rim, 128 where it is thick
    std::uint8_t felt;      ///< height of what is felt over it (prepare_felt): 128: none, or not
                            ///< worked out; 1 and 255: kFeltRange_m
  };
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;
  std::vector<Shade> shades;
  std::vector<Triangle> triangles;
  bool closed = false;  ///< every edge has two triangles that face outwards: no inside is ever seen
  /// Fewer triangles over the same vertices, for a bone that is small on the screen.
  struct Level {
    std::vector<Triangle> triangles;
    double error_m = 0;  ///< how far the surface may lie from the full one, about
  };
  std::vector<Level> coarser;  ///< the finest first; none where leaving out saves little
  /// A vertex of a soft part that was drawn into the bone that it grows into.
  struct Root {
    std::uint32_t vertex = 0;
    std::array<float, 3> shift{}, out{};  ///< metres; the bone's normal there
    float share = 0;                      ///< of that normal
    bool buried = false;                  ///< it lies in bone
  };
  std::vector<Root> roots;
};

/// What is worked out once per case before it can be drawn; needs no OpenGL, so that a loading
/// screen can do it on a worker thread.
struct PreparedCase {
  std::vector<ShadedMesh> bones;
  std::vector<ShadedMesh> softs;  ///< in World at rest
};

/// Called with 0..1; returns false to stop.
using PrepareProgress = std::function<bool(double)>;

/// Welds equal vertices, makes normals and casts rays from every vertex in the rest pose for the
/// occlusion in the joint spaces (about a second for a wrist of 35 000 vertices). Triangles with
/// vertices that are missing or not finite are left out. The same case gives the same bytes. When
/// stopped, vertices not reached keep openness 255.
PreparedCase prepare_case(const Case& the_case, const PrepareProgress& progress = {});

/// The same surfaces with all of the light (openness 255), without the rays that take most of the
/// time: for a picture at once, until prepare_case is done.
PreparedCase prepare_unlit(const Case& the_case);

/// Works out the height of what is felt over every vertex, for ViewState::show_felt: seconds for a
/// wrist felt as pieces, so only where it is asked for. `prepared` comes from
/// prepare_case(the_case). When stopped, bones not reached keep 128.
void prepare_felt(const Case& the_case, PreparedCase& prepared,
                  const PrepareProgress& progress = {});

}  // namespace osteon
