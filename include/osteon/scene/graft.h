#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "osteon/base/result.h"

namespace osteon {

// A graft of hamstring tendons as a thing that is made: pure functions of measures. What it does
// in a knee: osteon/physics/graft_fixation.h.

inline constexpr std::size_t kGraftTendons = 2;  ///< semitendinosus, gracilis
inline constexpr std::size_t kMostBands = 4;
/// Force of the bench's board that graft creep is measured by: 80 N (K).
inline constexpr double kPretension_n = 80;
inline constexpr double kSizerStep_m = 0.0005, kLeastSizer_m = 0.006, kMostSizer_m = 0.012;
/// So far beyond the cortex a button of 12 mm must come before it can turn.
inline constexpr double kFlipRoom_m = 0.006;

/// A tendon as it lies in the patient.
struct TendonMeasures {
  double length_m = 0;  ///< from the insertion to where the muscle ends
  double area_m2 = 0;   ///< of its cross-section
  std::uint32_t bands = 0;
  std::array<double, kMostBands> bands_m{};  ///< of accessory bands, from the insertion, rising
};

/// Both tendons of a patient. Lengths 289 +- 31 and 277 +- 30 mm; semitendinosus with one or two
/// bands, gracilis with none to three, within 100 mm of the insertion; areas such that 55 % of
/// four-strand grafts measure 8 mm or less (K), 0.3 mm more for 10 cm of height (K,
/// Tuman 2007). A function of the height and the seed. Fails on a height outside of 1.2 to 2.2 m.
Result<std::array<TendonMeasures, kGraftTendons>> tendons_of(double height_m, std::uint64_t seed);

/// A stripped tendon's muscle is off when a blade has scraped over it so far, all strokes together.
inline constexpr double kScrapedClean_m = 0.060;
/// Places along a tendon's end where a whipstitch can go through it, and so far apart.
inline constexpr std::uint32_t kMostStitches = 6;
inline constexpr double kStitchApart_m = 0.004;
/// What one pass of thread holds of the pull on a graft's tail (own estimate: five hold what a
/// board pulls).
inline constexpr double kStitchHolds_n = 25;

/// What a stripper brought out.
struct HarvestedTendon {
  double length_m = 0;
  double area_m2 = 0;  ///< with the muscle that is left on it
  bool amputated = false;
};
/// The same with a share of its muscle left on it, 1: all: a third thicker then (own estimate).
HarvestedTendon with_muscle(HarvestedTendon tendon, double left);
/// `cut`: bit b: band b was cut before the stripper came. Pushed through a band that was not, it
/// cuts the tendon off there.
HarvestedTendon strip(const TendonMeasures& tendon, std::uint32_t cut);

/// A graft ready to be drawn in.
struct Graft {
  double length_m = 0;    ///< of the folded bundle
  double diameter_m = 0;  ///< of the bundle as a round rod
  double sized_m = 0;     ///< smallest tube in steps of 0.5 mm that it passes
  std::uint32_t strands = 0;
};
/// `folds`: strands of each tendon, 1 to 4; 0: it is left out. 10 mm at the muscle's end are
/// trimmed off. The strands fill 0.9 of the bundle's circle (own default). Fails where nothing is
/// folded, and on more folds than 4.
Result<Graft> fold_graft(std::span<const std::optional<HarvestedTendon>> tendons,
                         std::span<const std::uint32_t> folds);
/// The tube in which a bundle goes: the smallest of 6 to 12 mm that is no narrower. 0: none is.
double sizer_for(double diameter_m);

/// What a loop makes of a channel in the femur and of its wide part, the socket.
struct LoopFit {
  double in_socket_m = 0;  ///< of graft, with the button on the cortex
  /// Graft that is drawn to the socket's end leaves the button room to turn.
  bool flips = false;
};
/// in_socket = channel - loop; it flips where in_socket and 6 mm more fit in the socket (EndoButton
/// technique: channel 40, graft 20, loop 20, socket 26 mm).
LoopFit fit_loop(double channel_m, double socket_m, double loop_m);
/// The shortest of 15 to 50 mm in steps of 5 mm with which the button flips: most graft in the
/// socket. 0: none is long enough.
double loop_for(double channel_m, double socket_m);

/// What is left of the creep of a graft that was kept at 80 N for that long, 1: all; by how many
/// cycles of bending under tension it was worked after that. It dies away with 240 s, and with 15
/// cycles (own estimate: most of it goes in the 10 minutes of the bench).
double creep_left(double at_80_n_s, double cycles = 0);

}  // namespace osteon
