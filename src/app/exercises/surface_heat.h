#pragma once

#include "exercises/damage_map.h"
#include "osteon/session/session.h"
#include "runs/reports/carving_report.h"

namespace osteon {

/// How warm the surfaces of carved bones get.
class SurfaceHeat {
 public:
  /// The case must outlive it.
  explicit SurfaceHeat(const Case& the_case) : case_(&the_case) {}
  /// After each tick of a session that carves.
  void see(const Session& session) { heat_.see(session); }
  /// After the last.
  void finish(DamageMaker& damage) const;

 private:
  const Case* case_;
  SessionHeat heat_;
};

}  // namespace osteon
