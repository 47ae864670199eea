#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "osteon/physics/carving.h"
#include "osteon/render/renderer.h"
#include "osteon/scene/path.h"
#include "osteon/scene/portal.h"
#include "runs/hands/live_run.h"
#include "window/controllers/views/picture_views.h"

namespace osteon {

/// The case on show and what draws it. Needs the window's context in the destructor.
struct ShownCase {
  std::shared_ptr<const Case> the_case;  ///< null: nothing has been opened yet
  std::string source;
  std::string finer_source;  ///< the case as asked for, while bones are felt as hulls; else empty
  std::optional<Renderer> renderer;
  PictureViews views;
  ProbePath demo;
  std::shared_ptr<const CarvingSetup> carving;  ///< for a live run of the case
  CarveSettings carve;                          ///< with which that was made
  RunSofts softs;                               ///< likewise
  std::vector<Portal> portals;
  std::vector<Vec3> bone_middles_B;  ///< where their names stand

  /// The case as it was asked for: for what is saved or opened again.
  const std::string& wanted_source() const { return finer_source.empty() ? source : finer_source; }
};

}  // namespace osteon
