#pragma once

#include <string>
#include <vector>

#include "osteon/results/names.h"

namespace osteon {

/// A number with one digit behind the point, the same in every locale.
std::string tenths(double value);
/// Text as HTML holds it.
std::string html_text(const std::string& text);
std::string html_row(const std::vector<std::string>& cells, const char* tag);
/// `look`: its class.
std::string svg_line(double x1, double y1, double x2, double y2, const char* look);
std::string svg_text(double x, double y, const std::string& text);
/// "Ada Lovelace (ada)", or the id alone.
std::string shown_name(const std::string& learner, const LearnerNames& names);

}  // namespace osteon
