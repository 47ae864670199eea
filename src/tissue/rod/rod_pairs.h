#pragma once

// Direct solution of a rod's matrix (rod_rows.h), from both ends at once: a register holds a block
// of the one end and the mirrored block of the other.
//
// Blocks of three unknowns b = 0 .. 2 N: nodes and segments in turn. Each knows its next two. With
// D the block's own matrix, Y its six rows below, what earlier blocks left taken off:
//   M = Y D^-1;  the next two blocks lose M Y^T.
// Three blocks stay in the middle, factored as one (L D L^T, without pivots: it is positive).

#include "lanes.h"
#include "rod/rod_rows.h"

namespace osteon::rods {

typedef hex::Register<16>::Lanes Pair;

static inline int lower(int r, int c) { return r >= c ? r * (r + 1) / 2 + c : c * (c + 1) / 2 + r; }

static inline Pair both(double first, double second) { return Pair{first, second}; }

/// A block and its mirrored one: own matrix and the six rows below.
struct PairBlock {
  Pair own[6];
  Pair below[6][3];
};

static inline void load_pair(const RodRows& rows, long b, PairBlock& out) {
  const long n = rows.stride, i = b / 2, last = rows.segments;
  if (b % 2 == 0) {  // node i, and node N - i
    const double *own = rows.row(kNodeBlock) + i, *other = rows.row(kNodeBlock) + last - i;
    for (int m = 0; m < 6; ++m) out.own[m] = both(own[m * n], other[m * n]);
    const double *turn = rows.row(kTurnNode) + i, *turn_t = rows.row(kNodeTurn) + last - 1 - i;
    const double *node = rows.row(kNodeNode) + i, *node_t = rows.row(kNodeNode) + last - 1 - i;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        out.below[r][c] = both(turn[(3 * r + c) * n], turn_t[(3 * c + r) * n]);
        out.below[3 + r][c] = both(node[(3 * r + c) * n], node_t[(3 * c + r) * n]);
      }
    return;
  }
  // segment i, and segment N - 1 - i
  const double *own = rows.row(kTurnBlock) + i, *other = rows.row(kTurnBlock) + last - 1 - i;
  for (int m = 0; m < 6; ++m) out.own[m] = both(own[m * n], other[m * n]);
  const double *node = rows.row(kNodeTurn) + i, *node_t = rows.row(kTurnNode) + last - 1 - i;
  const double *turn = rows.row(kTurnTurn) + i, *turn_t = rows.row(kTurnTurn) + last - 2 - i;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      out.below[r][c] = both(node[(3 * r + c) * n], node_t[(3 * c + r) * n]);
      out.below[3 + r][c] = both(turn[(3 * r + c) * n], turn_t[(3 * c + r) * n]);
    }
}

/// Inverse of a symmetric matrix of three, by its cofactors.
static inline void invert(const Pair (&d)[6], Pair (&out)[6]) {
  const Pair c00 = d[2] * d[5] - d[4] * d[4], c10 = d[3] * d[4] - d[1] * d[5],
             c20 = d[1] * d[4] - d[3] * d[2];
  const Pair per = 1.0 / ((d[0] * c00 + d[1] * c10) + d[3] * c20);
  out[0] = per * c00;
  out[1] = per * c10;
  out[2] = per * (d[0] * d[5] - d[3] * d[3]);
  out[3] = per * c20;
  out[4] = per * (d[1] * d[3] - d[0] * d[4]);
  out[5] = per * (d[0] * d[2] - d[1] * d[1]);
}

/// What the blocks before took off: of the next block, between it and the one after, of that one.
struct PairTaken {
  Pair own[6], between[3][3], after[6];
};

static inline void eliminate(PairBlock& block, PairTaken& taken, double* factors) {
  for (int m = 0; m < 6; ++m) block.own[m] = block.own[m] - taken.own[m];
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) block.below[r][c] = block.below[r][c] - taken.between[r][c];
  Pair inverse[6], by[6][3];
  invert(block.own, inverse);
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 3; ++c)
      by[r][c] =
          (block.below[r][0] * inverse[lower(0, c)] + block.below[r][1] * inverse[lower(1, c)]) +
          block.below[r][2] * inverse[lower(2, c)];
  const auto product = [&](int r, int c) {
    return (by[r][0] * block.below[c][0] + by[r][1] * block.below[c][1]) +
           by[r][2] * block.below[c][2];
  };
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c <= r; ++c) {
      taken.own[lower(r, c)] = taken.after[lower(r, c)] + product(r, c);
      taken.after[lower(r, c)] = product(3 + r, 3 + c);
    }
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) taken.between[r][c] = product(3 + r, c);
  for (int m = 0; m < 6; ++m) hex::store(factors + 2 * m, inverse[m]);
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 3; ++c) hex::store(factors + 12 + 2 * (3 * r + c), by[r][c]);
}

/// The nine unknowns in the middle begin with block N - 1: the matrix there.
static inline void middle_matrix(const RodRows& rows, const PairTaken& taken, double (&a)[9][9]) {
  const long n = rows.stride, first = rows.segments - 1;
  const auto element = [&](long row, long at, int m) { return rows.row(row)[m * n + at]; };
  for (int k = 0; k < 3; ++k) {
    const long b = first + k, i = b / 2;
    const bool node = b % 2 == 0;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        if (c <= r)
          a[3 * k + r][3 * k + c] = element(node ? kNodeBlock : kTurnBlock, i, lower(r, c));
        if (k < 2)
          a[3 * k + 3 + r][3 * k + c] = element(node ? kTurnNode : kNodeTurn, i, 3 * r + c);
        if (k < 1) a[6 + r][c] = element(node ? kNodeNode : kTurnTurn, i, 3 * r + c);
      }
  }
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      a[3 + r][c] -= taken.between[r][c][0];
      a[6 + r][3 + c] -= taken.between[c][r][1];
      if (c > r) continue;
      a[r][c] -= taken.own[lower(r, c)][0];
      a[3 + r][3 + c] -= taken.after[lower(r, c)][0] + taken.after[lower(r, c)][1];
      a[6 + r][6 + c] -= taken.own[lower(r, c)][1];
    }
}

