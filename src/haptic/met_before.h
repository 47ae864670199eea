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
  };

  /// Null: not kept.
  const Answer* find(const Question& question) const {
    const Kept& newer = kept_[first(question.pair)];
    const Kept& older = kept_[first(question.pair) + 1];
    if (answers(newer, question)) return &newer.answer;
    return answers(older, question) ? &older.answer : nullptr;
  }
  void keep(const Question& question, const Answer& answer) {
    Kept& newer = kept_[first(question.pair)];
    kept_[first(question.pair) + 1] = newer;
    newer = {question, answer};
  }

 private:
  static constexpr std::uint32_t kPairs = 16;  ///< of a tool beside the bones near it
  struct Kept {
    Question question;
    Answer answer;
  };
  static std::size_t first(std::uint32_t pair) { return 2 * (pair % kPairs); }
  // A gap above both lower limits was found in full, whichever of them was asked with.
  static bool answers(const Kept& kept, const Question& b) {
    const Question& a = kept.question;
    if (a.pair == kNoPair || a.pair != b.pair || a.cuts != b.cuts || a.far_m != b.far_m)
      return false;
    if (!same_pose(a.X_BT, b.X_BT)) return false;
    return a.low_m == b.low_m || kept.answer.contact.gap >= std::max(a.low_m, b.low_m);
  }

  std::array<Kept, 2 * kPairs> kept_;
};

}  // namespace osteon
