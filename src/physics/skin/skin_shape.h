#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "osteon/physics/skin_state.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/physics/soft_shape.h"
#include "osteon/scene/case.h"
#include "osteon/scene/soft_pushes.h"

namespace osteon {

/// The case's skin with its patches as they are cut and pressed, for pictures.
class SkinShape {
 public:
  /// `setup` has patches, and must outlive it.
  SkinShape(const Case& the_case, const SoftSetup& setup);
  /// The skin, where it looks otherwise than was given last. Its first vertices are those of the
  /// case's skin; those of the patches follow.
  std::optional<SoftShapes::Changed> change(const SoftPushes& pushes);

 private:
  struct Patch {
    Pose X_WS;
    std::shared_ptr<const SkinCuts> cuts;
    std::shared_ptr<const SheetYield> yields;
    std::vector<SkinDent> dents;
    std::vector<SkinLipPull> pulls;
  };
  void add(std::size_t patch, SoftShapes::Changed& to) const;

  const SoftSetup& setup_;
  TriMesh whole_W_, around_W_;
  std::vector<Patch> patches_;
};

}  // namespace osteon
