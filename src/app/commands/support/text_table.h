#pragma once

#include <string>
#include <vector>

namespace osteon {

/// Columns for a terminal: cells of a column padded to equal width, two blanks between columns.
/// The first row is underlined.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) { rows_.push_back(std::move(header)); }
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  /// Columns whose cells all begin with a digit or '-' (but for the header) are right-aligned.
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// "12.35": fixed digits after the point.
std::string fixed(double value, int digits);

}  // namespace osteon
