#pragma once

#include "osteon/scene/event.h"

namespace osteon {

/// Kinds of events of soft parts: the codes 100 to 199 of EventKind. Their subject is the part.
inline constexpr EventKind kSoftBegin{100};  ///< an instrument begins to push or pull it
inline constexpr EventKind kSoftEnd{101};    ///< and has let go
inline constexpr EventKind kSoftOver{102};   ///< the force on it has gone over the session's limit
inline constexpr EventKind kSoftTorn{103};   ///< its tension has reached its failure load
inline constexpr EventKind kSoftLost{104};   ///< it could not be solved: it is felt no more
inline constexpr EventKind kSoftCut{105};    ///< cut in two; of a solid: a cut into it begins
inline constexpr EventKind kSoftPiece{108};  ///< a piece of a solid has come off
inline constexpr EventKind kSoftHeld{
    109};  ///< jaws shut about it, or suction draws it, and hold it
inline constexpr EventKind kSoftFreed{110};    ///< what held it has let go
inline constexpr EventKind kSoftSlipped{111};  ///< it was pulled off what held it
inline constexpr EventKind kSkinCut{112};      ///< an edge goes into skin: a stroke begins
inline constexpr EventKind kSkinCutEnd{113};   ///< and has come out
inline constexpr EventKind kSkinPierced{114};  ///< a tool has broken through skin
inline constexpr EventKind kSkinEntered{115};  ///< a tool has gone in where skin was open
inline constexpr EventKind kSkinLeft{116};     ///< and is out again
/// So much of a torn ligament's stump is gone: {of this stump, of all together, %}. By whole
/// percents of the stump.
inline constexpr EventKind kSoftCleared{117};

/// Strands of a ligament are cut, or have torn: {what is left of them, %; force of the hand, N; its
/// tension, N}. As the first one goes, and with each tenth of them.
inline constexpr EventKind kSoftStrandsCut{123};
inline constexpr EventKind kSoftStrandsTorn{124};

inline constexpr EventKind kSoftPieceHeld{119};    ///< jaws or suction hold a piece of it
inline constexpr EventKind kSoftPieceLetGo{120};   ///< and have let go
inline constexpr EventKind kSoftPieceSucked{121};  ///< it went through a suction cannula
inline constexpr EventKind kSoftPieceOut{122};     ///< it is out of the patient

/// The subject is the portal: {from the place it was meant for, mm; 1: pierced, 0: cut; width of
/// the shaft that fits, mm}.
inline constexpr EventKind kPortalMade{118};

}  // namespace osteon
