#include "soft/soft_band.h"

#include <algorithm>
#include <cmath>

#include "bone/nearby_surface.h"
#include "soft/band_insertion.h"

namespace osteon {
namespace {

constexpr int kStepsPerSpan = 10;
constexpr int kRounds = 40;
constexpr double kThinnest = 0.7;  // of the thickness, at an end that thins out (D)

using Station = BandStation;

/// Through the points, as a tube's curve runs; widths go along.
std::vector<Station> stations_of(const BandDescription& band, const std::vector<Vec3>& points) {
  std::vector<Station> stations;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 before = i > 0 ? points[i - 1] : Vec3(2 * points[i] - points[i + 1]);
    const Vec3 after = i + 2 < points.size() ? points[i + 2] : Vec3(2 * points[i + 1] - points[i]);
    const int last = i + 2 < points.size() ? kStepsPerSpan - 1 : kStepsPerSpan;
    for (int k = 0; k <= last; ++k) {
      const double t = static_cast<double>(k) / kStepsPerSpan, t2 = t * t, t3 = t2 * t;
      Station s;
      s.p = 0.5 * ((2 * t2 - t3 - t) * before + (3 * t3 - 5 * t2 + 2) * points[i] +
                   (4 * t2 - 3 * t3 + t) * points[i + 1] + (t3 - t2) * after);
      const double ease = t2 * (3 - 2 * t);
      const BandPoint& a = band.path[i];
      const BandPoint& b = band.path[i + 1];
      s.width = a.width + ease * (b.width - a.width);
      s.thickness = a.thickness + ease * (b.thickness - a.thickness);
      stations.push_back(s);
    }
  }
  return stations;
}

/// Out of every bone until the bone is `room` away.
Vec3 pushed_out(Vec3 p, double room, const GroundView& ground) {
  for (const SoftGround* bone : ground) {
    if (distance_to_box(p, bone->box) >= room) continue;
    const ClosestPoint at = bone->surface.closest(p);
    if (at.signed_distance >= room) continue;
    const Vec3 away = p - at.point;
    const double length = away.norm();
    if (length < 1e-9) continue;
    const double sign = at.signed_distance < 0 ? -1 : 1;
    p = at.point + (sign * room / length) * away;
  }
  return p;
}

/// Share of the wanted room that a station has: none where the band holds on to bone.
double room_share(std::size_t i, std::size_t count, bool first_held, bool last_held) {
  const double ramp = 0.2 * static_cast<double>(count - 1);
  double share = 1;
  if (first_held) share = std::min(share, static_cast<double>(i) / ramp);
  if (last_held) share = std::min(share, static_cast<double>(count - 1 - i) / ramp);
  return share;
}

/// A band gets thinner where it grows into bone, unless its ends' thickness was said.
void thin_ends(const BandDescription& band, std::vector<Station>& stations) {
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const double share = std::min(1.0, room_share(i, stations.size(), band.path.front().thins_out,
                                                  band.path.back().thins_out));
    stations[i].thickness *= kThinnest + (1 - kThinnest) * share;
  }
}

/// A string around obstacles: pulled towards the middle of its neighbours where it was pushed,
/// then pushed out again.
void pull_over_bone(const BandDescription& band, const GroundView& ground,
                    std::vector<Station>& stations) {
  const std::size_t count = stations.size();
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Vec3> next;
    double most = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double share =
          room_share(i, count, band.path.front().attached, band.path.back().attached);
      const bool end = i == 0 || i + 1 == count;
      const Vec3 out = end || share <= 0
                           ? stations[i].p
                           : pushed_out(stations[i].p, share * 0.5 * stations[i].thickness, ground);
      most = std::max(most, (out - stations[i].p).norm());
      next.push_back(out);
    }
    if (most < 1e-5) return;
    for (std::size_t i = 1; i + 1 < count; ++i)
      stations[i].p = 0.5 * next[i] + 0.25 * (next[i - 1] + next[i + 1]);
  }
}

