#include "osteon/anatomy/virtual_scan.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/random.h"
#include "osteon/image/gaussian.h"
#include "scan/scan_body.h"
#include "scan/scan_slab.h"

namespace osteon {
namespace {

constexpr double kMostVoxels = 1e9;
constexpr double kFinestCell_m = 0.00025;

Result<void> check(const ScanOptions& o) {
  const auto within = [](double v, double lo, double hi) { return v >= lo && v <= hi; };
  if (!within(o.spacing_m, 5e-5, 0.01) || !within(o.slice_m, 5e-5, 0.01))
    return fail("spacing and slice must lie between 0.05 and 10 mm", "virtual scanner");
  if (!within(o.noise_hu, 0, 1000) || !within(o.psf_m, 0, 0.01))
    return fail("noise must lie between 0 and 1000 HU, the point spread between 0 and 10 mm",
                "virtual scanner");
  for (const double m : {o.cortical_m, o.flesh_m, o.skin_m, o.fat_m})
    if (!within(m, 0, 0.1)) return fail("layers must be 0 to 100 mm thick", "virtual scanner");
  return {};
}

GridFrame frame_around(const Aabb& box_P, const ScanOptions& options) {
  GridFrame frame;
  frame.spacing_m = Vec3(options.spacing_m, options.spacing_m, options.slice_m);
  const Aabb box = box_P.grown(options.flesh_m + 2 * options.spacing_m);
  for (int a = 0; a < 3; ++a)
    frame.size[static_cast<std::size_t>(a)] =
        static_cast<int>(std::ceil(box.extent()[a] / frame.spacing_m[a])) + 1;
  frame.origin_P = box.lo;
  return frame;
}

// Finer cells per voxel along an axis, so that cells are about kFinestCell_m wide.
int cells_for(double spacing_m) {
  return std::clamp(static_cast<int>(std::lround(spacing_m / kFinestCell_m)), 1, 16);
}

void add_noise(Volume& volume, double noise_hu, std::uint64_t seed) {
  Random random(seed);
  for (std::int16_t& hu : volume.values) {
    const double noisy = hu + (noise_hu > 0 ? random.normal(0, noise_hu) : 0);
    hu = static_cast<std::int16_t>(std::lround(std::clamp(noisy, -1024.0, 31000.0)));
  }
}

}  // namespace

Pose scanner_pose_PW() {
  Mat3 R_PW;
  R_PW << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return {Vec3::Zero(), Quat(R_PW)};
}

Result<Volume> virtual_scan(const ScannedBody& scanned, const TissueTable& tissues,
                            const ScanOptions& options) {
  if (auto good = check(options); !good) return tl::unexpected(good.error());
  if (scanned.bones.empty()) return fail("there is no bone to scan", "virtual scanner");
  const auto body = make_scan_body(scanned, tissues, options);
  if (!body) return tl::unexpected(body.error());
  Volume volume;
  volume.frame = frame_around(body->box_P, options);
  if (volume.frame.spacing_m.prod() <= 0 || static_cast<double>(volume.frame.count()) > kMostVoxels)
    return fail("the scan would have more than 1000 million voxels", "virtual scanner",
                "Choose a larger spacing");
  volume.values.resize(volume.frame.count());
  SlabScanner scanner(body->parts, body->air_hu, volume.frame,
                      {cells_for(options.spacing_m), cells_for(options.slice_m)});
  for (int k = 0; k < volume.frame.size[2]; ++k) {
    if (!goes_on(options.progress, "Scanning", static_cast<double>(k) / volume.frame.size[2]))
      return stopped();
    scanner.scan(k, volume.values.data() + volume.frame.index(0, 0, k));
  }
  blur_gaussian(volume, options.psf_m / 2.354820045);
  add_noise(volume, options.noise_hu, options.seed);
  return volume;
}

}  // namespace osteon
