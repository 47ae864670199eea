#pragma once

#include <cstddef>
#include <vector>

#include "rod/rod_elastic.h"
#include "rod/rod_rows.h"

namespace osteon::rods {

/// The equations of one round of Newton's method on a rod: slope, matrix and its factors, kept as
/// rows (rod_rows.h). Unknowns: places of nodes, and of segments a turn in their own frames.
class RodSystem {
 public:
  /// One number for each unknown; those beyond the rod's end are zero.
  using Values = std::vector<double>;

  /// `spans`: see spans(); `inertia`: of segments across, kg m^2.
  RodSystem(const Rod& rod, const std::vector<double>& spans, const std::vector<double>& inertia);

  RodSystem(const RodSystem&) = delete;
  RodSystem& operator=(const RodSystem&) = delete;

  const RodRows& rows() const { return rows_; }
  double& at(long row, std::size_t i) { return rows_.row(row)[i]; }
  double at(long row, std::size_t i) const { return rows_.row(row)[i]; }
  Vec3 three(long row, std::size_t i) const { return {at(row, i), at(row + 1, i), at(row + 2, i)}; }
  void set_three(long row, std::size_t i, const Vec3& v);
  void add_three(long row, std::size_t i, const Vec3& v) { set_three(row, i, three(row, i) + v); }
  Quat quat(long row, std::size_t i) const;
  void set_quat(long row, std::size_t i, const Quat& q);
  /// Places and frames of seven rows that begin at this one.
  RodPose pose(long row) const;
  void copy_pose(long from, long to);

  void assemble(const RodNumbers& numbers, bool with_stiffness);
  /// The slope alone, of a few places: multiples of kRowGuard.
  void assemble_part(const RodNumbers& numbers, long first, long last);
  /// Adds a symmetric block to a node's, or one of node i + 1's rows and node i's columns.
  void add_node_block(std::size_t i, const Mat3& m);
  void add_node_node(std::size_t i, const Mat3& m);
  /// Makes an axis of a node, or a segment's frame, stay where it is.
  void hold_axis(std::size_t node, std::size_t axis);
  void hold_frame(std::size_t segment);

  void take_slope();  ///< into kWay, with the other sign
  void factor();
  /// In place, by the factors.
  void solve(Values& values);
  void solve_way();  ///< kWay, in place
  void multiply(const Values& x, Values& out) const;
  /// Six rows that begin at this one.
  Values values_of(long row) const;
  void set_values(long row, const Values& values);
  static double dot(const Values& a, const Values& b);
  std::size_t index(long row, std::size_t i) const {
    return static_cast<std::size_t>(kRowGuard + row * rows_.stride) + i;
  }

  /// kPlace and kFrame moved by this share of kWay, written to seven rows.
  void go(double share, long to);
  double largest_way(double per_radius) const;

 private:
  void hold(std::size_t i, std::size_t axis, bool node);

  const RodWork* work_;
  RodRows rows_;
  std::vector<double> values_, factors_, scratch_;
};

}  // namespace osteon::rods
