#pragma once

#include <string>

#include "osteon/base/result.h"
#include "osteon/procedure/scope_watch.h"
#include "osteon/scene/case.h"
#include "osteon/scene/path.h"
#include "osteon/surgeon/skill.h"

namespace osteon {

/// Who makes the portals of a knee: one hand with the scope, one with what cuts and goes through.
struct PunctureWays {
  ProbePath scope, worker;
};

/// The worker cuts the skin at the anterolateral portal and goes in through the cut with the blunt
/// trocar; the scope follows there and looks at the place of the anteromedial portal, whose
/// way the worker finds with a needle, and which he makes under its eyes and enters with a hook.
/// `scope`: as the tray names it. A beginner is slower, trembles and misses both places by up to 4
/// mm. `skill` "bad:NAME" does one thing wrong: al_low, al_midline, al_lateral, am_medial, forced,
/// plunged, am_blind. Fails on another NAME, on a case without what a knee has, and where no way
/// into the joint is free.
Result<PunctureWays> plan_puncture(const Case& the_case, const std::string& scope,
                                   const ScopeOptics& optics, const Skill& skill);

}  // namespace osteon
