#pragma once

#include "osteon/scene/event.h"

namespace osteon {

/// Kinds of events of carving: the codes 200 to 299 of EventKind.
inline constexpr EventKind kCutBegin{200};           ///< a powered instrument begins to remove bone
inline constexpr EventKind kCutEnd{201};             ///< and has stopped
inline constexpr EventKind kCortexEntered{202};      ///< what cuts is in hard bone
inline constexpr EventKind kCancellousEntered{203};  ///< and in the soft bone behind it
inline constexpr EventKind kBreached{204};           ///< a drill's tip has come out of the bone
inline constexpr EventKind kPlunge{205};             ///< how far it went on then
inline constexpr EventKind kSkives{206};       ///< a drill's tip slides off: it stands too slanted
inline constexpr EventKind kPieceOff{207};     ///< a piece of bone hangs on nothing and falls off
inline constexpr EventKind kCarvingFull{208};  ///< no room is left for cuts: no more is removed
inline constexpr EventKind kPinLeft{209};      ///< a pin was let go: it stays in the bone
inline constexpr EventKind kPinTaken{210};     ///< and is taken out again
inline constexpr EventKind kAimed{211};        ///< an aimer was fixed: its sleeve fixes a line
inline constexpr EventKind kLed{212};          ///< an instrument runs along a pin or in a sleeve
inline constexpr EventKind kCartilageEntered{213};  ///< what cuts is in cartilage
inline constexpr EventKind kPieceHeld{214};         ///< jaws or suction hold a loose piece
inline constexpr EventKind kPieceLetGo{215};        ///< and let it go, or it slipped out
inline constexpr EventKind kPieceSucked{216};       ///< it went through a suction cannula
inline constexpr EventKind kPieceOut{217};          ///< it fell, or was let go, beyond all bones
inline constexpr EventKind kChatter{230};     ///< a reamer shakes, or shakes otherwise than before
inline constexpr EventKind kChatterEnd{231};  ///< and runs smoothly again

}  // namespace osteon
