#include "tet/tet_factor.h"

#include <algorithm>

#include "tet/tet_rows.h"

namespace osteon {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Neighbours = std::vector<std::vector<std::uint32_t>>;

Neighbours neighbours_in(const Sparse& lower) {
  Neighbours near(static_cast<std::size_t>(lower.rows() / 3));
  for (Eigen::Index column = 0; column < lower.outerSize(); ++column)
    for (Sparse::InnerIterator it(lower, column); it; ++it) {
      const auto a = static_cast<std::uint32_t>(it.row() / 3),
                 b = static_cast<std::uint32_t>(column / 3);
      if (a == b) continue;
      near[a].push_back(b);
      near[b].push_back(a);
    }
  for (auto& list : near) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return near;
}

// Breadth first from a node, those with few neighbours first; appended to what is there.
void walk(const Neighbours& near, std::uint32_t from, std::vector<bool>& seen,
          std::vector<std::uint32_t>& order) {
  std::size_t next = order.size();
  order.push_back(from);
  seen[from] = true;
  for (; next < order.size(); ++next) {
    const std::size_t begin = order.size();
    for (const std::uint32_t n : near[order[next]]) {
      if (seen[n]) continue;
      seen[n] = true;
      order.push_back(n);
    }
    std::stable_sort(
        order.begin() + static_cast<std::ptrdiff_t>(begin), order.end(),
        [&](std::uint32_t a, std::uint32_t b) { return near[a].size() < near[b].size(); });
  }
}

// The node found last from the one found last from a node: an end of its part.
std::uint32_t end_of_part(const Neighbours& near, std::uint32_t from) {
  for (int n = 0; n < 2; ++n) {
    std::vector<bool> seen(near.size(), false);
    std::vector<std::uint32_t> order;
    walk(near, from, seen, order);
    from = order.back();
  }
  return from;
}

// First column of each row.
std::vector<std::uint32_t> first_columns(const Sparse& lower,
                                         const std::vector<std::uint32_t>& place) {
  std::vector<std::uint32_t> first(static_cast<std::size_t>(lower.rows()));
  const auto put = [&](Eigen::Index i) {
    return 3 * place[static_cast<std::size_t>(i / 3)] + static_cast<std::uint32_t>(i % 3);
  };
  for (std::uint32_t i = 0; i < first.size(); ++i) first[i] = i;
  for (Eigen::Index column = 0; column < lower.outerSize(); ++column)
    for (Sparse::InnerIterator it(lower, column); it; ++it) {
      const auto [low, high] = std::minmax({put(it.row()), put(column)});
      first[high] = std::min(first[high], low);
    }
  return first;
}

}  // namespace

std::vector<std::uint32_t> short_row_order(const Neighbours& near) {
  std::vector<bool> seen(near.size(), false);
  std::vector<std::uint32_t> order, place(near.size());
  for (std::uint32_t n = 0; n < near.size(); ++n)
    if (!seen[n]) walk(near, end_of_part(near, n), seen, order);
  const auto last = static_cast<std::uint32_t>(near.size()) - 1;
  for (std::uint32_t k = 0; k < order.size(); ++k) place[order[k]] = last - k;
  return place;
}

void TetFactor::compute(const Sparse& lower) {
  place_ = short_row_order(neighbours_in(lower));
  const std::vector<std::uint32_t> first = first_columns(lower, place_);
  std::size_t entries = 0;
  for (std::size_t i = 0; i < first.size(); ++i) entries += i - first[i] + 1;
  if (entries > most_in_rows_) {
    place_.clear();
    sparse_.compute(lower);
    return;
  }
  profile_ = ProfileMatrix(first);
  for (Eigen::Index column = 0; column < lower.outerSize(); ++column)
    for (Sparse::InnerIterator it(lower, column); it; ++it) {
      const auto put = [&](Eigen::Index i) {
        return 3 * std::size_t{place_[static_cast<std::size_t>(i / 3)]} +
               static_cast<std::size_t>(i % 3);
      };
      const auto [low, high] = std::minmax({put(it.row()), put(column)});
      profile_.at(high, low) += it.value();
    }
  profile_.factor(static_cast<std::size_t>(-1));
}

void TetFactor::solve(Eigen::VectorXd& x) const {
  if (place_.empty()) {
    x = sparse_.solve(x).eval();
    return;
  }
  std::vector<double> y(static_cast<std::size_t>(x.size()));
  for (std::size_t n = 0; n < place_.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k)
      y[3 * place_[n] + k] = x[static_cast<Eigen::Index>(3 * n + k)];
  const tets::TetProfile rows{profile_.first_.data(), profile_.start_.data(), profile_.rows_.data(),
                              static_cast<long>(y.size())};
  const tets::TetWork& work = tets::best_tet_work();
  work.forward(rows, y.data());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] /= profile_.pivots_[i];
  work.back(rows, y.data());
  for (std::size_t n = 0; n < place_.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k)
      x[static_cast<Eigen::Index>(3 * n + k)] = y[3 * place_[n] + k];
}

}  // namespace osteon
