#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/scene/case.h"
#include "osteon/scene/path.h"
#include "osteon/surgeon/skill.h"

namespace osteon {

/// The way of one hand that makes a graft at a bench: all bands cut, both tendons stripped, folded
/// to as few strands as make 8 mm and 75 mm, sized, kept at about 80 N for ten minutes of the
/// board's clock, hung on the shortest loop with which the button turns. A beginner is slower and
/// trembles more. `skill` "bad:NAME" does one thing wrong: amputated_tendon, unflipped_button,
/// long_loop, slack_graft, muscle_left, few_stitches. Fails on another NAME and where the case has
/// no bench.
Result<ProbePath> plan_graft(const Case& the_case, const Skill& skill);

/// How wide somebody will drill the tunnels for that graft: as the sizer that it passes. `skill`
/// "bad:wide_tunnel": wider. Fails where the case has no bench.
Result<double> drilled_for_graft(const Case& the_case, const Skill& skill);
/// The same work within a reconstruction, before the tunnels are drilled: from where the hand with
/// what it holds is, `begin_s` later, up to the board, which pulls on, and back. `X_WSite`: of the
/// skin over the tendons' insertion, z out of it and y along the limb; it is cut open first. None:
/// nobody cuts it. `skill` "bad:NAME": incision_aside, incision_deep, amputated_tendon,
/// muscle_left, few_stitches, slack_graft.
Result<ProbePath> plan_graft_stage(const Case& the_case, const Skill& skill, double begin_s,
                                   const Pose& from, const std::string& held,
                                   const std::optional<Pose>& X_WSite = std::nullopt);
/// What is left once the femur's channel and socket are measured: the button's loop, by them.
/// `skill` "bad:NAME": short_loop, long_loop.
Result<ProbePath> plan_loop_stage(const Case& the_case, const Skill& skill, double channel_m,
                                  double socket_m, const Pose& from, const std::string& held);
/// What a bad surgeon can do wrong in these stages, as errors are named.
std::span<const std::string_view> graft_faults_in_knee();

}  // namespace osteon
