#include "near_search.h"

#include "block_search.h"

namespace osteon {
namespace {

using namespace block_search;

// How much below the best a value may stay and still be listed, as a share of the body's radius:
// about that far a point may move, or the surface under a turning direction, before another list
// is needed.
constexpr double kBand = 0.01;

// As PlaneExcess, of one plane.
double excess_of(const ConvexBody& body, std::uint32_t i, const Vec3& u) {
  return body.nx[i] * u.x() + body.ny[i] * u.y() + body.nz[i] * u.z() - body.offset[i];
}

double height_of(const ConvexBody& body, std::uint32_t i, const Vec3& n) {
  return body.vx[i] * n.x() + body.vy[i] * n.y() + body.vz[i] * n.z();
}

// A list that served fewer queries was not worth its making: the next one waits for some queries.
constexpr std::uint32_t kWorth = 4, kWait = 16;

void drop(NearList& near) {
  near.body = 0;
  near.wait = near.served < kWorth ? kWait : 0;
}

// Whether a list is to be made now.
bool due(NearList& near, const ConvexBody& body) {
  if (near.body == body.stamp) return false;
  if (near.wait == 0) return true;
  --near.wait;
  return false;
}

// Gathers the highest values above a bar, and the highest of what it leaves out.
class ListMaker {
 public:
  ListMaker(NearList& near, std::uint64_t body, const Vec3& at, double bar) : near_(near) {
    near_.body = body;
    near_.at = at;
    near_.rest = bar;
    near_.count = 0;
    near_.served = 0;
  }

  template <class Value>
  void add_run(std::size_t run, std::uint32_t member_count, const Value& value) {
    for (std::uint32_t i = static_cast<std::uint32_t>(run) * kRun; i < (run + 1) * kRun; i += 2) {
      std::array<double, 2> pair;
      value(i).store(pair.data());
      for (std::uint32_t k = 0; k < 2; ++k)
        if (pair[k] > near_.rest && i + k < member_count) add(i + k, pair[k]);
    }
  }

 private:
  void add(std::uint32_t index, double value) {
    std::uint32_t at = near_.count;
    if (near_.count < NearList::kMost) {
      ++near_.count;
    } else {
      const auto least = std::min_element(values_.begin(), values_.end());
      near_.rest = std::max(near_.rest, std::min(*least, value));
      if (!(value > *least)) return;
      at = static_cast<std::uint32_t>(least - values_.begin());
    }
    near_.index[at] = index;
    values_[at] = value;
  }

  NearList& near_;
  std::array<double, NearList::kMost> values_;
};

}  // namespace

Excess most_exceeded(const ConvexBody& body, const Vec3& u, double floor, NearList& near) {
  Excess found{floor, Excess::kNone};
  if (near.body == body.stamp) {
    for (std::uint32_t k = 0; k < near.count; ++k) {
      const double value = excess_of(body, near.index[k], u);
      if (value > found.value) found = {value, near.index[k]};
    }
    if (near.rest + (u - near.at).norm() <= found.value) {
      ++near.served;
      return found;
    }
    drop(near);
  }
  return most_exceeded(body, u, floor);
}

double support(const ConvexBody& body, const Vec3& n, NearList& near) {
  if (near.body == body.stamp) {
    double best = kLeast;
    for (std::uint32_t k = 0; k < near.count; ++k)
      best = std::max(best, height_of(body, near.index[k], n));
    // While the direction turns no vertex rises by more than this against the centre.
    const Vec3 turn = n - near.at;
    if (near.rest + body.center.dot(turn) + body.radius * turn.norm() <= best) {
      ++near.served;
      return best;
    }
    drop(near);
  }
  return support(body, n);
}

void list_planes(const ConvexBody& body, const Vec3& u, double level, NearList& near) {
  if (!due(near, body)) return;
  const ThreeLanes lanes(u);
  const double bar = level - kBand * body.radius;
  ListMaker list(near, body.stamp, u, bar);
  visit_plane_runs(body, lanes, bar, [&](std::size_t run) {
    list.add_run(run, body.plane_count, PlaneExcess{body, lanes});
  });
}

void list_vertices(const ConvexBody& body, const Vec3& n, double top, NearList& near) {
  if (!due(near, body)) return;
  const ThreeLanes lanes(n);
  const double bar = top - kBand * body.radius;
  ListMaker list(near, body.stamp, n, bar);
  visit_vertex_runs(body, lanes, bar, [&](std::size_t run) {
    list.add_run(run, body.vertex_count, VertexHeight{body, lanes});
  });
}

}  // namespace osteon
