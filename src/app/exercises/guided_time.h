#pragma once

#include <string>
#include <string_view>

#include "osteon/base/result.h"

namespace osteon {

/// How long a hand was led along an expert's way, as a recording's note: "12.25 s".
std::string guided_text(double seconds);
/// 0 of an empty text. Fails on what is not such a text.
Result<double> parse_guided(std::string_view text, const std::string& where);

}  // namespace osteon
