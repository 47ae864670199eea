#include "osteon/procedure/knee_exam_watch.h"

#include <algorithm>

#include "watch/watch_event.h"

namespace osteon {
namespace {

constexpr double kFirm = 0.9;  // of the full load
constexpr double kLachmanFrom_deg = 20, kLachmanTo_deg = 40;
constexpr double kPivotFrom_deg = 15, kPivotTo_deg = 30;

}  // namespace

bool KneeExam::any() const {
  for (const auto& knee : found)
    if (std::any_of(knee.begin(), knee.end(), [](const auto& test) { return test.has_value(); }))
      return true;
  return false;
}

void KneeExamWatch::follow(std::uint64_t tick, KneeTest test, const BoneSnapshot& bones,
                           std::vector<Event>& out) {
  const auto i = static_cast<std::size_t>(test);
  const KneeExamState& exam = bones.exam;
  Course& course = courses_[i];
  const double bend = bones.bend.now_deg, share = exam.now[i];
  const bool lachman = test == KneeTest::kLachman;
  const bool in_range = !lachman || (bend >= kLachmanFrom_deg && bend <= kLachmanTo_deg);
  // The other load must be off: its way would be taken for this one's.
  if (!(share >= kFirm) || exam.now[1 - i] > 0 || !in_range) {
    course = {};
    return;
  }
  if (!course.begun && !lachman && bend > kPivotFrom_deg) return;
  if (!course.begun || exam.give.front_m > course.farthest.front_m)
    course.farthest = {bend, share, exam.give.front_m, exam.give.other_front_m};
  course.begun = true;
  if (!lachman && bend < kPivotTo_deg && !course.done) return;
  auto& found = exam_.found[exam.knee][i];
  if (!found || !course.done || course.farthest.front_m > found->front_m) found = course.farthest;
  if (course.done) return;
  course.done = true;
  out.push_back(event_of(
      tick, kKneeExamined,
      {static_cast<double>(i), static_cast<double>(exam.knee), 1e3 * found->side_difference_m()}));
}

void KneeExamWatch::follow_bend(std::uint64_t tick, const BoneSnapshot& bones,
                                std::vector<Event>& out) {
  if (!bones.bend.on) return;
  const bool stands = bones.bend.now_deg == bones.bend.wanted_deg;
  if (stands && stands_deg_ == bones.bend.now_deg) return;
  stands_deg_ = stands ? std::optional(bones.bend.now_deg) : std::nullopt;
  if (!stands) return;
  out.push_back(event_of(tick, kKneeBent, {bones.bend.now_deg, 0, 0}));
}

void KneeExamWatch::add(std::uint64_t tick, const BoneSnapshot& bones, std::vector<Event>& out) {
  if (bones.epoch != epoch_) {
    courses_ = {};
    stands_deg_.reset();
  }
  epoch_ = bones.epoch;
  follow_bend(tick, bones, out);
  if (!bones.exam.on || !bones.bend.on) return;
  exam_.front_n = bones.exam.front_n;
  exam_.valgus_nm = bones.exam.valgus_nm;
  exam_.internal_nm = bones.exam.internal_nm;
  for (const KneeTest test : {KneeTest::kLachman, KneeTest::kPivot}) follow(tick, test, bones, out);
}

}  // namespace osteon
