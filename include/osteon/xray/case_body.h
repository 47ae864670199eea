#pragma once

#include <optional>

#include "osteon/image/tissue.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"
#include "osteon/xray/areal_density.h"

namespace osteon {

struct CaseBodyOptions {
  double cortical_m = 0.0012;  ///< thickness of the cortical shell
  double skin_m = 0.0015;      ///< thickness of the skin
  double fat_m = 0.002;        ///< of the fat under it
  double flesh_m = 0.008;      ///< muscle around bone that no skin encloses
  /// Every bone is one material of so many HU and nothing else is there: for phantoms.
  std::optional<double> bones_hu;
};

/// A case as X-rays see it: built once, then posed at little cost. It is made of the same tissues
/// in the same places as the virtual scanner makes it of (osteon/anatomy/virtual_scan.h): bone has
/// a cortical shell around cancellous bone; cartilage, menisci and discs, ligaments, tendons and
/// fat follow, and last what the skin encloses, by its depth: skin, fat, muscle.
class CaseBody {
 public:
  /// Fails with the name of a bone or soft part that is not closed, with the tissue that the table
  /// lacks, on a kind of soft part that is not known, and when there is no bone.
  static Result<CaseBody> create(const Case& the_case, const TissueTable& tissues,
                                 const CaseBodyOptions& options = {});

  /// Bones as they stand; soft parts follow the mean motion of their bones.
  XrayBody posed(const BoneSnapshot& bones) const;
  XrayBody at_rest() const;

 private:
  /// A surface with what it moves with.
  struct Part {
    std::shared_ptr<const TriMesh> mesh;
    std::size_t bone = 0;         ///< it is in this bone's frame; of a soft part unused
    bool soft = false;            ///< in World at rest
    std::vector<std::size_t> on;  ///< bones that a soft part moves with
    Vec3 center = Vec3::Zero();   ///< of a soft part
  };
  struct Layer {
    std::string name;
    XrayMaterial material;
    std::vector<Part> parts;
  };
  struct Builder;

  Pose pose_of(const Part& part, const BoneSnapshot& bones) const;

  std::vector<Layer> layers_;
  std::vector<Pose> rest_X_WB_;
};

}  // namespace osteon
