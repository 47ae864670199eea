#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "osteon/image/label_tools.h"
#include "segment/slice_plane.h"

namespace osteon {

/// Which Hounsfield units are black and white.
struct GreyWindow {
  double level_hu = 450, width_hu = 1900;  ///< middle and width of what is between
  bool operator==(const GreyWindow&) const = default;
};
inline constexpr GreyWindow kBoneWindow{450, 1900};
inline constexpr GreyWindow kSoftWindow{50, 400};

/// A colour, red in the lowest byte, opaque.
using Rgba = std::uint32_t;

struct SliceLook {
  GreyWindow grey;
  std::optional<HuRange> preview;        ///< tinted where no bone is yet
  std::map<std::uint16_t, Rgba> colors;  ///< of the bones that are shown
  std::uint16_t chosen = 0;              ///< its inside is stronger
  double fill = 0.35;                    ///< how much a bone's colour covers the grey, 0..1
  bool operator==(const SliceLook&) const = default;
};

/// Draws what a pane shows of a slice: grey values between voxels, the bones' colours with their
/// outlines, the threshold's preview. `pixels` comes out with width x height colours, top row
/// first. Costs the pane's pixels, whatever the scan's size.
void draw_slice(const LabelEdit& edit, const SlicePlane& plane, const SliceWindow& window,
                int slice, const SliceLook& look, std::vector<Rgba>& pixels);

}  // namespace osteon
