#include <limits>

#include "osteon/anatomy/name_bones.h"

namespace osteon {

// Shortest augmenting paths with potentials; column 0 is a helper.
std::vector<int> least_cost_assignment(const std::vector<std::vector<double>>& cost) {
  const std::size_t rows = cost.size(), columns = rows == 0 ? 0 : cost[0].size();
  std::vector<double> u(rows + 1, 0), v(columns + 1, 0);
  std::vector<std::size_t> row_of(columns + 1, 0), way(columns + 1, 0);
  for (std::size_t row = 1; row <= rows; ++row) {
    row_of[0] = row;
    std::size_t at = 0;
    std::vector<double> least(columns + 1, std::numeric_limits<double>::infinity());
    std::vector<bool> used(columns + 1, false);
    do {
      used[at] = true;
      const std::size_t r = row_of[at];
      double delta = std::numeric_limits<double>::infinity();
      std::size_t next = 0;
      for (std::size_t c = 1; c <= columns; ++c) {
        if (used[c]) continue;
        const double reduced = cost[r - 1][c - 1] - u[r] - v[c];
        if (reduced < least[c]) {
          least[c] = reduced;
          way[c] = at;
        }
        if (least[c] < delta) {
          delta = least[c];
          next = c;
        }
      }
      for (std::size_t c = 0; c <= columns; ++c) {
        if (used[c]) {
          u[row_of[c]] += delta;
          v[c] -= delta;
        } else {
          least[c] -= delta;
        }
      }
      at = next;
    } while (row_of[at] != 0);
    for (; at != 0; at = way[at]) row_of[at] = row_of[way[at]];
  }
  std::vector<int> column_of(rows, -1);
  for (std::size_t c = 1; c <= columns; ++c)
    if (row_of[c]) column_of[row_of[c] - 1] = static_cast<int>(c - 1);
  return column_of;
}

}  // namespace osteon