static inline void factor_pairs(const RodRows& rows, double* factors) {
  PairTaken taken;
  const Pair none = both(0, 0);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) taken.between[r][c] = none;
    for (int m = 0; m < 2; ++m) taken.own[2 * r + m] = taken.after[2 * r + m] = none;
  }
  PairBlock block;
  for (long b = 0; b < rows.segments - 1; ++b, factors += 2 * kPairFactors) {
    load_pair(rows, b, block);
    eliminate(block, taken, factors);
  }
  double a[9][9];
  middle_matrix(rows, taken, a);
  for (int j = 0; j < 9; ++j) {
    const double per = 1 / a[j][j];
    for (int i = j + 1; i < 9; ++i) {
      const double l = a[i][j] * per;
      for (int k = i; k < 9; ++k) a[k][i] -= l * a[k][j];
    }
    for (int i = j + 1; i < 9; ++i) a[i][j] *= per;
    a[j][j] = per;
  }
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j) factors[9 * i + j] = j <= i ? a[i][j] : 0.0;
}

static inline void solve_middle(const double* factors, double (&x)[9]) {
  for (int j = 0; j < 9; ++j)
    for (int i = j + 1; i < 9; ++i) x[i] -= factors[9 * i + j] * x[j];
  for (int j = 8; j >= 0; --j) {
    x[j] *= factors[9 * j + j];
    for (int i = j + 1; i < 9; ++i) x[j] -= factors[9 * i + j] * x[i];
  }
}

/// Where the values of a block and of its mirrored one stand, and how far apart their axes.
struct PairPlace {
  double *first, *second;
};
static inline PairPlace place_of(const RodRows& rows, double* values, long b) {
  const long i = b / 2, last = rows.segments;
  if (b % 2 == 0) return {values + i, values + last - i};
  double* turns = values + 3 * rows.stride;
  return {turns + i, turns + last - 1 - i};
}

static inline void solve_pairs(const RodRows& rows, const double* factors, double* values,
                               double* work) {
  const long n = rows.stride, pairs = rows.segments - 1;
  const Pair none = both(0, 0);
  Pair next[3] = {none, none, none}, after[3] = {none, none, none};
  for (long b = 0; b < pairs; ++b) {
    const double* f = factors + b * 2 * kPairFactors + 12;
    const PairPlace at = place_of(rows, values, b);
    Pair left[3];
    for (int k = 0; k < 3; ++k) {
      left[k] = both(at.first[k * n], at.second[k * n]) - next[k];
      hex::store(work + 6 * b + 2 * k, left[k]);
    }
    for (int k = 0; k < 3; ++k) {
      const auto row = [&](int r) {
        return (hex::load<Pair>(f + 2 * (3 * r)) * left[0] +
                hex::load<Pair>(f + 2 * (3 * r + 1)) * left[1]) +
               hex::load<Pair>(f + 2 * (3 * r + 2)) * left[2];
      };
      next[k] = after[k] + row(k);
      after[k] = row(3 + k);
    }
  }
  double x[9];
  const PairPlace low = place_of(rows, values, pairs), middle = place_of(rows, values, pairs + 1);
  for (int k = 0; k < 3; ++k) {
    x[k] = low.first[k * n] - next[k][0];
    x[3 + k] = middle.first[k * n] - (after[k][0] + after[k][1]);
    x[6 + k] = low.second[k * n] - next[k][1];
  }
  solve_middle(factors + pairs * 2 * kPairFactors, x);
  Pair one[3], two[3];  // solved: of the next block, and of the one after
  for (int k = 0; k < 3; ++k) {
    low.first[k * n] = x[k];
    middle.first[k * n] = x[3 + k];
    low.second[k * n] = x[6 + k];
    one[k] = both(x[k], x[6 + k]);
    two[k] = both(x[3 + k], x[3 + k]);
  }
  for (long b = pairs; b-- > 0;) {
    const double* d = factors + b * 2 * kPairFactors;
    const double* f = d + 12;
    Pair left[3], x_b[3];
    for (int k = 0; k < 3; ++k) left[k] = hex::load<Pair>(work + 6 * b + 2 * k);
    for (int k = 0; k < 3; ++k) {
      const auto inverse = [&](int c) { return hex::load<Pair>(d + 2 * lower(k, c)); };
      const auto by = [&](int r) { return hex::load<Pair>(f + 2 * (3 * r + k)); };
      const Pair own = (inverse(0) * left[0] + inverse(1) * left[1]) + inverse(2) * left[2];
      const Pair far = (by(3) * two[0] + by(4) * two[1]) + by(5) * two[2];
      x_b[k] = (own - far) - ((by(0) * one[0] + by(1) * one[1]) + by(2) * one[2]);
    }
    const PairPlace at = place_of(rows, values, b);
    for (int k = 0; k < 3; ++k) {
      at.first[k * n] = x_b[k][0];
      at.second[k * n] = x_b[k][1];
      two[k] = one[k];
      one[k] = x_b[k];
    }
  }
}

}  // namespace osteon::rods
