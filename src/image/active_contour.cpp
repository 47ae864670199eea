#include "osteon/image/active_contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "osteon/image/segment.h"

namespace osteon {
namespace {

constexpr int kMargin = 6;  // voxels about a label in which its outline may move

/// The pull of the edges at every voxel of a slice: downhill on g = 1 / (1 + (slope / edge)^2).
struct EdgePull {
  cv::Mat x, y;
};

EdgePull pull_of(const cv::Mat& slice_hu, const ContourOptions& options) {
  cv::Mat blurred = slice_hu;
  if (options.blur_voxels > 0)
    cv::GaussianBlur(slice_hu, blurred, {}, options.blur_voxels, 0, cv::BORDER_REPLICATE);
  constexpr double kSobelSum = 8;  // weights of the operator: the result is a slope a voxel
  cv::Mat dx, dy, g(slice_hu.size(), CV_32F);
  cv::Sobel(blurred, dx, CV_32F, 1, 0, 3, 1 / kSobelSum, 0, cv::BORDER_REPLICATE);
  cv::Sobel(blurred, dy, CV_32F, 0, 1, 3, 1 / kSobelSum, 0, cv::BORDER_REPLICATE);
  const auto edge2 = static_cast<float>(options.edge_hu * options.edge_hu);
  for (int r = 0; r < g.rows; ++r)
    for (int c = 0; c < g.cols; ++c) {
      const float sx = dx.at<float>(r, c), sy = dy.at<float>(r, c);
      g.at<float>(r, c) = 1 / (1 + (sx * sx + sy * sy) / edge2);
    }
  EdgePull pull;
  cv::Sobel(g, pull.x, CV_32F, 1, 0, 3, 1 / kSobelSum, 0, cv::BORDER_REPLICATE);
  cv::Sobel(g, pull.y, CV_32F, 0, 1, 3, 1 / kSobelSum, 0, cv::BORDER_REPLICATE);
  return pull;
}

/// The outline follows the pull: voxels beside it join or leave.
void attract(const EdgePull& pull, cv::Mat& inside) {
  const cv::Mat u = inside.clone();
  for (int r = 1; r + 1 < u.rows; ++r)
    for (int c = 1; c + 1 < u.cols; ++c) {
      const int ux = u.at<std::uint8_t>(r, c + 1) - u.at<std::uint8_t>(r, c - 1);
      const int uy = u.at<std::uint8_t>(r + 1, c) - u.at<std::uint8_t>(r - 1, c);
      const float along = pull.x.at<float>(r, c) * static_cast<float>(ux) +
                          pull.y.at<float>(r, c) * static_cast<float>(uy);
      if (along > 0) inside.at<std::uint8_t>(r, c) = 1;
      if (along < 0) inside.at<std::uint8_t>(r, c) = 0;
    }
}

/// Short straight lines in four directions.
const std::array<cv::Mat, 4>& lines() {
  static const std::array<cv::Mat, 4> four = {
      (cv::Mat_<std::uint8_t>(3, 3) << 0, 0, 0, 1, 1, 1, 0, 0, 0),
      (cv::Mat_<std::uint8_t>(3, 3) << 0, 1, 0, 0, 1, 0, 0, 1, 0),
      (cv::Mat_<std::uint8_t>(3, 3) << 1, 0, 0, 0, 1, 0, 0, 0, 1),
      (cv::Mat_<std::uint8_t>(3, 3) << 0, 0, 1, 0, 1, 0, 1, 0, 0)};
  return four;
}

/// Keeps what a line fits into; takes off spikes.
cv::Mat largest_of_erosions(const cv::Mat& u) {
  cv::Mat out, one;
  for (const cv::Mat& line : lines()) {
    cv::erode(u, one, line);
    out = out.empty() ? one.clone() : cv::max(out, one);
  }
  return out;
}

/// The same of the outside; fills notches.
cv::Mat least_of_dilations(const cv::Mat& u) {
  cv::Mat out, one;
  for (const cv::Mat& line : lines()) {
    cv::dilate(u, one, line);
    out = out.empty() ? one.clone() : cv::min(out, one);
  }
  return out;
}

/// Curvature motion; the order of its halves changes from round to round, or it would drift.
void smooth(int round, cv::Mat& u) {
  u = round % 2 == 0 ? largest_of_erosions(least_of_dilations(u))
                     : least_of_dilations(largest_of_erosions(u));
}

/// One label in one slice, cut out of the volume.
struct LabelSlice {
  cv::Mat hu, inside, barred;  ///< barred: voxels of other labels
  int i0 = 0, j0 = 0, k = 0;
};

LabelSlice cut_out(const Volume& volume, const LabelVolume& labels, std::uint16_t label,
                   const VoxelBox& box, int k) {
  LabelSlice out{{}, {}, {}, box.lo[0], box.lo[1], k};
  const cv::Size size(box.hi[0] - box.lo[0], box.hi[1] - box.lo[1]);
  out.hu.create(size, CV_32F);
  out.inside.create(size, CV_8U);
  out.barred.create(size, CV_8U);
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c) {
      const std::uint16_t there = labels.at(box.lo[0] + c, box.lo[1] + r, k);
      out.hu.at<float>(r, c) = volume.at(box.lo[0] + c, box.lo[1] + r, k);
      out.inside.at<std::uint8_t>(r, c) = there == label;
      out.barred.at<std::uint8_t>(r, c) = there != 0 && there != label;
    }
  return out;
}

void evolve(const ContourOptions& options, LabelSlice& slice) {
  const EdgePull pull = pull_of(slice.hu, options);
  int round = 0;
  for (int step = 0; step < options.steps; ++step) {
    const cv::Mat before = slice.inside.clone();
    attract(pull, slice.inside);
    for (int n = 0; n < options.smoothing; ++n) smooth(round++, slice.inside);
    slice.inside.setTo(0, slice.barred);
    if (cv::countNonZero(before != slice.inside) == 0) return;
  }
}

void put_back(const LabelSlice& slice, std::uint16_t label, LabelVolume& labels,
              ContourChange& change) {
  for (int r = 0; r < slice.inside.rows; ++r)
    for (int c = 0; c < slice.inside.cols; ++c) {
      std::uint16_t& there = labels.at(slice.i0 + c, slice.j0 + r, slice.k);
      const bool now = slice.inside.at<std::uint8_t>(r, c) != 0;
      if (now && there == 0) {
        there = label;
        ++change.gained;
      } else if (!now && there == label) {
        there = 0;
        ++change.lost;
      }
    }
}

bool sound(const ContourOptions& o) {
  return o.steps >= 0 && o.steps <= 1000 && o.smoothing >= 0 && o.smoothing <= 10 &&
         o.blur_voxels >= 0 && o.blur_voxels <= 20 && o.edge_hu > 0 && std::isfinite(o.edge_hu);
}

}  // namespace

Result<ContourChange> refine_contours(const Volume& volume, LabelVolume& labels,
                                      const ContourOptions& options, const Progress& progress) {
  if (labels.frame.size != volume.frame.size || labels.values.size() != volume.values.size())
    return fail("labels and scan differ in size", "active contour");
  if (!sound(options))
    return fail("an option is out of range", "active contour",
                "0 to 1000 steps, 0 to 10 rounds of smoothing, a blur of 0 to 20 voxels, an edge "
                "above 0 HU");
  ContourChange change;
  const std::vector<Region> regions = measure_regions(labels);
  for (std::size_t n = 0; n < regions.size(); ++n) {
    if (!goes_on(progress, "Drawing contours",
                 static_cast<double>(n) / static_cast<double>(regions.size())))
      return stopped();
    const VoxelBox box = grown(regions[n].box, kMargin, labels.frame);
    for (int k = regions[n].box.lo[2]; k < regions[n].box.hi[2]; ++k) {
      LabelSlice slice = cut_out(volume, labels, regions[n].label, box, k);
      evolve(options, slice);
      put_back(slice, regions[n].label, labels, change);
    }
  }
  return change;
}

}  // namespace osteon
