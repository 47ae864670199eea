// The depth programme of lp_contact.h by general solvers, in its dual, which has four rows:
// minimise d.y over the planes of both bodies, with sum n y = 0, sum y = 1, y >= 0. Each query
// starts from the basis of the last.
#include <glpk.h>

#include <ClpSimplex.hpp>
#include <array>
#include <limits>

#include "contact_scene.h"

namespace {

using namespace osteon::bench;
using osteon::ConvexBody;
using osteon::Pose;
using osteon::Vec3;

/// A plane n.x <= d as a column, lengths in millimetres.
struct Column {
  std::array<double, 4> rows;
  double cost;
};

Column column(const Vec3& n, double d) { return {{n.x(), n.y(), n.z(), 1}, 1e3 * d}; }

Column column(const ConvexBody& body, std::uint32_t i) {
  return column(Vec3(body.nx[i], body.ny[i], body.nz[i]), body.d[i]);
}

/// Of a plane of B, seen from A.
Column column(const ConvexBody& body, std::uint32_t i, const Pose& X) {
  const Vec3 n = X.q * Vec3(body.nx[i], body.ny[i], body.nz[i]);
  return column(n, body.d[i] + n.dot(X.p));
}

class Glpk {
 public:
  Glpk() : lp_(glp_create_prob()) {
    glp_term_out(GLP_OFF);
    glp_init_smcp(&options_);
    options_.msg_lev = GLP_MSG_OFF;
    glp_add_rows(lp_, 4);
    for (int row = 1; row <= 4; ++row) glp_set_row_bnds(lp_, row, GLP_FX, row == 4, row == 4);
    const ConvexBody& a = scene().bone_body;
    glp_add_cols(lp_, static_cast<int>(a.plane_count + scene().probe_body.plane_count));
    for (std::uint32_t i = 0; i < a.plane_count; ++i) set(static_cast<int>(i) + 1, column(a, i));
  }
  ~Glpk() { glp_delete_prob(lp_); }
  Glpk(const Glpk&) = delete;
  Glpk& operator=(const Glpk&) = delete;

  /// The optimum, mm.
  double depth(const Pose& X) {
    const ConvexBody& b = scene().probe_body;
    const int first = static_cast<int>(scene().bone_body.plane_count) + 1;
    for (std::uint32_t i = 0; i < b.plane_count; ++i)
      set(first + static_cast<int>(i), column(b, i, X));
    glp_simplex(lp_, &options_);
    return glp_get_obj_val(lp_);
  }

 private:
  void set(int place, const Column& c) {
    constexpr int kRows[] = {0, 1, 2, 3, 4};
    const double values[] = {0, c.rows[0], c.rows[1], c.rows[2], c.rows[3]};
    glp_set_mat_col(lp_, place, 4, kRows, values);
    glp_set_col_bnds(lp_, place, GLP_LO, 0, 0);
    glp_set_obj_coef(lp_, place, c.cost);
  }

  glp_prob* lp_;
  glp_smcp options_;
};

class Clp {
 public:
  Clp() {
    model_.setLogLevel(0);
    model_.resize(4, 0);
    for (int row = 0; row < 4; ++row) model_.setRowBounds(row, row == 3, row == 3);
    const ConvexBody& a = scene().bone_body;
    for (std::uint32_t i = 0; i < a.plane_count; ++i) add(column(a, i));
    for (std::uint32_t i = 0; i < scene().probe_body.plane_count; ++i)
      add(column(scene().probe_body, i));
  }

  double depth(const Pose& X) {
    const ConvexBody& b = scene().probe_body;
    for (std::uint32_t i = 0; i < b.plane_count; ++i) {
      const int place = static_cast<int>(scene().bone_body.plane_count + i);
      const Column c = column(b, i, X);
      for (int row = 0; row < 4; ++row)
        model_.modifyCoefficient(row, place, c.rows[static_cast<std::size_t>(row)], true);
      model_.setObjectiveCoefficient(place, c.cost);
    }
    model_.primal();
    return model_.objectiveValue();
  }

 private:
  void add(const Column& c) {
    constexpr int kRows[] = {0, 1, 2, 3};
    model_.addColumn(4, kRows, c.rows.data(), 0, std::numeric_limits<double>::infinity(), c.cost);
  }

  ClpSimplex model_;
};

// The dual's optimum is that of the primal with its sign turned: t = -min d.y.
template <class Solver>
void general_solver(benchmark::State& state) {
  Solver solver;
  along_path(state, [&](const Pose& X) { return -solver.depth(X) <= 0; });
}
void glpk_depth(benchmark::State& state) { general_solver<Glpk>(state); }
void clp_depth(benchmark::State& state) { general_solver<Clp>(state); }

BENCHMARK(glpk_depth);
BENCHMARK(clp_depth);

}  // namespace
