#pragma once

#include <cstddef>
#include <cstdint>

namespace osteon {

/// What weakens X-rays, by its elements: how much of it there is tells the density.
enum class XraySubstance : std::uint8_t { kSoft, kBone, kTitanium, kIron };
inline constexpr std::size_t kXraySubstances = 4;

struct XrayMaterial {
  XraySubstance substance = XraySubstance::kSoft;
  double density_g_per_cm3 = 1;
};

/// Density of a tissue of this CT number, g/cm3, never below 0 (Unberath et al., DeepDRR, MICCAI
/// 2018): two straight lines that meet at water.
double density_from_hu(double hu);
/// Bone from 350 HU on, below it soft tissue (the same source).
XrayMaterial material_of_hu(double hu);
/// Ti-6Al-4V and stainless steel 316L, as implants and instruments are made of them.
inline constexpr XrayMaterial kTitaniumAlloy = {XraySubstance::kTitanium, 4.43};
inline constexpr XrayMaterial kSteel = {XraySubstance::kIron, 7.99};

/// Mass attenuation coefficient mu/rho, cm2/g, of photons of this energy, 10 to 150 keV; beyond it
/// that of the end. From the table of Hubbell and Seltzer (NISTIR 5632), straight between its rows
/// in log-log.
double mass_attenuation_cm2_per_g(XraySubstance substance, double energy_kev);
/// The same of aluminium, which tubes are filtered with.
double aluminium_attenuation_cm2_per_g(double energy_kev);

}  // namespace osteon
