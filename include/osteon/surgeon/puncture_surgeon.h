#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/procedure/scope_watch.h"
#include "osteon/scene/case.h"
#include "osteon/scene/path.h"
#include "osteon/surgeon/skill.h"

namespace osteon {

/// Who makes the portals of a knee: one hand with the scope, one with what cuts and goes through.
struct PunctureWays {
  ProbePath scope, worker;
  Vec3 al_W = Vec3::Zero(), am_W = Vec3::Zero();  ///< where the portals will be, the knee at rest
  std::vector<std::string> unseen = {};           ///< landmarks that the scope cannot show
  std::vector<std::string> unfelt = {};           ///< landmarks that no hook gets to
};

/// What is done once both portals are there.
struct PunctureEnd {
  std::string held = "scalpel_11";         ///< by the worker as he begins
  bool leaves = false;                     ///< else he goes on to the footprint with the hook
  std::vector<std::string> looks_at = {};  ///< landmarks that the scope shows before both leave
  std::vector<std::string> feels = {};     ///< those that the worker presses with the hook then
};

/// The worker cuts the skin at the anterolateral portal and goes in through the cut with the blunt
/// trocar; the scope follows there and looks at the place of the anteromedial portal, whose
/// way the worker finds with a needle, and which he makes under its eyes and enters with a hook, or
/// both leave. The knee is bent as the case begins. `scope`: as the tray names it. A beginner is
/// slower, trembles and misses both places by up to 4 mm. `skill` "bad:NAME" does one thing wrong:
/// al_low, al_midline, al_lateral, am_medial, forced, plunged, am_blind. Fails on another NAME, on
/// a case without what a knee has, and where no way into the joint is free.
Result<PunctureWays> plan_puncture(const Case& the_case, const std::string& scope,
                                   const ScopeOptics& optics, const Skill& skill,
                                   const PunctureEnd& end = {});

/// What a bad surgeon can do wrong, as an exercise's errors are named.
std::span<const std::string_view> puncture_faults();

}  // namespace osteon
