#include "osteon/collide/carved_contact.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "osteon/collide/field_contact.h"

namespace osteon {
namespace {

// Where the field rises less than this, walls on several sides are as near as each other.
constexpr double kOneWall = 0.8;
// A gap wider than this, m, is not measured so well: no way ends there.
constexpr double kClose = 5e-4;
constexpr int kRound = 8;  // directions about the axis

// Two unit vectors across a unit vector and each other.
std::array<Vec3, 2> both_across(const Vec3& u) {
  const Vec3 e = u.unitOrthogonal();
  return {e, u.cross(e)};
}

// Symbols: x is a point of the rod's axis, r its radius, n a unit vector from bone to rod, and the
// rod's surface is at x - r n. In the middle of a hole that a rod fills the splines of a field say
// too little, and its slope points at no wall; at the rod's own surface, which is near a wall, they
// say what is so. Invariant: `best_` is the lowest height found at the rod's surface, so that the
// gap is never told as smaller than some place of the rod has. Source: point shells of McNeely,
// Puterbaugh and Troy, SIGGRAPH 1999, here few points where the field says that walls are near.
// Ends: a fixed number of looks.
class SurfaceOfRod {
 public:
  SurfaceOfRod(const FieldView& field, const Capsule& rod_A) : field_(field), rod_(rod_A) {}

  // False: the field does not reach so far.
  bool start(const Vec3& x, const Vec3& n) {
    best_ = look(x, n);
    if (!best_.near) return false;
    follow_slope();
    return true;
  }

  void look_round(const Vec3& x) {
    const Vec3 along = rod_.p1 - rod_.p0;
    const double length = along.norm();
    if (!(length > 0)) return look_over_end(x, Vec3::UnitZ());
    const auto [e, f] = both_across(along / length);
    double least = best_.gap;
    int lowest = -1;
    for (int k = 0; k < kRound; ++k) {
      const double gap = gap_at(x, turned(e, f, k));
      if (!(gap < least)) continue;
      least = gap;
      lowest = k;
    }
    if (lowest >= 0) best_ = look_again(x, turned(e, f, lowest));
    follow_slope();
  }

  // The half ball about an end of the axis; `inward` is the unit vector to the other end. First a
  // ring halfway down, then on by the slope of its lowest place, or up and down from there.
  void look_over_end(const Vec3& x, const Vec3& inward) {
    const Vec3 side = lowest_side(x, inward);
    const Touch halfway = look(x, tilted(inward, side, 0.5));
    take(halfway);
    if (!settles(x, halfway)) look_up_and_down(x, inward, side, halfway.gap);
    follow_slope();
  }

  CapsuleContact contact() const {
    CapsuleContact out;
    out.status = LpStatus::kOptimal;
    out.gap = best_.gap;
    const double slope = best_.slope.norm();
    out.nhat_AB_A = off_the_rod(slope > 0.5 ? Vec3(best_.slope / slope) : best_.n);
    out.p_axis_A = best_.x;
    out.p_A = best_.x - rod_.radius * best_.n - best_.gap * out.nhat_AB_A;
    return out;
  }
  double gap() const { return best_.gap; }

 private:
  struct Touch {
    Vec3 x = Vec3::Zero(), n = Vec3::UnitZ(), slope = Vec3::Zero();
    double gap = 0;
    bool near = false;
  };

  // Of a whole rod the place nearest to a plane is an end, or its whole side. A slope that leans
  // along the axis where the side or the other end touches is that of a place beside the nearest
  // one: its plane would reach into the rod.
  Vec3 off_the_rod(const Vec3& n) const {
    constexpr double kAtEnd_m = 1e-6, kAcross = 0.1;
    const Vec3 along = rod_.p1 - rod_.p0;
    const double length = along.norm();
    if (!(length > 0)) return n;
    const double lean = n.dot(along) / length;
    const Vec3& nearer = lean > 0 ? rod_.p0 : rod_.p1;
    if ((best_.x - nearer).norm() < kAtEnd_m) return n;
    const Vec3 across = n - lean / length * along;
    const double size = across.norm();
    return size > kAcross ? Vec3(across / size) : n;
  }

