#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "osteon/mesh/tri_mesh.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/scene/case.h"
#include "osteon/scene/soft_pushes.h"

namespace osteon {

class CutShape;
class SkinShape;

/// Surfaces of soft solids, bands and skin as they are under pushes, for pictures.
class SoftShapes {
 public:
  /// `setup` may be null: nothing is soft then.
  SoftShapes(const Case& the_case, std::shared_ptr<const SoftSetup> setup);
  ~SoftShapes();
  SoftShapes(SoftShapes&&) noexcept;

  /// The surface of a soft part with its bone at rest.
  struct Changed {
    std::uint32_t soft = 0;  ///< in Case::softs
    TriMesh mesh_W;
    /// Of skin that is cut or pressed: of each vertex how deep it lies in a groove, 0 outside. The
    /// first vertices are those of the case's skin.
    std::vector<float> depth_m;
  };
  /// Those that have another shape than was given last, so that it can be seen: by more than 5 um
  /// under a push of a meniscus, by a cut into it (its surface has other vertices then), or of a
  /// ligament's middle line or strands. At first all are at rest. A ligament that was cut or has
  /// torn is two stumps, at rest.
  std::vector<Changed> changes(const SoftPushes& pushes);

 private:
  struct Shape {
    TriMesh mesh_W;                          ///< at rest
    Pose X_WB;                               ///< rest pose of the bone
    std::vector<SolidPatch> patches;         ///< of each vertex of the whole one
    std::vector<SoftPushes::One> shown;      ///< pushes that it was given with
    TriMesh whole_W;                         ///< `mesh_W` before any cut
    std::shared_ptr<const CarveState> cuts;  ///< that it was given with
    std::unique_ptr<CutShape> left;          ///< null: it is whole
    TriMesh drawn_W;                         ///< as it was given
  };
  void cut(std::size_t solid, std::shared_ptr<const CarveState> cuts);
  void find_patches(std::size_t solid);
  bool take(std::size_t solid, const SoftPushes& pushes);
  TriMesh drawn(std::uint32_t soft) const;
  struct BandShape {
    TriMesh mesh_W;                  ///< at rest
    BandSpan rest_W;                 ///< the string, with the bones at rest
    std::vector<StringBend> shown;   ///< bends that it was given with
    std::optional<double> broken;    ///< where it was given in two
    std::optional<BandNotch> notch;  ///< with which it was given
    StrandAxes section;              ///< with the bones at rest
  };
  std::vector<Vec3> moved(std::size_t solid, std::span<const SoftPushes::One> pushes) const;
  void add_bands(const SoftPushes& pushes, std::vector<Changed>& out);

  std::shared_ptr<const SoftSetup> setup_;
  std::vector<Shape> shapes_;
  std::vector<BandShape> bands_;
  std::unique_ptr<SkinShape> skin_;  ///< null: no patch of skin is felt
};

}  // namespace osteon
