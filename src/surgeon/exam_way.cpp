#include "acl_way.h"
#include "knee_orders.h"
#include "osteon/surgeon/exam_surgeon.h"

namespace osteon {
namespace {

constexpr double kLachman_deg = 30, kLachmanPull_n = 134;
constexpr double kPivotFrom_deg = 5, kPivotStep_deg = 11, kPivotTo_deg = 38;

}  // namespace

KneeExamOrders plan_knee_exam(double begin_s, double from_deg, double to_deg) {
  KneeOrders knee(begin_s, from_deg);
  knee.bend(kLachman_deg);
  knee.load({CommandKind::kLachman, kLachmanPull_n});
  knee.load({CommandKind::kLachman, 0});
  knee.bend(kPivotFrom_deg);
  knee.load({CommandKind::kPivot, 1});
  for (double deg = kPivotFrom_deg + kPivotStep_deg; deg <= kPivotTo_deg; deg += kPivotStep_deg)
    knee.bend(deg);
  knee.load({CommandKind::kPivot, 0});
  knee.bend(to_deg);
  const double end_s = knee.now_s();
  return {knee.take(), end_s};
}

HandPart plan_exam_part(const std::string& held, const Pose& at, double from_deg, double to_deg) {
  constexpr double kBegin_s = 0.2;
  KneeExamOrders exam = plan_knee_exam(kBegin_s, from_deg, to_deg);
  AclWay way(held, 0, at, 1);
  way.stay(exam.end_s + 0.5);
  return {way.path(), std::move(exam.orders)};
}

}  // namespace osteon
