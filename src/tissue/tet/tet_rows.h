#pragma once

// The points of integration of tetrahedra as rows of numbers, and the work on them. Three files
// compile the same loops for registers of different width; so this header includes nothing that the
// linker could share between them.

namespace osteon::tets {

inline constexpr long kRegister = 8;  // doubles in the widest register: rows are padded to it

/// Points and what they know of their element's nodes (4, or 10 of a quadratic one). `stride`
/// apart: element k of a vector or matrix of a point, row by row.
struct TetRows {
  const unsigned* node;  ///< nodes x stride: of each point, its element's nodes
  const double* slope;   ///< nodes x 3 x stride: gradients of their shape functions, 1/m
  const double* volume;  ///< that the point stands for, m^3; 0 of padding
  double* turn;          ///< 9 x stride: rotation of the material
  double* force;         ///< nodes x 3 x stride: written
  long nodes, count, stride;
};

struct TetModuli {
  double mu, lambda, bulk;  ///< Pa
};

/// Rows of a factor L from their first entry to before the diagonal, which is one.
struct TetProfile {
  const unsigned *first, *start;  ///< of each row: its first column, where that stands
  const double* values;
  long size;
};

/// `v`: three numbers of each node.
struct TetWork {
  /// Writes the rotation nearest to F = 1 + grad v. Where F is nearly flat or inverted the rotation
  /// is zero instead, for others to find.
  void (*rotate)(const TetRows&, const double* v);
  /// Forces times `factor` of the corotated energy, on each point's nodes. With `turn` null the
  /// material does not turn.
  void (*elastic)(const TetRows&, const TetModuli&, const double* v, double factor);
  /// The same of its stiffness times v: the slope of minus the force.
  void (*stiffness)(const TetRows&, const TetModuli&, const double* v, double factor);
  /// Forces of the neo-Hookean energy.
  void (*neo_hookean)(const TetRows&, const TetModuli&, const double* v);
  /// Rotations nearest to matrices, 9 x stride, in place; zero as above.
  void (*nearest)(double* matrix, long count, long stride);
  /// x becomes L^-1 x, and L^-T x.
  void (*forward)(const TetProfile&, double* x);
  void (*back)(const TetProfile&, double* x);
};

/// The widest that this computer runs; all give the same bits.
const TetWork& best_tet_work();
extern const TetWork kTetWorkBase, kTetWorkAvx2, kTetWorkAvx512;

}  // namespace osteon::tets
