#pragma once

// The numbers of a rod's step, as rows with one place for each segment or node, and the work on
// them. Three files compile the same loops for registers of different width; so this header
// includes nothing that the linker could share between them.

namespace osteon::rods {

/// First row of each kind. Of a matrix the rows are its elements, row by row; of a symmetric one
/// those of the lower half: 00, 10, 11, 20, 21, 22.
enum RodRow : long {
  kPlace = 0,        ///< of nodes, m
  kFrame = 3,        ///< of segments: x, y, z, w
  kAimPlace = 7,     ///< where they would go without forces
  kAimFrame = 10,    //
  kStartPlace = 14,  ///< where they were
  kStartFrame = 17,  //
  kForce = 21,       ///< from outside, on nodes, N
  kLength = 24,      ///< of segments at rest, m
  kPerLength = 25,   //
  kInertia = 26,     ///< of segments across, kg m^2; half of that along
  kMass = 27,        ///< of nodes, kg
  kPerSpan = 28,     ///< of inner nodes, 1/m; node i + 1 between segments i and i + 1 is at i
  kRestTurn = 29,    ///< of inner nodes
  kSlope = 32,       ///< of the potential: by the node's place, then by the segment's turn
  kWay = 38,         ///< to go: places, turns
  kPush = 44,        ///< of segment i on node i + 1; the opposite on node i
  kMoment = 47,      ///< of inner node i on segment i + 1
  kPushed = 50,      ///< symmetric: stiffness that a segment gives both its nodes
  kTurned = 56,      ///< symmetric: stiffness that inner node i gives segment i + 1
  kNodeBlock = 62,   ///< symmetric: of the matrix, nodes
  kTurnBlock = 68,   ///< symmetric: segments
  kTurnNode = 74,    ///< rows of segment i, columns of node i
  kNodeTurn = 83,    ///< rows of node i + 1, columns of segment i
  kNodeNode = 92,    ///< rows of node i + 1, columns of node i
  kTurnTurn = 101,   ///< rows of segment i + 1, columns of segment i
  kTriedPlace = 110,
  kTriedFrame = 113,
  kRodRows = 117
};

inline constexpr long kRowGuard = 8;  // zeros before a row, and after its last node

struct RodRows {
  double* values;  ///< place 0 of row 0
  long stride;     ///< between rows
  long segments;
  double* row(long k) const { return values + k * stride; }
};

/// What is the same all along the rod.
struct RodNumbers {
  double shear_n, stretch_n, bend_n_m2, twist_n_m2;
  double per_step2;        ///< 1 / step^2
  double damped_per_step;  ///< damping / step
};

/// Doubles that the factors of a rod's matrix take.
inline constexpr long kPairFactors = 24, kMiddleFactors = 81;

struct RodWork {
  /// Slope of elastic energy, inertia, damping and outer forces at kPlace and kFrame, of the places
  /// `first` to before `last` (whole registers: multiples of kRowGuard); with its stiffness, of
  /// which only what is never negative is kept (see stretch() in rod_row_lanes.h).
  void (*assemble)(const RodNumbers&, const RodRows&, bool with_stiffness, long first, long last);
  /// Factors the matrix: room for (segments - 1) x 2 x kPairFactors + kMiddleFactors.
  void (*factor)(const RodRows&, double* factors);
  /// Solves in place; `values`: kWay's rows or the like, six of them, `work`: 6 doubles a segment.
  void (*solve)(const RodRows&, const double* factors, double* values, double* work);
  /// Goes `share` of the way from these rows: writes places and frames into `to`, seven rows.
  void (*go)(const RodRows&, double share, double* to);
  /// The square of the largest way: of a node over the radius, of a segment in radians.
  double (*largest)(const RodRows&, double per_radius);
};

/// The widest that this computer runs; all give the same bits.
const RodWork& best_rod_work();
extern const RodWork kRodWorkBase, kRodWorkAvx2, kRodWorkAvx512;

}  // namespace osteon::rods
