#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/scene/case.h"

namespace osteon {

/// Tests of a knee by hand: a pull on the tibia to the front, and valgus with inward rotation.
enum class KneeTest : std::uint32_t { kLachman = 0, kPivot = 1 };
inline constexpr std::size_t kKneeTests = 2;
/// A knee that is examined is as it was found, or a fixed graft holds it.
inline constexpr std::uint32_t kMostKneeState = 1;

/// What the tibia does under a load, from where it rests without. The femur's frame B.
struct KneeGive {
  Vec3 way_B = Vec3::Zero();   ///< of the middle between the plateaus
  Vec3 turn_B = Vec3::Zero();  ///< axis times angle, rad
  double front_m = 0;          ///< forwards
  double other_front_m = 0;    ///< the same of the intact knee
};

/// Of two loads together.
KneeGive sum_of(const KneeGive& a, const KneeGive& b);

/// How a knee gives under both tests, by bend and load. Between the places it goes in a straight
/// line.
struct KneeGiveTable {
  /// Every 10 degrees from 0. Not farther: without its ligament the model of some knees gives way
  /// sideways under the pivot shift's load when they are bent to 50 degrees.
  static constexpr std::size_t kBends = 5;
  static constexpr double kBend_deg = 10;
  static constexpr std::size_t kShares = 4;  ///< of the full load: a quarter, to all of it
  static constexpr double kMost_deg = kBend_deg * (kBends - 1);

  std::uint32_t knee = 0;                 ///< 0: as it was found, 1: with a fixed graft
  std::uint32_t tibia = 0, fibula = 0;    ///< bones of the case that move; the same: it has none
  Vec3 middle_T = Vec3::Zero();           ///< between the plateaus, in the tibia's frame
  double front_n = 0;                     ///< full load of the one test
  double valgus_nm = 0, internal_nm = 0;  ///< and of the other
  using Curve = std::array<KneeGive, kShares>;
  std::array<std::array<Curve, kBends>, kKneeTests> gives{};
};

/// All of a table in a fixed order, so that it can be told number by number.
inline constexpr std::size_t kKneeGiveNumbers =
    9 + 8 * kKneeTests * KneeGiveTable::kBends * KneeGiveTable::kShares;
std::vector<double> give_numbers(const KneeGiveTable& table);
/// None: the count is another, a number is not finite or not possible, or the case has no such
/// bones.
std::optional<KneeGiveTable> give_of_numbers(const Case& the_case, std::span<const double> numbers);
/// Tells tables apart, a part of one too.
std::uint64_t give_digest(std::uint64_t before, double number);
std::uint64_t give_digest(std::span<const double> numbers);

/// `share`: of the full load, 0 to 1. None where the knee is bent more than the table says; one
/// that is stretched out more gives as at 0.
std::optional<KneeGive> give_at(const KneeGiveTable& table, KneeTest test, double bend_deg,
                                double share);

/// A knee under the hands of who examines it.
struct KneeExamState {
  bool on = false;           ///< it is known how it gives
  std::uint32_t knee = 0;    ///< as KneeGiveTable
  std::uint32_t told = 0;    ///< numbers of a table that have come; all of them once it is on
  std::uint64_t digest = 0;  ///< of those
  std::array<double, kKneeTests> wanted{}, now{};      ///< shares of the full loads
  double front_n = 0, valgus_nm = 0, internal_nm = 0;  ///< full loads
  KneeGive give;                                       ///< now; the sum of both tests
};
bool is_loaded(const KneeExamState& exam);
/// Whether hands want to load it.
bool is_wanted(const KneeExamState& exam);
/// The same knee, and the hands let go: its loads fade.
KneeExamState let_go(const KneeExamState& exam);

/// A bone of the lower leg in the femur's frame, which its bend alone would put at `X_BT`, with the
/// middle between the plateaus at `middle_B`, moved by what the knee gives.
Pose given_pose(const KneeGive& give, const Vec3& middle_B, const Pose& X_BT);

}  // namespace osteon
