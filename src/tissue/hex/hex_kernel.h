#pragma once

// The work on rows of cubes. Three files compile the same loops for registers of different width;
// so this header includes nothing that the linker could share between them.

namespace osteon::hex {

inline constexpr int kRegister = 8;  // doubles in the widest register: rows are padded to it
inline constexpr int kOutputs = 24;  // 3 axes x 4 rows of nodes x both ends of each cube

struct RowConstants {
  double per_edge;   // 1 / (4 h): corner sums to gradients
  double face;       // h^2 / 4: stress to corner forces
  double shear_pa;   // mu
  double bulk_pa;    // K
  double hourglass;  // N/m: corner sums to corner forces
};

/// A row of cubes between four rows of nodes: 0, +row, +layer, +row+layer.
struct Row {
  const double* moved[3][4];  // m, by axis
  double* force[3][4];        // N, by axis: added to
  const double* fill;         // 0 to 1, of each cube
  double* lowest_j;           // of each place in a row: lowered
  double* work;               // kOutputs x count
  long count;                 // cubes, a whole number of registers
};

using RowWork = void (*)(const RowConstants&, const Row&);

void row_forces_base(const RowConstants& constants, const Row& row);
void row_forces_avx2(const RowConstants& constants, const Row& row);
void row_forces_avx512(const RowConstants& constants, const Row& row);

/// The widest that this computer runs; all give the same bits.
RowWork best_row_work();

}  // namespace osteon::hex