  // Of the directions about `inward` the one in which a ring halfway down is lowest.
  Vec3 lowest_side(const Vec3& x, const Vec3& inward) const {
    const auto [e, f] = both_across(inward);
    int lowest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kRound; ++k) {
      const double gap = gap_at(x, tilted(inward, turned(e, f, k), 0.5));
      if (!(gap < least)) continue;
      least = gap;
      lowest = k;
    }
    return turned(e, f, lowest);
  }

  // Whether the place that the slope points at is nearest to one wall: there its slope points at
  // the same place again. At a rim it does not.
  bool settles(const Vec3& x, const Touch& from) {
    constexpr double kSame = 0.999;
    const double slope = from.slope.norm();
    if (!(slope > kOneWall)) return false;
    const Touch there = look(x, from.slope / slope);
    const double size = there.slope.norm();
    take(there);
    return there.gap <= from.gap && size > kOneWall && there.slope.dot(there.n) > kSame * size;
  }

  void look_up_and_down(const Vec3& x, const Vec3& inward, const Vec3& side, double least) {
    double at = 0.5;
    for (double step = 0.25; step > 0.02; step *= 0.5)
      for (const double way : {-step, step}) {
        const double gap = gap_at(x, tilted(inward, side, at + way));
        if (!(gap < least)) continue;
        least = gap;
        at += way;
        break;
      }
    if (least < best_.gap) best_ = look_again(x, tilted(inward, side, at));
  }

  // `share` of a right angle from `inward` to `side`.
  static Vec3 tilted(const Vec3& inward, const Vec3& side, double share) {
    const double angle = 0.5 * std::numbers::pi * share;
    return std::cos(angle) * inward + std::sin(angle) * side;
  }
  static Vec3 turned(const Vec3& e, const Vec3& f, int k) {
    const double angle = 2 * std::numbers::pi * k / kRound;
    return std::cos(angle) * e + std::sin(angle) * f;
  }
  Touch look(const Vec3& x, const Vec3& n) const {
    return touch(x, n, field_.at(x - rod_.radius * n));
  }
  // Many places are compared by their gaps alone, and only the lowest one's slope is asked for.
  double gap_at(const Vec3& x, const Vec3& n) const {
    return field_.distance_at(x - rod_.radius * n);
  }
  Touch look_again(const Vec3& x, const Vec3& n) const {
    return touch(x, n, field_.again(x - rod_.radius * n));
  }
  static Touch touch(const Vec3& x, const Vec3& n, const FieldSample& there) {
    return {x, n, there.gradient, there.distance, there.near};
  }
  void take(const Touch& there) {
    if (there.gap < best_.gap) best_ = there;
  }
  // What is nearest lies where the slope points along n.
  void follow_slope() {
    const double slope = best_.slope.norm();
    if (slope > kOneWall) take(look(best_.x, best_.slope / slope));
  }

  const FieldView& field_;
  const Capsule& rod_;
  Touch best_;
};

}  // namespace

CapsuleContact carved_contact(const FieldView& coarse, const FieldView& fine, const Capsule& rod_A,
                              double far_m, double low_m) {
  const CapsuleContact found = field_contact(coarse, rod_A, far_m);
  if (found.status != LpStatus::kOptimal || !(found.gap < far_m)) return found;
  SurfaceOfRod surface(fine, rod_A);
  if (!surface.start(found.p_axis_A, found.nhat_AB_A)) return found;
  if (found.gap > kClose || surface.gap() < low_m) return surface.contact();
  if (fine.at(found.p_axis_A).gradient.norm() < kOneWall) surface.look_round(found.p_axis_A);
  const Vec3 along = rod_A.p1 - rod_A.p0;
  const double length = along.norm();
  if (!(length > 0)) return surface.contact();
  for (const double side : {1.0, -1.0}) {
    if (surface.gap() < low_m) break;
    const Vec3& end = side > 0 ? rod_A.p0 : rod_A.p1;
    if (fine.distance_at(end) - rod_A.radius < surface.gap())
      surface.look_over_end(end, side / length * along);
  }
  return surface.contact();
}

}  // namespace osteon