/// Shares of the way along the curve at which the stations stand.
std::vector<double> shares_of(const std::vector<Station>& stations) {
  std::vector<double> shares{0};
  for (std::size_t i = 0; i + 1 < stations.size(); ++i)
    shares.push_back(shares.back() + (stations[i + 1].p - stations[i].p).norm());
  const double length = shares.back();
  for (double& share : shares) share /= length;
  return shares;
}

/// Place at a share of the way along a string of equal links.
Vec3 at_share(const std::vector<Vec3>& string, double share) {
  const double place = share * static_cast<double>(string.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), string.size() - 2);
  return string[i] + (place - static_cast<double>(i)) * (string[i + 1] - string[i]);
}

/// Links of about equal length along the stations.
std::vector<Vec3> string_along(const std::vector<Station>& stations, std::size_t links) {
  const std::vector<double> shares = shares_of(stations);
  std::vector<Vec3> string;
  std::size_t i = 0;
  for (std::size_t k = 0; k <= links; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(links);
    while (i + 2 < stations.size() && shares[i + 1] < share) ++i;
    const double t = std::clamp((share - shares[i]) / (shares[i + 1] - shares[i]), 0.0, 1.0);
    string.push_back(stations[i].p + t * (stations[i + 1].p - stations[i].p));
  }
  return string;
}

/// Draws the band by `share` towards the shortest way between its ends that stays over the bones:
/// each link's end goes to the middle of its neighbours, over-relaxed, and out of bone again.
void tauten(const BandDescription& band, const GroundView& ground, double share,
            std::vector<Station>& stations) {
  constexpr std::size_t kLinks = 24;
  constexpr int kTautRounds = 120;
  constexpr double kOver = 1.5;
  std::vector<Vec3> string = string_along(stations, kLinks);
  const double half = 0.5 * stations[stations.size() / 2].thickness;
  for (int round = 0; round < kTautRounds; ++round)
    for (std::size_t i = 1; i < kLinks; ++i) {
      const Vec3 middle = 0.5 * (string[i - 1] + string[i + 1]);
      const Vec3 drawn = string[i] + kOver * (middle - string[i]);
      const double room =
          half * room_share(i, kLinks + 1, band.path.front().attached, band.path.back().attached);
      string[i] = room > 0 ? pushed_out(drawn, room, ground) : drawn;
    }
  const std::vector<double> shares = shares_of(stations);
  for (std::size_t i = 1; i + 1 < stations.size(); ++i)
    stations[i].p += share * (at_share(string, shares[i]) - stations[i].p);
}

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double length = v.norm();
  return length > 1e-12 ? Vec3(v / length) : otherwise;
}

/// The wanted flat directions, from one end's to the other's.
std::vector<Vec3> flats_between(const std::vector<Station>& stations, const Vec3& first_W,
                                const Vec3& last_W) {
  std::vector<Vec3> flats;
  for (const double share : shares_of(stations))
    flats.push_back(unit_or(first_W + share * (last_W - first_W), first_W));
  return flats;
}

std::vector<BandSection> sections_of(const std::vector<Station>& stations,
                                     const std::vector<Vec3>& flats) {
  std::vector<BandSection> sections;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const Vec3& a = stations[i > 0 ? i - 1 : i].p;
    const Vec3& b = stations[i + 1 < stations.size() ? i + 1 : i].p;
    BandSection s;
    s.center = stations[i].p;
    s.along = unit_or(b - a, sections.empty() ? Vec3::UnitX() : sections.back().along);
    const Vec3 before = sections.empty() ? Vec3(s.along.unitOrthogonal()) : sections.back().flat;
    s.flat = unit_or(flats[i] - flats[i].dot(s.along) * s.along, before);
    s.across = s.flat.cross(s.along);
    s.half_width = 0.5 * stations[i].width;
    s.half_thickness = 0.5 * stations[i].thickness;
    sections.push_back(s);
  }
  return sections;
}

