#include "clearing_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

#include "open_sight.h"
#include "osteon/collide/segments.h"

namespace osteon {
namespace {

constexpr double kScopeRadius_m = 0.0025;
constexpr double kBetween_m = 0.001;  // between both shafts
constexpr double kBehind_m = 0.1;     // so much of a shaft stands before the skin
constexpr double kNearest_m = 0.006;  // to the window
constexpr double kFarthest_m = 0.045;
constexpr double kInPicture = 0.85;     // of half the field
constexpr double kTipHides_m = 0.0035;  // what is so near to the tip does not hide it
constexpr std::size_t kMostViews = 3, kMostAims = 6;
constexpr int kTurns = 11;
constexpr double kGazeTurn_rad = 15 * std::numbers::pi / 180;

// A pose of the scope and what its picture shows.
struct Look {
  Gaze gaze;
  std::vector<char> seen;  // by place
  std::size_t count = 0;
};

class ViewSearch {
 public:
  ViewSearch(const AclKnee& knee, const StumpsAsObstacles& stumps, const StumpClearing& with,
             const ClearingWatcher& who)
      : knee_(knee),
        stumps_(stumps),
        with_(with),
        who_(who),
        sight_(knee, knee.whole(), rest_snapshot(knee.whole())) {}

  // The first of those that show the most, upright ones first. Ends: all candidates are tried once.
  Look best(const std::vector<ClearingPlace>& places) const {
    Look most;
    const std::vector<Vec3> aims = aims_at(places);
    for (int turn = 0; turn <= kTurns; ++turn)
      for (const double side : {1.0, -1.0})
        for (const Vec3& aim_W : aims)
          for (const double mm : {16.0, 20.0, 13.0, 24.0, 10.0}) {
            Look look{{aim_W, 0.001 * mm, side * turn * kGazeTurn_rad}, {}, 0};
            if (!shows(places, most.count, look)) continue;
            most = std::move(look);
            if (most.count == places.size()) return most;
          }
    return most;
  }

 private:
  std::vector<Vec3> aims_at(const std::vector<ClearingPlace>& places) const {
    Vec3 middle = Vec3::Zero();
    for (const ClearingPlace& place : places) middle += place.to_W;
    std::vector<Vec3> aims{middle / static_cast<double>(places.size())};
    aims.insert(aims.end(), who_.aims_W.begin(), who_.aims_W.end());
    const std::size_t stride = places.size() / kMostAims + 1;
    for (std::size_t i = 0; i < places.size(); i += stride) aims.push_back(places[i].to_W);
    return aims;
  }

  Capsule rod_to(const Vec3& p_W) const {
    const Vec3 back = (with_.portal_W - p_W).normalized();
    return {p_W - with_.radius_m * back, with_.portal_W + kBehind_m * back, with_.radius_m};
  }

  bool is_clear(const Capsule& scope, const Vec3& p_W) const {
    const Capsule rod = rod_to(p_W);
    const AxisPoints nearest = nearest_on_axes(scope, rod);
    return (nearest.a - nearest.b).norm() > scope.radius + rod.radius + kBetween_m;
  }

  bool is_seen(const ScopeView& view, const Vec3& p_W) const {
    const Vec3 way = p_W - view.eye_W;
    const double far = way.norm();
    return far > kNearest_m && far < kFarthest_m &&
           way.dot(view.along_W) > far * std::cos(kInPicture * who_.optics.half_field_rad) &&
           sight_.is_in_sight(view.eye_W, p_W - kTipHides_m / far * way);
  }

  // The tip where it begins to clear, and where it stops.
  bool is_seen(const ScopeView& view, const ClearingPlace& place) const {
    const Vec3 back = (with_.portal_W - place.to_W).normalized();
    return is_seen(view, place.to_W - with_.radius_m * back) &&
           is_seen(view, place.to_W + (place.way_m - with_.radius_m) * back);
  }

  // False: not free, or no more than `than` places are seen.
  bool shows(const std::vector<ClearingPlace>& places, std::size_t than, Look& look) const {
    const auto pose = pose_for(look.gaze, who_.portal_W, who_.optics);
    if (!pose || !knee_.is_free(pose->p, who_.portal_W, kScopeRadius_m) ||
        !stumps_.is_free(pose->p, who_.portal_W, kScopeRadius_m))
      return false;
    const Vec3 back = pose->rotate(Vec3::UnitZ());
    const Capsule scope{pose->p, who_.portal_W + kBehind_m * back, kScopeRadius_m};
    for (const Vec3& p_W : who_.also_W)
      if (!is_clear(scope, p_W)) return false;
    const ScopeView view = view_through(who_.optics, *pose);
    if (!sight_.is_open(view, who_.optics)) return false;
    look.seen.assign(places.size(), 0);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (look.count + (places.size() - i) <= than) return false;
      look.seen[i] = is_clear(scope, places[i].to_W) && is_seen(view, places[i]) ? 1 : 0;
      look.count += static_cast<std::size_t>(look.seen[i]);
    }
    return look.count > than;
  }

  const AclKnee& knee_;
  const StumpsAsObstacles& stumps_;
  const StumpClearing& with_;
  const ClearingWatcher& who_;
  OpenSight sight_;
};

}  // namespace

// Each view takes what it shows of the places that are left, so it ends: a view that shows nothing
// new is the last.
std::vector<ClearingView> clearing_views(const AclKnee& knee, const StumpsAsObstacles& stumps,
                                         const StumpClearing& with, const ClearingWatcher& who,
                                         std::vector<ClearingPlace> places) {
  const ViewSearch search(knee, stumps, with, who);
  std::vector<ClearingView> views;
  while (!places.empty() && views.size() < kMostViews) {
    const Look look = search.best(places);
    if (look.count == 0) break;
    ClearingView view{look.gaze, {}};
    std::vector<ClearingPlace> left;
    for (std::size_t i = 0; i < places.size(); ++i)
      (look.seen[i] ? view.places : left).push_back(places[i]);
    views.push_back(std::move(view));
    places = std::move(left);
  }
  if (!views.empty())
    std::move(places.begin(), places.end(), std::back_inserter(views.back().places));
  return views;
}

}  // namespace osteon
