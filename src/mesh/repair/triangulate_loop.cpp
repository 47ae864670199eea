#include "repair/triangulate_loop.h"

#include <limits>

#include "repair/clean.h"

namespace osteon {
namespace {

constexpr double kImpossible = std::numeric_limits<double>::infinity();

class LeastArea {
 public:
  LeastArea(const std::vector<Vec3>& vertices, const std::vector<std::uint32_t>& loop)
      : vertices_(vertices), loop_(loop), n_(loop.size()), best_(n_ * n_) {
    Aabb box;
    for (const std::uint32_t v : loop) box.include(vertices[v]);
    flat_cost_ = box.extent().squaredNorm();
  }

  template <class MayJoin>
  bool solve(const MayJoin& may_join) {
    for (std::size_t span = 2; span < n_; ++span) {
      for (std::size_t i = 0; i + span < n_; ++i) {
        const std::size_t j = i + span;
        const bool is_rim = span == n_ - 1;
        if (is_rim || may_join(loop_[i], loop_[j]))
          choose(i, j);
        else
          at(i, j).cost = kImpossible;
      }
    }
    return at(0, n_ - 1).cost < kImpossible;
  }

  std::vector<Triangle> triangles() const {
    std::vector<Triangle> out;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, n_ - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j - i < 2) continue;
      const std::size_t k = at(i, j).middle;
      out.push_back({loop_[i], loop_[k], loop_[j]});
      open.push_back({i, k});
      open.push_back({k, j});
    }
    return out;
  }

 private:
  struct Choice {
    double cost = 0;
    std::size_t middle = 0;
  };
  Choice& at(std::size_t i, std::size_t j) { return best_[i * n_ + j]; }
  const Choice& at(std::size_t i, std::size_t j) const { return best_[i * n_ + j]; }

  void choose(std::size_t i, std::size_t j) {
    Choice choice{kImpossible, 0};
    for (std::size_t k = i + 1; k < j; ++k) {
      const double cost = at(i, k).cost + at(k, j).cost + cost_of(i, k, j);
      if (cost < choice.cost) choice = {cost, k};
    }
    at(i, j) = choice;
  }

  double cost_of(std::size_t i, std::size_t k, std::size_t j) const {
    const Vec3 &a = vertices_[loop_[i]], &b = vertices_[loop_[k]], &c = vertices_[loop_[j]];
    return (b - a).cross(c - a).norm() / 2 + (is_flat(a, b, c) ? flat_cost_ : 0);
  }

  const std::vector<Vec3>& vertices_;
  const std::vector<std::uint32_t>& loop_;
  std::size_t n_;
  std::vector<Choice> best_;
  double flat_cost_ = 0;
};

}  // namespace

std::vector<Triangle> triangulate_loop(
    const std::vector<Vec3>& vertices, const std::vector<std::uint32_t>& loop,
    const std::function<bool(std::uint32_t, std::uint32_t)>& may_join) {
  if (loop.size() < 3) return {};
  LeastArea least(vertices, loop);
  if (!least.solve(may_join)) return {};
  return least.triangles();
}

}  // namespace osteon
