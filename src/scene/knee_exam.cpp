#include "osteon/scene/knee_exam.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/hash.h"

namespace osteon {
namespace {

constexpr double kMostWay_m = 0.2, kMostTurn_rad = 2, kMostLoad = 1000;

// One list of a table's numbers for both directions.
template <class Table, class Visit>
void each_give_number(Table& table, const Visit& visit) {
  for (int i = 0; i < 3; ++i) visit(table.middle_T[i], kMostWay_m);
  visit(table.front_n, kMostLoad);
  visit(table.valgus_nm, kMostLoad);
  visit(table.internal_nm, kMostLoad);
  for (auto& test : table.gives)
    for (auto& curve : test)
      for (auto& give : curve) {
        for (int i = 0; i < 3; ++i) visit(give.way_B[i], kMostWay_m);
        for (int i = 0; i < 3; ++i) visit(give.turn_B[i], kMostTurn_rad);
        visit(give.front_m, kMostWay_m);
        visit(give.other_front_m, kMostWay_m);
      }
}

// A whole number up to `most`; `most` + 1: it is none.
std::uint32_t whole(double number, std::uint32_t most) {
  const bool good = number >= 0 && number <= most && number == std::floor(number);
  return good ? static_cast<std::uint32_t>(number) : most + 1;
}

KneeGive scaled(const KneeGive& a, double f) {
  return {f * a.way_B, f * a.turn_B, f * a.front_m, f * a.other_front_m};
}

KneeGive along(const KneeGiveTable::Curve& curve, double share) {
  const double place = std::clamp(share, 0.0, 1.0) * KneeGiveTable::kShares;
  const auto above =
      std::min<std::size_t>(static_cast<std::size_t>(place), KneeGiveTable::kShares - 1);
  const KneeGive below = above == 0 ? KneeGive{} : curve[above - 1];
  const double f = place - static_cast<double>(above);
  return sum_of(scaled(below, 1 - f), scaled(curve[above], f));
}

}  // namespace

KneeGive sum_of(const KneeGive& a, const KneeGive& b) {
  return {a.way_B + b.way_B, a.turn_B + b.turn_B, a.front_m + b.front_m,
          a.other_front_m + b.other_front_m};
}

std::vector<double> give_numbers(const KneeGiveTable& table) {
  std::vector<double> out{static_cast<double>(table.knee), static_cast<double>(table.tibia),
                          static_cast<double>(table.fibula)};
  each_give_number(table, [&](double value, double) { out.push_back(value); });
  return out;
}

std::optional<KneeGiveTable> give_of_numbers(const Case& the_case,
                                             std::span<const double> numbers) {
  if (numbers.size() != kKneeGiveNumbers || the_case.bones.empty()) return std::nullopt;
  const auto last = static_cast<std::uint32_t>(the_case.bones.size() - 1);
  KneeGiveTable table;
  table.knee = whole(numbers[0], kMostKneeState);
  table.tibia = whole(numbers[1], last);
  table.fibula = whole(numbers[2], last);
  if (table.knee > kMostKneeState || table.tibia > last || table.fibula > last) return std::nullopt;
  std::size_t at = 3;
  bool good = true;
  each_give_number(table, [&](double& value, double most) {
    value = numbers[at++];
    good = good && std::abs(value) <= most;  // false of a NaN
  });
  return good && table.front_n > 0 ? std::optional(table) : std::nullopt;
}

std::uint64_t give_digest(std::uint64_t before, double number) {
  Hasher hasher;
  hasher.add(before);
  hasher.add(number);
  return hasher.value();
}

std::uint64_t give_digest(std::span<const double> numbers) {
  std::uint64_t digest = 0;
  for (const double number : numbers) digest = give_digest(digest, number);
  return digest;
}

std::optional<KneeGive> give_at(const KneeGiveTable& table, KneeTest test, double bend_deg,
                                double share) {
  if (!(bend_deg <= KneeGiveTable::kMost_deg) || !std::isfinite(share)) return std::nullopt;
  const auto& curves = table.gives[static_cast<std::size_t>(test)];
  const double place = std::max(0.0, bend_deg / KneeGiveTable::kBend_deg);
  const auto first =
      std::min<std::size_t>(static_cast<std::size_t>(place), KneeGiveTable::kBends - 2);
  const double f = place - static_cast<double>(first);
  return sum_of(scaled(along(curves[first], share), 1 - f),
                scaled(along(curves[first + 1], share), f));
}

bool is_loaded(const KneeExamState& exam) {
  return std::any_of(exam.now.begin(), exam.now.end(), [](double share) { return share > 0; });
}

bool is_wanted(const KneeExamState& exam) {
  return std::any_of(exam.wanted.begin(), exam.wanted.end(),
                     [](double share) { return share > 0; });
}

KneeExamState let_go(const KneeExamState& exam) {
  KneeExamState out = exam;
  out.wanted = {};
  return out;
}

Pose given_pose(const KneeGive& give, const Vec3& middle_B, const Pose& X_BT) {
  const double angle = give.turn_B.norm();
  Quat turn(1, 0, 0, 0);
  if (angle > 0) turn = Eigen::AngleAxisd(angle, give.turn_B / angle);
  return {middle_B + give.way_B + turn * Vec3(X_BT.p - middle_B), (turn * X_BT.q).normalized()};
}

}  // namespace osteon
