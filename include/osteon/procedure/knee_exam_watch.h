#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "osteon/scene/event.h"
#include "osteon/scene/knee_exam.h"
#include "osteon/scene/state.h"

namespace osteon {

// Made by who watches a knee being examined; the session makes none of these.
/// A test of the knee by hand was done: {0: Lachman, 1: pivot shift; 0: as it was found, 1: with a
/// fixed graft; side difference mm as it was done}.
inline constexpr EventKind kKneeExamined{469};

/// A knee that was being bent stands still: {degrees; 0; 0}.
inline constexpr EventKind kKneeBent{471};

/// What a test by hand found, where the tibia stood farthest ahead.
struct KneeTestFound {
  double flexion_deg = 0;
  double share = 0;  ///< of the full load
  double front_m = 0, other_front_m = 0;
  double side_difference_m() const { return front_m - other_front_m; }
};

/// What was found by hand of a knee, and of the same knee with a graft.
struct KneeExam {
  std::array<std::array<std::optional<KneeTestFound>, kKneeTests>, kMostKneeState + 1> found{};
  double front_n = 0, valgus_nm = 0, internal_nm = 0;  ///< full loads
  bool any() const;
};

/// Follows a knee that is examined by what snapshots say. A Lachman is done when the tibia was
/// pulled with nine tenths of the full load or more while the knee was bent to 20 to 40 degrees; a
/// pivot shift when its load stayed on while the knee was bent from 15 degrees or less to 30 or
/// more. Of a test that is done again the last one counts. A function of the snapshots: a replay
/// finds the same. The hand of an event is the first.
class KneeExamWatch {
 public:
  void add(std::uint64_t tick, const BoneSnapshot& bones, std::vector<Event>& out);
  const KneeExam& exam() const { return exam_; }

 private:
  /// A test that goes on.
  struct Course {
    bool begun = false, done = false;
    KneeTestFound farthest;
  };
  void follow_bend(std::uint64_t tick, const BoneSnapshot& bones, std::vector<Event>& out);
  void follow(std::uint64_t tick, KneeTest test, const BoneSnapshot& bones,
              std::vector<Event>& out);

  KneeExam exam_;
  std::array<Course, kKneeTests> courses_{};
  std::uint32_t epoch_ = 0;
  std::optional<double> stands_deg_;  ///< where the knee stood still last; none: it is being bent
};

}  // namespace osteon
