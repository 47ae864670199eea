#pragma once

#include <string>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/surgeon/scripted_hand.h"

namespace osteon {

/// What is asked for while a knee is examined by hand, and when it is over.
struct KneeExamOrders {
  std::vector<TimedCommand> orders;
  double end_s = 0;
};

/// A Lachman at 30 degrees and a pivot shift from 5 to 38 degrees, with the full load, from
/// `begin_s` on. The knee is bent to `from_deg` before, and to `to_deg` afterwards.
KneeExamOrders plan_knee_exam(double begin_s, double from_deg, double to_deg);

/// The same, while a hand with `held` stays where it is.
HandPart plan_exam_part(const std::string& held, const Pose& at, double from_deg, double to_deg);

}  // namespace osteon
