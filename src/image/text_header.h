#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace osteon {

std::string trimmed(std::string_view text);
std::string lower_case(std::string_view text);
/// All numbers of a text in which blanks, commas and brackets part them; none when something else
/// is in it or one is not finite.
std::optional<std::vector<double>> numbers_in(std::string_view text);
/// A whole number of reasonable size.
std::optional<int> whole_number(double value);

/// "key: value" or "key = value" lines with keys in lower case.
using TextHeader = std::map<std::string, std::string>;

}  // namespace osteon
