#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "exercises/attempt_watch.h"
#include "osteon/procedure/graft_watch.h"
#include "osteon/procedure/placing_watch.h"
#include "window/exercise_model.h"

namespace osteon {

/// What was found out at a bench and is needed later, and how far work has come that no picture
/// shows: a stripper on its tendon, thread and muscle of each. Nothing of a case without a bench.
std::vector<ExerciseModel::Told> facts_of(const GraftWatch& graft);
/// How far the fascia over both tendons is open, and which of them were found. Nothing where none
/// covers them.
std::vector<ExerciseModel::Told> fascia_of(const GraftWatch& graft);
/// Of each tendon that lies in the thigh, while it is to be stripped: how many of its bands are
/// cut. No picture shows a band.
std::vector<ExerciseModel::Told> bands_of(const GraftWatch& graft);
/// The same of a graft that is placed: the pin in the femur, the thread, how far the graft is drawn
/// in, a screw. Nothing before there are tunnels.
std::vector<ExerciseModel::Told> facts_of(const PlacingWatch& placing);

/// Of landmarks that the live stage wants seen and that are in a scope's picture, not counted yet:
/// what is still missing, or that it is right. `tools` as `hands`.
std::vector<ExerciseModel::Told> sights_of(const ScenarioPlan& plan, const ScenarioState& state,
                                           const Case& the_case, std::span<const PlannedHand> hands,
                                           std::span<const ToolState> tools,
                                           const BoneSnapshot& bones);

/// What a goal that names no mark asks for, by the kind of its rule, in a few words for the list of
/// what is left. Empty: it has none.
std::string words_of_goal(std::string_view kind);

/// Every stage was done. The score of an attempt that was broken off says how little time it took.
bool is_whole(const Outcome& outcome);
/// Why an attempt is not passed, in the order in which it is judged. Empty: it is, or there is no
/// standard that says it. `pass_score`: what that standard wants.
std::string why_of(const Outcome& outcome, const std::optional<double>& pass_score);

}  // namespace osteon
