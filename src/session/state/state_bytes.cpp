#include "state/fields.h"

namespace osteon {
namespace stored {

constexpr std::uint64_t kSights = 23;  // the version that says what a scope has seen

// Which bones, bit by bit, and the ticks of those.
template <class A>
void seen_field(A& a, std::array<std::uint64_t, kMaxBones>& seen) {
  static_assert(kMaxBones <= 64);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (seen[i] != 0) bits |= std::uint64_t{1} << i;
  field(a, bits);
  for (std::size_t i = 0; i < seen.size(); ++i)
    if ((bits >> i & 1u) != 0) field(a, seen[i]);
}

template <class A>
void field(A& a, WatchState& w) {
  field(a, w.touched);
  for (std::size_t i = 0; i < w.touches.size(); ++i) {
    if ((w.touched >> i & 1u) == 0) continue;
    Touch& touch = w.touches[i];
    field(a, touch.first_tick);
    field(a, touch.last_tick);
    field(a, touch.peak_force_n);
    field(a, touch.deepest_m);
  }
  field(a, w.over_since);
  field(a, w.over_bone);
  if (since(a, kSights)) seen_field(a, w.seen);
  field(a, w.inside);
}

template <class A>
void field(A& a, HandMark& m) {
  field(a, m.set);
  if (!m.set) return;
  field(a, m.instrument);
  field(a, m.power);
  field(a, m.jaw);
}

template <class A>
void field(A& a, HandState& h) {
  field(a, h.haptic);
  field(a, h.params);
  field(a, h.bone_step);
  field(a, h.first_tick);
  field(a, h.before);
  for (OtherTool& other : h.seen) field(a, other);
  field(a, h.watch);
  for (HandMark& mark : h.marks) field(a, mark);
}

// A restore point knows the same of the knee as the world, mostly.
template <class A>
void knee_field(A& a, const ToldKnee& of_world, ToldKnee& told) {
  bool same = told == of_world || (told && of_world && *told == *of_world);
  field(a, same);
  if (same)
    told = of_world;
  else
    field(a, told);
}

template <class A>
void field(A& a, WorldState& w) {
  field(a, w.bones);
  field(a, w.hold);
  field(a, w.carved);
  field(a, w.softs);
  field(a, w.rings);
  if (w.bones.exam.told > 0) field(a, w.knee);
  for (WorldMark& mark : w.marks) {
    field(a, mark.set);
    if (!mark.set) continue;
    field(a, mark.hold);
    field(a, mark.bones);
    field(a, mark.carved);
    field(a, mark.softs);
    field(a, mark.rings);
    if (mark.bones.exam.told > 0) knee_field(a, w.knee, mark.knee);
  }
}

template <class A>
void field(A& a, SessionState& s) {
  std::uint64_t version = kVersion;
  field(a, version);
  if (version < 1 || version > kVersion) a.ok = false;
  if constexpr (A::kReads) a.version = version;
  std::uint64_t hands = s.hands.size();
  number(a, hands, kMaxHands);
  if constexpr (A::kReads) s.hands.resize(hands);
  for (HandState& hand : s.hands) field(a, hand);
  field(a, s.world);
  auto kind = static_cast<std::uint32_t>(s.for_next_step.kind);
  number(a, kind, static_cast<std::uint32_t>(kLastCommandKind));
  s.for_next_step.kind = static_cast<CommandKind>(kind);
  field(a, s.for_next_step.value);
}

}  // namespace stored

std::string to_bytes(const SessionState& state) {
  SessionState copy = state;
  stored::Out out;
  field(out, copy);
  return std::move(out.bytes);
}

Result<SessionState> state_from_bytes(std::string_view bytes) {
  stored::In in{bytes};
  SessionState state;
  field(in, state);
  if (!in.ok || in.at != bytes.size())
    return fail("a stored state is damaged", "state", "Use another copy of the file");
  return state;
}

}  // namespace osteon
