#pragma once

#include <memory>
#include <string>
#include <vector>

#include "osteon/render/scope_camera.h"
#include "osteon/scene/case.h"

namespace osteon {

/// How much of a scope's round picture shows one part.
struct SeenPart {
  std::string name;
  double share = 0;      ///< of the picture's area
  double nearest_m = 0;  ///< from the eye
};
struct ScopeSight {
  std::string nearest;     ///< the bone that is nearest to the tip
  double clearance_m = 0;  ///< from the tip to its surface; negative: the tip is in it
  std::string within;      ///< a soft part that the tip is in; fat, which gives way, does not count
  std::vector<SeenPart> parts;  ///< the largest first; what shows none of the case is not listed

  double share_of(const std::string& part) const;
};

/// What a scope shows of a case at rest, by rays. Needs no OpenGL.
class ScopeRays {
 public:
  /// Bones, and soft parts without the skin. Keeps what it needs of the case.
  explicit ScopeRays(const Case& the_case);
  ~ScopeRays();
  ScopeRays(ScopeRays&&) noexcept;
  ScopeRays& operator=(ScopeRays&&) noexcept;

  /// `across`: rays along the picture's diameter. What is farther than 60 mm is the joint's wall
  /// and no part.
  ScopeSight look(const ScopeCamera& camera, int across = 48) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace osteon
