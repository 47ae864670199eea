#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

/// All points within a radius of a line from p0 to p1, in Tool; a ball where these are one point.
struct RoundRod {
  Vec3 p0 = Vec3::Zero(), p1 = Vec3::Zero();
  double radius = 0;
};

/// All points with rho * n_rho + z * n_z <= offset, rho being the distance from Tool's z axis:
/// a cylinder, a cone or a plane across. (n_rho, n_z) is a unit vector, n_rho >= 0.
struct TurnedFace {
  double n_rho = 1, n_z = 0, offset = 0;
};

/// A convex part of a cutter: what all of its rods, faces and planes hold. In Tool.
struct CutterPart {
  std::vector<RoundRod> rods;
  std::vector<TurnedFace> faces;
  std::vector<Plane> planes;
  Aabb box;  ///< holds the part
};

/// What an instrument removes. Tool frame: origin at the middle of the tip, shaft along +z.
struct Cutter {
  std::string name;
  double size_m = 0;  ///< diameter or width
  std::vector<CutterPart> parts;
  /// Removes at the poses that it is given, not on the way between them: a punch.
  bool bites = false;
  bool finite() const;
};

/// One kind of instrument, for lists and help.
struct CutterKind {
  std::string_view name;     ///< "burr"
  std::string_view meaning;  ///< "a ball"
};
/// burr, drill, pin, reamer, awl, kerrison, curette, chisel, osteotome, shaver.
std::span<const CutterKind> cutter_kinds();

/// The cutter of that name with that diameter or width. Fails on an unknown name and on a size
/// that is not within 0.2 and 40 mm.
Result<Cutter> make_cutter(std::string_view name, double size_m);

}  // namespace osteon
