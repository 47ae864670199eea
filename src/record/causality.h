#pragma once

#include "osteon/record/recording.h"

namespace osteon {

/// Drops from an incomplete recording the ticks and steps at its end that consumed something that
/// was not saved any more.
void trim_to_saved(Recording& recording);

}  // namespace osteon
