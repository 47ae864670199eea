#include "osteon/scene/event.h"

#include <algorithm>

#include "osteon/scene/carve_events.h"
#include "osteon/scene/soft_events.h"

namespace osteon {
namespace {

using K = EventKind;
using S = SubjectKind;

constexpr std::array kRows = {
    EventKindRow{K::kContactBegin, "contact_begin", "touches", S::kBone, {"force_n", "", ""}},
    EventKindRow{K::kContactEnd,
                 "contact_end",
                 "leaves",
                 S::kBone,
                 {"duration_s", "peak_force_n", "deepest_mm"}},
    EventKindRow{
        K::kForceOver, "force_over", "presses too hard on", S::kBone, {"force_n", "limit_n", ""}},
    EventKindRow{K::kForceUnder,
                 "force_under",
                 "presses less on",
                 S::kBone,
                 {"force_n", "limit_n", "duration_s"}},
    EventKindRow{K::kStructureSeen, "structure_seen", "sees", S::kBone, {"distance_mm", "", ""}},
    EventKindRow{K::kStructureEntered, "structure_entered", "enters", S::kSoftPart, {"", "", ""}},
    EventKindRow{K::kStructureLeft,
                 "structure_left",
                 "is out of",
                 S::kSoftPart,
                 {"duration_s", "deepest_mm", ""}},
    EventKindRow{
        K::kInstrumentTaken, "instrument_taken", "takes", S::kInstrument, {"size", "", ""}},
    EventKindRow{
        K::kPowered, "powered", "sets the power of", S::kInstrument, {"power", "intensity", ""}},
    EventKindRow{
        K::kPortalEntered, "portal_entered", "goes through", S::kPortal, {"depth_mm", "", ""}},
    EventKindRow{K::kPortalLeft, "portal_left", "is out of", S::kPortal, {"", "", ""}},
    EventKindRow{K::kMark, "mark", "restore point", S::kMark, {"", "", ""}},
    EventKindRow{K::kRestored, "restored", "back to restore point", S::kMark, {"", "", ""}},
    EventKindRow{K::kFault, "fault", "force off", S::kDevice, {"", "", ""}},
    EventKindRow{kSoftBegin, "soft_begin", "pushes", S::kSoftPart, {"tension_n", "", ""}},
    EventKindRow{kSoftEnd,
                 "soft_end",
                 "releases",
                 S::kSoftPart,
                 {"duration_s", "peak_force_n", "deepest_mm"}},
    EventKindRow{
        kSoftOver, "soft_over", "pulls too hard on", S::kSoftPart, {"force_n", "limit_n", ""}},
    EventKindRow{kSoftTorn, "soft_torn", "tears", S::kSoftPart, {"tension_n", "force_n", ""}},
    EventKindRow{kSoftLost, "soft_lost", "can no longer feel", S::kSoftPart, {"", "", ""}},
    EventKindRow{
        kSoftCut, "soft_cut", "cuts", S::kSoftPart, {"force_n", "tension_n", "removed_mm3"}},
    EventKindRow{
        kSoftPiece, "soft_piece", "takes a piece off", S::kSoftPart, {"volume_mm3", "", ""}},
    EventKindRow{kSoftHeld, "soft_held", "holds", S::kSoftPart, {"holds_n", "", ""}},
    EventKindRow{kSoftFreed,
                 "soft_freed",
                 "lets go of",
                 S::kSoftPart,
                 {"duration_s", "peak_force_n", "pulled_mm"}},
    EventKindRow{kSoftSlipped,
                 "soft_slipped",
                 "is pulled off",
                 S::kSoftPart,
                 {"force_n", "holds_n", "pulled_mm"}},
    EventKindRow{kSkinCut, "skin_cut", "cuts", S::kSoftPart, {"force_n", "depth_mm", ""}},
    EventKindRow{kSkinCutEnd,
                 "skin_cut_end",
                 "has cut",
                 S::kSoftPart,
                 {"length_mm", "depth_mm", "duration_s"}},
    EventKindRow{
        kSkinPierced, "skin_pierced", "pierces", S::kSoftPart, {"force_n", "depth_mm", "hole_mm"}},
    EventKindRow{kSkinEntered,
                 "skin_entered",
                 "goes in where it is open:",
                 S::kSoftPart,
                 {"slit_mm", "", ""}},
    EventKindRow{kSkinLeft,
                 "skin_left",
                 "is drawn out of",
                 S::kSoftPart,
                 {"duration_s", "deepest_mm", "pull_n"}},
    EventKindRow{
        kSoftCleared, "soft_cleared", "clears", S::kSoftPart, {"percent", "all_percent", ""}},
    EventKindRow{
        kPortalMade, "portal_made", "makes", S::kPortal, {"off_mm", "pierced", "across_mm"}},
    EventKindRow{kSoftPieceHeld,
                 "soft_piece_held",
                 "holds a piece of",
                 S::kSoftPart,
                 {"volume_mm3", "", ""}},
    EventKindRow{kSoftPieceLetGo,
                 "soft_piece_let_go",
                 "lets go a piece of",
                 S::kSoftPart,
                 {"volume_mm3", "", ""}},
    EventKindRow{kSoftPieceSucked,
                 "soft_piece_sucked",
                 "sucks away a piece of",
                 S::kSoftPart,
                 {"volume_mm3", "", ""}},
    EventKindRow{kSoftPieceOut,
                 "soft_piece_out",
                 "is rid of a piece of",
                 S::kSoftPart,
                 {"volume_mm3", "", ""}},
    EventKindRow{kSoftStrandsCut,
                 "soft_strands_cut",
                 "cuts strands of",
                 S::kSoftPart,
                 {"left_percent", "force_n", "tension_n"}},
    EventKindRow{kSoftStrandsTorn,
                 "soft_strands_torn",
                 "tears strands of",
                 S::kSoftPart,
                 {"left_percent", "force_n", "tension_n"}},
    EventKindRow{
        kCutBegin, "cut_begin", "begins to cut", S::kBone, {"diameter_mm", "thrust_n", ""}},
    EventKindRow{kCutEnd,
                 "cut_end",
                 "stops cutting",
                 S::kBone,
                 {"depth_mm", "duration_s", "most_torque_nmm"}},
    EventKindRow{kCortexEntered,
                 "cortex_entered",
                 "drills into the cortex of",
                 S::kBone,
                 {"depth_mm", "thrust_n", ""}},
    EventKindRow{kCancellousEntered,
                 "cancellous_entered",
                 "drills into the cancellous bone of",
                 S::kBone,
                 {"depth_mm", "thrust_n", ""}},
    EventKindRow{kBreached, "breached", "comes out of", S::kBone, {"depth_mm", "thrust_n", ""}},
    EventKindRow{kPlunge, "plunge", "plunges beyond", S::kBone, {"plunge_mm", "", ""}},
    EventKindRow{kSkives, "skives", "slides off", S::kBone, {"angle_deg", "thrust_n", ""}},
    EventKindRow{kPieceOff, "piece_off", "cuts a piece off", S::kBone, {"volume_mm3", "", ""}},
    EventKindRow{kCarvingFull, "carving_full", "can no longer cut", S::kBone, {"", "", ""}},
    EventKindRow{
        kPinLeft, "pin_left", "leaves a pin in", S::kBone, {"depth_mm", "diameter_mm", ""}},
    EventKindRow{kPinTaken, "pin_taken", "removes a pin from", S::kBone, {"", "", ""}},
    EventKindRow{kAimed, "aimed", "fixes a line into", S::kBone, {"", "", ""}},
    EventKindRow{kLed, "led", "is guided to", S::kBone, {"", "", ""}},
    EventKindRow{kCartilageEntered,
                 "cartilage_entered",
                 "cuts into the cartilage of",
                 S::kBone,
                 {"depth_mm", "thrust_n", ""}},
    EventKindRow{kPieceHeld, "piece_held", "holds a piece of", S::kBone, {"volume_mm3", "", ""}},
    EventKindRow{
        kPieceLetGo, "piece_let_go", "lets go a piece of", S::kBone, {"volume_mm3", "", ""}},
    EventKindRow{
        kPieceSucked, "piece_sucked", "sucks away a piece of", S::kBone, {"volume_mm3", "", ""}},
    EventKindRow{
        kPieceOut, "piece_out", "has lost sight of a piece of", S::kBone, {"volume_mm3", "", ""}},
    EventKindRow{
        kChatter, "chatter", "chatters in", S::kBone, {"amplitude_mm", "frequency_hz", ""}},
    EventKindRow{
        kChatterEnd, "chatter_end", "no longer chatters in", S::kBone, {"duration_s", "", ""}},
    EventKindRow{K::kScratch,
                 "scratch",
                 "slides under force on",
                 S::kBone,
                 {"slide_mm", "force_n", "duration_s"}},
    EventKindRow{K::kImpact, "impact", "strikes", S::kBone, {"speed_mm_s", "", ""}},
};

}  // namespace

std::span<const EventKindRow> event_table() { return kRows; }

const EventKindRow* find_event_kind(EventKind kind) {
  const auto found = std::find_if(kRows.begin(), kRows.end(),
                                  [kind](const EventKindRow& row) { return row.kind == kind; });
  return found == kRows.end() ? nullptr : &*found;
}

const EventKindRow* find_event_kind(std::string_view name) {
  const auto found = std::find_if(kRows.begin(), kRows.end(),
                                  [name](const EventKindRow& row) { return row.name == name; });
  return found == kRows.end() ? nullptr : &*found;
}

}  // namespace osteon
