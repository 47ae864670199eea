#include "dicom/dicom_stack.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "dicom/dicom_slice.h"
#include "files/raw_values.h"

namespace osteon {
namespace {

// Positions are written with few digits, hence the slack.
constexpr double kSlack_m = 2e-5;
constexpr double kTilt = 0.002;  // sideways shift by slice distance that counts as a tilt
constexpr double kSpacingShare = 0.02;

std::string mm(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f mm", metres * 1000);
  return text;
}

Result<void> check_same(const DicomHeader& first, const DicomHeader& slice) {
  const std::string hint = "Remove the file or choose one series";
  if (slice.rows != first.rows || slice.columns != first.columns)
    return fail("has a different size in pixels from " + first.file.filename().string(),
                slice.file.string(), hint);
  if ((*slice.axes_P - *first.axes_P).cwiseAbs().maxCoeff() > 1e-3)
    return fail("is rotated against " + first.file.filename().string(), slice.file.string(), hint);
  if (std::abs(slice.spacing_i_m - first.spacing_i_m) > 1e-6 ||
      std::abs(slice.spacing_j_m - first.spacing_j_m) > 1e-6)
    return fail("has a different pixel spacing from " + first.file.filename().string(),
                slice.file.string(), hint);
  return {};
}

/// Distance of neighbouring slices along the normal, which must be even.
Result<double> slice_distance(const std::vector<DicomHeader>& slices, const Vec3& normal_P) {
  std::vector<double> gaps;
  for (std::size_t k = 1; k < slices.size(); ++k)
    gaps.push_back(normal_P.dot(*slices[k].position_P - *slices[k - 1].position_P));
  std::vector<double> sorted = gaps;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[sorted.size() / 2];
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    const std::string between =
        slices[k].file.filename().string() + " and " + slices[k + 1].file.filename().string();
    const std::string folder = slices[k].file.parent_path().string();
    if (gaps[k] < kSlack_m)
      return fail(between + " show the same position", folder,
                  "Remove the doubled slices or choose one series");
    if (gaps[k] > 1.5 * usual)
      return fail("slices are missing between " + between + ": " + mm(gaps[k]) + " apart, " +
                      mm(usual) + " elsewhere",
                  folder, "Copy the whole series");
    if (std::abs(gaps[k] - usual) > std::max(kSlack_m, kSpacingShare * usual))
      return fail("slices are unevenly spaced: " + between + " are " + mm(gaps[k]) +
                      " apart, others " + mm(usual),
                  folder, "Reconstruct the series with even spacing");
  }
  return (normal_P.dot(*slices.back().position_P - *slices.front().position_P)) /
         static_cast<double>(gaps.size());
}

void find_tilt(DicomStack& stack) {
  const Mat3& R = stack.frame.axes_P;
  double widest = 0;
  for (const DicomHeader& slice : stack.slices) {
    const Vec3 aside = R.transpose() * (*slice.position_P - stack.frame.origin_P);
    stack.shift_m.push_back({aside.x(), aside.y()});
    widest = std::max({widest, std::abs(aside.x()), std::abs(aside.y())});
  }
  const double height = stack.frame.spacing_m.z() * static_cast<double>(stack.slices.size() - 1);
  stack.tilted = widest > kTilt * height && widest > kSlack_m;
}

}  // namespace

Result<void> check_slice(const DicomHeader& slice) {
  const std::string file = slice.file.string();
  if (slice.modality != "CT")
    return fail("is of modality '" + slice.modality + "', not CT", file,
                "CT is needed, because bone is found by its Hounsfield units");
  if (slice.frames != 1)
    return fail("holds " + std::to_string(slice.frames) + " frames in one file", file,
                "Export the series as one file per slice");
  if (slice.rows < 2 || slice.columns < 2)
    return fail("does not give its size in pixels", file, "Export the series again");
  if (slice.rows > kWidestSlice || slice.columns > kWidestSlice)
    return fail("is " + std::to_string(slice.columns) + " x " + std::to_string(slice.rows) +
                    " pixels large, more than any scanner makes",
                file, "Export the series again");
  if (!slice.position_P || !slice.axes_P)
    return fail("does not give its slice position", file,
                "Export the series with image position and orientation");
  const auto sane = [](double s) { return s >= 1e-5 && s <= 0.02; };
  if (!sane(slice.spacing_i_m) || !sane(slice.spacing_j_m))
    return fail("has no usable pixel spacing", file, "Export the series with its pixel spacing");
  if (!slice.has_rescale)
    return fail("has no rescale slope and intercept", file,
                "Export the original CT series, not a derived one");
  return {};
}

Result<DicomStack> stack_slices(std::vector<DicomHeader> slices, const std::string& where) {
  if (slices.size() < 2)
    return fail("holds a single slice", where, "Name a series of at least two slices");
  for (const DicomHeader& slice : slices) {
    if (auto sound = check_slice(slice); !sound) return tl::unexpected(sound.error());
    if (auto same = check_same(slices.front(), slice); !same) return tl::unexpected(same.error());
  }
  DicomStack stack;
  const Mat3 R = *slices.front().axes_P;
  const Vec3 normal_P = R.col(2);
  std::stable_sort(slices.begin(), slices.end(), [&](const auto& a, const auto& b) {
    return normal_P.dot(*a.position_P) < normal_P.dot(*b.position_P);
  });
  const auto distance = slice_distance(slices, normal_P);
  if (!distance) return tl::unexpected(distance.error());
  const DicomHeader& first = slices.front();
  stack.frame.size = {first.columns, first.rows, static_cast<int>(slices.size())};
  stack.frame.spacing_m = Vec3(first.spacing_i_m, first.spacing_j_m, *distance);
  stack.frame.origin_P = *first.position_P;
  stack.frame.axes_P = R;
  if (auto sane = check_size(stack.frame, where); !sane) return tl::unexpected(sane.error());
  stack.slices = std::move(slices);
  find_tilt(stack);
  return stack;
}

}  // namespace osteon