/// Ends that are attached go on into their bones. Returns how many stations come before the first.
std::size_t insert_ends(const BandDescription& band, const GroundView& ground,
                        std::vector<Station>& stations) {
  const auto onward = [&](std::size_t end, std::size_t before) {
    return unit_or(stations[end].p - stations[before].p, Vec3::Zero());
  };
  std::vector<Station> root;
  if (band.path.front().attached)
    root = insertion(stations.front(), onward(0, 1), *ground[band.path.front().at.bone]);
  const std::size_t last = stations.size() - 1;
  if (band.path.back().attached)
    for (const Station& s :
         insertion(stations.back(), onward(last, last - 1), *ground[band.path.back().at.bone]))
      stations.push_back(s);
  stations.insert(stations.begin(), root.rbegin(), root.rend());
  return root.size();
}

}  // namespace

LaidBand lay_band(const BandDescription& band, const GroundView& ground, const BandBend& bend) {
  LaidBand laid;
  std::vector<Vec3> points;
  for (const BandPoint& point : band.path) {
    points.push_back(point.at.p_W);
    if (!point.attached) continue;
    points.back() = ground[point.at.bone]->surface.closest(point.at.p_W).point;
    laid.attachments.push_back(points.back());
  }
  std::vector<Station> stations = stations_of(band, points);
  if (bend.taut > 0) tauten(band, ground, bend.taut, stations);
  thin_ends(band, stations);
  pull_over_bone(band, ground, stations);
  for (std::size_t i = 0; i + 1 < stations.size(); ++i)
    laid.length += (stations[i + 1].p - stations[i].p).norm();
  const std::size_t spans = stations.size() - 1;
  laid.first = insert_ends(band, ground, stations);
  laid.last = laid.first + spans;
  const std::vector<Vec3> flats =
      flats_between(stations, bend.R_first * band.flat_W, bend.R_last * band.flat_W);
  laid.sections = sections_of(stations, turned_flat_on_bone(stations, flats, ground));
  return laid;
}

double distance(const LaidBand& band, const Vec3& p) {
  return distance(band, p, 0, band.sections.empty() ? 0 : band.sections.size() - 1);
}

double distance(const LaidBand& band, const Vec3& p, std::size_t first, std::size_t last) {
  double nearest = 1e300;
  for (std::size_t i = first; i < last; ++i) {
    const BandSection& a = band.sections[i];
    const BandSection& b = band.sections[i + 1];
    const Vec3 step = b.center - a.center, from_a = p - a.center;
    const double reach = step.norm() + a.half_width + b.half_width;
    const double far = nearest + reach;  // beyond it this span cannot be nearer
    if (far > 0 && from_a.squaredNorm() > far * far) continue;
    const double share = std::clamp(from_a.dot(step) / step.squaredNorm(), 0.0, 1.0);
    const Vec3 r = from_a - share * step;
    const double u = r.dot(a.across) + share * (r.dot(b.across) - r.dot(a.across));
    const double v = r.dot(a.flat) + share * (r.dot(b.flat) - r.dot(a.flat));
    const double half_width = a.half_width + share * (b.half_width - a.half_width);
    const double half = a.half_thickness + share * (b.half_thickness - a.half_thickness);
    const double beside = std::max(std::abs(u) - (half_width - half), 0.0);
    const double ahead2 = std::max(r.squaredNorm() - u * u - v * v, 0.0);
    nearest = std::min(nearest, std::sqrt(beside * beside + v * v + ahead2) - half);
  }
  return nearest;
}

Aabb bounds(const LaidBand& band) {
  Aabb box;
  for (const BandSection& s : band.sections) {
    box.include(s.center - Vec3::Constant(s.half_width));
    box.include(s.center + Vec3::Constant(s.half_width));
  }
  return box;
}

}  // namespace osteon
