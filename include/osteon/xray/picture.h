#pragma once

#include <cstdint>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/xray/areal_density.h"

namespace osteon {

/// Photons that leave the tube, by energy.
struct XraySpectrum {
  struct Bin {
    double energy_kev = 0;
    double share = 0;  ///< of the photons; all shares are 1 together
  };
  std::vector<Bin> bins;
};
/// Bremsstrahlung of a tungsten anode (Kramers' law: as many photons as kV / E - 1) behind
/// `filter_mm` of aluminium, without the anode's own lines. 40 to 120 kV.
Result<XraySpectrum> tube_spectrum(double kv, double filter_mm = 3.5);

/// Energy that reaches each pixel as a share of what reaches it when nothing is in the way, without
/// scatter: sum over energies of share E exp(-sum of mu/rho times areal density).
std::vector<float> transmitted(const ArealDensity& density, const XraySpectrum& spectrum);

struct XrayDetector {
  double photons = 1e4;  ///< at a pixel that nothing covers
  bool noise = true;     ///< Poisson, of the photons that a pixel catches
  bool blur = true;      ///< 3x3: light spreads to the neighbours (1 2 1 by 1 2 1, / 16)
  std::uint64_t seed = 1;
};
/// What the detector makes of the transmitted shares (rows of `width`).
std::vector<float> detected(const std::vector<float>& transmitted, int width,
                            const XrayDetector& detector);

/// Automatic brightness: darkest and brightest signal that a picture shows. Signals between are
/// shown by their logarithm, so that grey tells attenuation.
struct XrayWindow {
  double dark = 0.01, bright = 1;
};
/// From the pixels that tissue covers and no metal, nor next to metal, whose shade spreads: all but
/// the lowest and highest half per cent. So bone stays easy to see beside an instrument. Where
/// there is metal, a seventh of the greys is left for it, darker than all tissue. From metal where
/// there is nothing else; the default when nothing is covered. `signal` is one value for each pixel
/// of `density`.
XrayWindow automatic_window(const std::vector<float>& signal, const ArealDensity& density);
/// 0: the window's dark end and below, 1: its bright end and above.
std::vector<float> shown(const std::vector<float>& signal, const XrayWindow& window);

}  // namespace osteon
