#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "osteon/mesh/distance.h"
#include "osteon/render/renderer.h"
#include "ui/side_job.h"

namespace osteon {

/// How far a tip is from the nearest surface of bone. What the search needs is made beside the
/// picture, once a case.
class TipGauge {
 public:
  struct Nearest {
    BoneId bone;
    Vec3 p_W = Vec3::Zero();  ///< on its surface
    double distance_m = 0;    ///< below 0: inside
  };
  /// Forgets the case before.
  void begin(std::shared_ptr<const Case> the_case);
  /// Once a picture. None while the search is being made, and with no bone in sight.
  std::optional<Nearest> nearest(const RenderSnapshot& snapshot, const ViewState& view);

 private:
  struct BoneSurface {
    MeshDistance distance;
    Aabb box_B;
    std::uint32_t guess = 0;
  };
  using Surfaces = std::vector<BoneSurface>;
  static Result<Surfaces> make(const Case& the_case, const Progress& progress);

  std::unique_ptr<SideJob<Surfaces>> job_;
  Surfaces surfaces_;
};

}  // namespace osteon
