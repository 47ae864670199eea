#pragma once

#include "osteon/image/progress.h"
#include "osteon/image/volume.h"

namespace osteon {

/// Blurs in place with a Gaussian of standard deviation `sigma_m` along every axis (sampled, cut at
/// three deviations, rim repeated). Results are rounded to whole HU. Zero leaves the volume alone.
void blur_gaussian(Volume& volume, double sigma_m);

}  // namespace osteon
