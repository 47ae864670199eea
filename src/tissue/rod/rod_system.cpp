#include "rod/rod_system.h"

#include <algorithm>
#include <cmath>

namespace osteon::rods {
namespace {

constexpr std::size_t lower_at(std::size_t r, std::size_t c) {
  return r >= c ? r * (r + 1) / 2 + c : c * (c + 1) / 2 + r;
}

}  // namespace

RodSystem::RodSystem(const Rod& rod, const std::vector<double>& spans,
                     const std::vector<double>& inertia)
    : work_(&best_rod_work()) {
  const std::size_t places = rod.segments();
  rows_.segments = static_cast<long>(places);
  rows_.stride = 2 * kRowGuard + (rows_.segments + kRowGuard) / kRowGuard * kRowGuard;
  values_.assign(static_cast<std::size_t>(kRodRows * rows_.stride + kRowGuard), 0.0);
  rows_.values = values_.data() + kRowGuard;
  factors_.assign(2 * kPairFactors * (places - 1) + kMiddleFactors, 0.0);
  scratch_.assign(6 * places, 0.0);
  for (std::size_t i = 0; i < places; ++i) {
    at(kLength, i) = rod.length_m[i];
    at(kPerLength, i) = 1 / rod.length_m[i];
    at(kInertia, i) = inertia[i];
  }
  for (std::size_t i = 0; i < spans.size(); ++i) {
    at(kPerSpan, i) = 1 / spans[i];
    set_three(kRestTurn, i, rod.rest_turn[i]);
  }
  for (std::size_t i = 0; i <= places; ++i) at(kMass, i) = rod.mass_kg[i];
  for (const long w : {kFrame + 3L, kAimFrame + 3L, kStartFrame + 3L, kTriedFrame + 3L})
    std::fill_n(rows_.row(w), rows_.stride - kRowGuard, 1.0);
}

void RodSystem::set_three(long row, std::size_t i, const Vec3& v) {
  at(row, i) = v.x();
  at(row + 1, i) = v.y();
  at(row + 2, i) = v.z();
}

Quat RodSystem::quat(long row, std::size_t i) const {
  return {at(row + 3, i), at(row, i), at(row + 1, i), at(row + 2, i)};
}

void RodSystem::set_quat(long row, std::size_t i, const Quat& q) {
  set_three(row, i, q.vec());
  at(row + 3, i) = q.w();
}

RodPose RodSystem::pose(long row) const {
  RodPose out;
  const auto places = static_cast<std::size_t>(rows_.segments);
  out.x.resize(places + 1);
  out.q.resize(places);
  for (std::size_t i = 0; i <= places; ++i) out.x[i] = three(row, i);
  for (std::size_t i = 0; i < places; ++i) out.q[i] = quat(row + 3, i);
  return out;
}

void RodSystem::copy_pose(long from, long to) {
  std::copy_n(rows_.row(from), 7 * rows_.stride - kRowGuard, rows_.row(to));
}

void RodSystem::assemble(const RodNumbers& numbers, bool with_stiffness) {
  work_->assemble(numbers, rows_, with_stiffness, 0, rows_.segments + 1);
}

void RodSystem::assemble_part(const RodNumbers& numbers, long first, long last) {
  work_->assemble(numbers, rows_, false, first, last);
}

void RodSystem::add_node_block(std::size_t i, const Mat3& m) {
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c <= r; ++c)
      at(kNodeBlock + static_cast<long>(lower_at(r, c)), i) +=
          m(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
}

void RodSystem::add_node_node(std::size_t i, const Mat3& m) {
  for (long r = 0; r < 3; ++r)
    for (long c = 0; c < 3; ++c) at(kNodeNode + 3 * r + c, i) += m(r, c);
}

// Rows and columns of an unknown: of its own block, of what its block knows before and after.
void RodSystem::hold(std::size_t i, std::size_t axis, bool node) {
  const auto p = static_cast<long>(axis);
  const long own = node ? kNodeBlock : kTurnBlock;
  for (std::size_t k = 0; k < 3; ++k)
    at(own + static_cast<long>(lower_at(axis, k)), i) = k == axis ? 1 : 0;
  for (long k = 0; k < 3; ++k) {
    const auto row = [&](long block, std::size_t place) { at(block + 3 * p + k, place) = 0; };
    const auto column = [&](long block, std::size_t place) { at(block + 3 * k + p, place) = 0; };
    if (node) {
      column(kTurnNode, i);
      column(kNodeNode, i);
      if (i > 0) row(kNodeTurn, i - 1);
      if (i > 0) row(kNodeNode, i - 1);
    } else {
      row(kTurnNode, i);
      column(kNodeTurn, i);
      column(kTurnTurn, i);
      if (i > 0) row(kTurnTurn, i - 1);
    }
  }
}

void RodSystem::hold_axis(std::size_t node, std::size_t axis) { hold(node, axis, true); }

void RodSystem::hold_frame(std::size_t segment) {
  for (std::size_t k = 0; k < 3; ++k) hold(segment, k, false);
}

void RodSystem::take_slope() {
  for (long k = 0; k < 6; ++k) {
    const double* from = rows_.row(kSlope + k);
    double* to = rows_.row(kWay + k);
    for (long i = 0; i <= rows_.segments; ++i) to[i] = -from[i];
  }
}

void RodSystem::factor() { work_->factor(rows_, factors_.data()); }

void RodSystem::solve(Values& values) {
  work_->solve(rows_, factors_.data(), values.data() + kRowGuard, scratch_.data());
}

void RodSystem::solve_way() {
  work_->solve(rows_, factors_.data(), rows_.row(kWay), scratch_.data());
}

void RodSystem::multiply(const Values& x, Values& out) const {
  out.assign(x.size(), 0.0);
  const auto segments = static_cast<std::size_t>(rows_.segments);
  const auto symmetric = [&](long block, long row, std::size_t i) {
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c)
        out[index(row + static_cast<long>(r), i)] +=
            at(block + static_cast<long>(lower_at(r, c)), i) *
            x[index(row + static_cast<long>(c), i)];
  };
  const auto across = [&](long block, long row, std::size_t i, long column, std::size_t j) {
    const std::size_t at_block = std::min(i, j);
    for (long r = 0; r < 3; ++r)
      for (long c = 0; c < 3; ++c) {
        const double k = at(block + 3 * r + c, at_block);
        out[index(row + r, i)] += k * x[index(column + c, j)];
        out[index(column + c, j)] += k * x[index(row + r, i)];
      }
  };
  for (std::size_t i = 0; i <= segments; ++i) symmetric(kNodeBlock, 0, i);
  for (std::size_t i = 0; i < segments; ++i) {
    symmetric(kTurnBlock, 3, i);
    across(kTurnNode, 3, i, 0, i);
    across(kNodeTurn, 0, i + 1, 3, i);
    across(kNodeNode, 0, i + 1, 0, i);
    if (i + 1 < segments) across(kTurnTurn, 3, i + 1, 3, i);
  }
}

RodSystem::Values RodSystem::values_of(long row) const {
  Values out(static_cast<std::size_t>(6 * rows_.stride + kRowGuard), 0.0);
  const auto places = static_cast<std::size_t>(rows_.segments);
  for (long k = 0; k < 6; ++k)
    std::copy_n(rows_.row(row + k), places + (k < 3 ? 1 : 0), out.data() + index(k, 0));
  return out;
}

void RodSystem::set_values(long row, const Values& values) {
  const auto places = static_cast<std::size_t>(rows_.segments);
  for (long k = 0; k < 6; ++k)
    std::copy_n(values.data() + index(k, 0), places + (k < 3 ? 1 : 0), rows_.row(row + k));
}

double RodSystem::dot(const Values& a, const Values& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void RodSystem::go(double share, long to) { work_->go(rows_, share, rows_.row(to)); }

double RodSystem::largest_way(double per_radius) const {
  return std::sqrt(work_->largest(rows_, per_radius));
}

}  // namespace osteon::rods
