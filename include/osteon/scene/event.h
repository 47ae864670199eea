#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include "osteon/base/types.h"

namespace osteon {

/// What happened. A code is permanent: files and reports keep it. Free ranges: 100 to 199 for
/// tissue, 200 to 299 for carving, 300 to 399 for pictures (X-ray, films), 400 to 499 for
/// procedures, 500 and above for what is not foreseen. event_table() says what each one's subject
/// and values are.
enum class EventKind : std::uint16_t {
  kNone = 0,
  kContactBegin = 1,
  kContactEnd = 2,
  kForceOver = 3,   ///< the force on the hand has gone over its limit
  kForceUnder = 4,  ///< and is back under it
  kStructureSeen = 10,
  kStructureEntered = 11,  ///< by the tip of the instrument; a soft part, or a bone
  kStructureLeft = 12,
  kInstrumentTaken = 20,
  kPowered = 21,  ///< power or intensity has changed
  kPortalEntered = 22,
  kPortalLeft = 23,
  kMark = 30,
  kRestored = 31,
  kFault = 40,     ///< a device's fault took the hand's force off
  kScratch = 400,  ///< the tool has slid over it under force
  kImpact = 401,   ///< how fast the hand came when the contact began
};

/// What an event's `subject` is an index of.
enum class SubjectKind : std::uint8_t {
  kNothing = 0,
  kBone = 1,        ///< in Case::bones
  kSoftPart = 2,    ///< in Case::softs
  kLandmark = 3,    ///< in Case::landmarks
  kInstrument = 4,  ///< in the session's tray of instruments
  kPortal = 5,      ///< in the session's portals
  kMark = 6,        ///< number of a restore point
  kDevice = 7,      ///< a reason of the safety gate (ForceOff)
  kHand = 8         ///< the other hand
};

inline constexpr std::uint8_t kNoHand = 0xff;
inline constexpr std::uint32_t kNoSubject = 0xffffffffu;

/// Something that happened in a session, for who judges, counts, sounds or draws. Of fixed size; a
/// function of (case, settings, inputs), so that a replay makes the same ones.
struct Event {
  std::uint64_t tick = 0;  ///< haptic tick of its hand; of an event of physics: of hand 0
  EventKind kind = EventKind::kNone;
  std::uint8_t hand = kNoHand;
  SubjectKind subject_kind = SubjectKind::kNothing;
  std::uint32_t subject = kNoSubject;
  Vec3 p_W = Vec3::Zero();         ///< where, m
  std::array<double, 3> values{};  ///< event_table() names them
  bool operator==(const Event&) const = default;
};
static_assert(std::is_trivially_destructible_v<Event>);

/// A kind in words.
struct EventKindRow {
  EventKind kind = EventKind::kNone;
  std::string_view name;  ///< "contact_begin": in files, reports and tables
  std::string_view text;  ///< "touches": subject follows
  SubjectKind subject_kind = SubjectKind::kNothing;
  std::array<std::string_view, 3> value_names;  ///< with the unit, "force_n"; empty: not used
};

/// All kinds in the order of their codes, kNone left out.
std::span<const EventKindRow> event_table();
/// Null: no such kind.
const EventKindRow* find_event_kind(EventKind kind);
const EventKindRow* find_event_kind(std::string_view name);

}  // namespace osteon
