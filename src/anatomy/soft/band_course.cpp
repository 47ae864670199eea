#include "soft/band_course.h"

#include <algorithm>
#include <vector>

namespace osteon {
namespace {

/// A place of the middle line outside bone: `share` of the span that begins at section `span`.
struct CoursePlace {
  std::size_t span = 0;
  double share = 0;
};

double length_of_span(const LaidBand& band, std::size_t i) {
  return (band.sections[i + 1].center - band.sections[i].center).norm();
}

CoursePlace nearest_place(const LaidBand& band, const Vec3& p_W) {
  CoursePlace nearest{band.first, 0};
  double least2 = 1e300;
  for (std::size_t i = band.first; i < band.last; ++i) {
    const Vec3& a = band.sections[i].center;
    const Vec3 step = band.sections[i + 1].center - a;
    const double share = std::clamp((p_W - a).dot(step) / step.squaredNorm(), 0.0, 1.0);
    const double d2 = (p_W - a - share * step).squaredNorm();
    if (d2 >= least2) continue;
    least2 = d2;
    nearest = {i, share};
  }
  return nearest;
}

/// Length from the band's first end, metres.
double way_to(const LaidBand& band, const CoursePlace& place) {
  double way = place.share * length_of_span(band, place.span);
  for (std::size_t i = band.first; i < place.span; ++i) way += length_of_span(band, i);
  return way;
}

CoursePlace place_at(const LaidBand& band, double way) {
  for (std::size_t i = band.first; i + 1 < band.last; ++i) {
    const double length = length_of_span(band, i);
    if (way <= length) return {i, way / length};
    way -= length;
  }
  return {band.last - 1, std::min(way / length_of_span(band, band.last - 1), 1.0)};
}

/// Of the cross-section there: along, across and flat are its axes.
Pose section_pose(const LaidBand& band, const CoursePlace& place) {
  const BandSection& a = band.sections[place.span];
  const BandSection& b = band.sections[place.span + 1];
  const auto between = [&](const Vec3& from, const Vec3& to) {
    return Vec3(from + place.share * (to - from));
  };
  const Vec3 along = between(a.along, b.along), flat = between(a.flat, b.flat);
  Mat3 R;
  R.col(0) = along / along.norm();
  const Vec3 square = flat - flat.dot(R.col(0)) * R.col(0);
  R.col(2) = square / square.norm();
  R.col(1) = R.col(2).cross(R.col(0));
  return {between(a.center, b.center), Quat(R)};
}

}  // namespace

Pose motion_along(const LaidBand& from, const LaidBand& to, const Vec3& near_W) {
  const CoursePlace rest = nearest_place(from, near_W);
  const double share = way_to(from, rest) / from.length;
  return section_pose(to, place_at(to, share * to.length)) * section_pose(from, rest).inverse();
}

}  // namespace osteon
