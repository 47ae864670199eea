#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "osteon/collide/primitive_contact.h"
#include "rigid_motion.h"

namespace osteon {

/// What fields said last: a tick asks for the same pair at the same pose again, where its way ended
/// and where the next tick begins. An answer of here has the bits that asking anew would have.
class MetBefore {
 public:
  static constexpr std::uint32_t kNoPair = 0xffffffffu;
  struct Question {
    std::uint32_t pair = kNoPair;  ///< none: nothing was asked
    std::uint64_t cuts = 0;        ///< what the bone has lost, by a number of its own
    Pose X_BT;
    double far_m = 0;  ///< of a wider gap a bound may be told
    double low_m = 0;  ///< and of a narrower one
  };
  struct Answer {
    PrimitiveContact contact;
    std::uint32_t looks = 0;  ///< at carved bone, that asking took
    LowPlaces places = {};    ///< of a box; what looked about them is right in this tick alone
  };

  /// The next answer of each pair is kept until another tick's first: an instrument that is held
  /// fast begins each tick at one pose, whatever the tick tries from there.
  void begin_tick() { ++tick_; }

  /// Null: not kept.
  const Answer* find(const Question& question) {
    OfPair& of = kept_[question.pair % kPairs];
    for (Kept* kept : {&of.newer, &of.older, &of.first}) {
      if (!answers(*kept, question)) continue;
      if (kept->answer.places.looked_about && kept->tick != tick_) continue;
      if (of.tick != tick_) keep_as_first(*kept, of);
      return &kept->answer;
    }
    return nullptr;
  }
  void keep(const Question& question, const Answer& answer) {
    OfPair& of = kept_[question.pair % kPairs];
    of.older = of.newer;
    of.newer = {question, answer, tick_};
    if (of.tick != tick_) keep_as_first(of.newer, of);
  }

 private:
  static constexpr std::uint32_t kPairs = 16;  ///< of a tool beside the bones near it
  struct Kept {
    Question question;
    Answer answer;
    std::uint64_t tick = 0;
  };
  struct OfPair {
    Kept newer, older, first;
    std::uint64_t tick = 0;  ///< of `first`
  };
  void keep_as_first(const Kept& kept, OfPair& of) const {
    if (&kept != &of.first) of.first = kept;
    of.tick = tick_;
  }
  // A gap above both lower limits was found in full, whichever of them was asked with.
  static bool answers(const Kept& kept, const Question& b) {
    const Question& a = kept.question;
    if (a.pair == kNoPair || a.pair != b.pair || a.cuts != b.cuts || a.far_m != b.far_m)
      return false;
    if (!same_pose(a.X_BT, b.X_BT)) return false;
    return a.low_m == b.low_m || kept.answer.contact.gap >= std::max(a.low_m, b.low_m);
  }

  std::array<OfPair, kPairs> kept_;
  std::uint64_t tick_ = 0;
};

}  // namespace osteon
