#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "osteon/mesh/distance.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/render/renderer.h"
#include "ui/side_job.h"

namespace osteon {

/// How far a tip is from the nearest surface of bone, or of a ligament, meniscus, stump or patch of
/// skin that is felt, at rest and as it was before any cut. Skin counts for who is outside of it.
/// What the search needs is made beside the picture, once a case and once for what is felt.
class TipGauge {
 public:
  struct Nearest {
    BoneId bone;                        ///< that it is, or that the soft part lies on
    std::optional<std::uint32_t> soft;  ///< in Case::softs
    Vec3 p_W = Vec3::Zero();            ///< on its surface
    double distance_m = 0;              ///< below 0: inside
  };
  /// Forgets the case before.
  void begin(std::shared_ptr<const Case> the_case);
  /// What is felt of the case from now on; null: nothing soft. The same again costs nothing.
  void feel(const std::shared_ptr<const SoftSetup>& felt);
  /// Returns when nothing is being made any more.
  void wait() const;
  /// Once a picture. None while the search is being made, and with no bone in sight.
  std::optional<Nearest> nearest(const RenderSnapshot& snapshot, const ViewState& view);
  /// How far the tip of that hand's drill or pin has come from the mouth of its hole, along the
  /// hole, by the bone as it was before any cut. None: it is in no hole.
  std::optional<double> depth_m(const RenderSnapshot& snapshot, std::size_t hand);

 private:
  struct GaugedSurface {
    BoneId bone;
    std::optional<std::uint32_t> soft;
    MeshDistance distance;
    Aabb box_B;
    std::uint32_t guess = 0;
    const SkinPatch* skin = nullptr;  ///< a patch of what is felt

    /// Under the skin what lies deeper is of interest.
    bool is_past(const Vec3& tip_B) const;
  };
  using Surfaces = std::vector<GaugedSurface>;
  static Result<Surfaces> of_bones(const Case& the_case, const Progress& progress);
  static Result<Surfaces> of_softs(const Case& the_case, const SoftSetup& felt,
                                   const Progress& progress);
  static GaugedSurface of_skin(const SkinPatch& patch);
  static bool is_seen(const GaugedSurface& surface, const ViewState& view);
  void take_made();

  std::shared_ptr<const Case> case_;
  std::shared_ptr<const SoftSetup> felt_;
  std::unique_ptr<SideJob<Surfaces>> bones_job_, softs_job_;
  Surfaces bones_, softs_;
};

}  // namespace osteon
