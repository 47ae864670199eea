#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "osteon/base/types.h"

namespace osteon {

/// Shortest decimal text that reads back as the same double, with a point or an exponent. The
/// same in every locale.
std::string format_number(double value);

/// A length in metres for people: "0.25 mm".
std::string in_mm(double metres);

/// The whole text as a finite number; a leading plus is fine. The same in every locale.
std::optional<double> parse_number(std::string_view text);

/// `q` scaled to unit length, or nothing when it is off by more than 1e-3 or not finite. A
/// quaternion that is of unit length to rounding stays as it is, so that reading what was written
/// changes no bit.
std::optional<Quat> as_unit(const Quat& q);

}  // namespace osteon
