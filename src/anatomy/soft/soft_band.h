#pragma once

#include <vector>

#include "soft/soft_layer.h"

namespace osteon {

/// One cross-section of a band: a flat bar with round edges.
struct BandSection {
  Vec3 center = Vec3::Zero();
  Vec3 along = Vec3::UnitX(), across = Vec3::UnitY(), flat = Vec3::UnitZ();  ///< unit, World
  double half_width = 0, half_thickness = 0;
};

/// A band laid over the bones.
struct LaidBand {
  std::vector<BandSection> sections;
  std::size_t first = 0, last = 0;  ///< sections of the path's ends; beyond them lie insertions
  std::vector<Vec3> attachments;    ///< of the points that are attached, in their order; on bone
  double length = 0;                ///< from end to end along the middle, outside bone, metres
};

/// How the bones of a band stand that a joint has bent apart.
struct BandBend {
  double taut = 0;  ///< share by which the band is drawn along the shortest way, from 0 to 1
  Mat3 R_first = Mat3::Identity(), R_last = Mat3::Identity();  ///< turns of the bones of its ends
};

/// Lays the ends on their bones' surfaces, leads a smooth curve through the points, and pulls it
/// taut over the bones: where it would run through one it is pushed out until half the band's
/// thickness lies over the bone. Where it lies on bone it turns its flat side to it; attached
/// ends go on over a short footprint (band_insertion.h). Over a bent joint it is drawn taut between
/// its ends first, and twists from one end's bone to the other's.
LaidBand lay_band(const BandDescription& band, const GroundView& ground, const BandBend& bend = {});

/// Signed distance to the band, about.
double distance(const LaidBand& band, const Vec3& p);
/// To the spans from section `first` to section `last`.
double distance(const LaidBand& band, const Vec3& p, std::size_t first, std::size_t last);
Aabb bounds(const LaidBand& band);

}  // namespace osteon
