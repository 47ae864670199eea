#pragma once

#include <memory>

#include "osteon/physics/carving.h"
#include "osteon/session/session_state.h"
#include "state/words.h"

// The parts of a session's state; each is listed in the file named above it.
namespace osteon::stored {

// tool_fields.cpp
template <class A>
void field(A& a, ToolState& value);
template <class A>
void field(A& a, OtherTool& value);
template <class A>
void field(A& a, PortalHold& value);

// haptic_fields.cpp
template <class A>
void field(A& a, HapticState& value);
template <class A>
void field(A& a, HapticParams& value);

// graft_fields.cpp
template <class A>
void field(A& a, GraftBenchState& value);
template <class A>
void field(A& a, GraftPlacingState& value);
template <class A>
void bend_fields(A& a, BendState& bend, KneeExamState& exam);
template <class A>
void field(A& a, ToldKnee& value);

// bones_fields.cpp
template <class A>
void field(A& a, GuideRod& value);
template <class A>
void field(A& a, InsideList& value);
template <class A>
void field(A& a, BoneSnapshot& value);
template <class A>
void field(A& a, RingsState& value);

// carving_fields.cpp
template <class A>
void field(A& a, CarveState& value);
template <class A>
void field(A& a, std::shared_ptr<const CarvingState>& value);
template <class A>
void field(A& a, FallenPiecesState& value);

// cut_fields.cpp
template <class A>
void field(A& a, std::shared_ptr<const SoftCutState>& value);

// skin_fields.cpp
template <class A>
void field(A& a, std::shared_ptr<const SkinState>& value);

// soft_fields.cpp
template <class A>
void field(A& a, SoftState& value);

}  // namespace osteon::stored
