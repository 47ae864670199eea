#include "commands/support/text_table.h"

#include <algorithm>
#include <cstdio>

namespace osteon {
namespace {

// Code points, not bytes: names may hold umlauts.
std::size_t width_of(const std::string& cell) {
  return static_cast<std::size_t>(std::count_if(cell.begin(), cell.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

bool is_numeric(const std::string& cell) {
  return !cell.empty() && (cell[0] == '-' || (cell[0] >= '0' && cell[0] <= '9'));
}

struct Column {
  std::size_t width = 0;
  bool right = true;
};

std::string line_of(const std::vector<std::string>& row, const std::vector<Column>& columns) {
  std::string line;
  for (std::size_t c = 0; c < row.size(); ++c) {
    const std::string padding(columns[c].width - width_of(row[c]), ' ');
    if (c > 0) line += "  ";
    line += columns[c].right ? padding + row[c] : row[c] + padding;
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

}  // namespace

std::string TextTable::text() const {
  std::vector<Column> columns(rows_.front().size());
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t c = 0; c < rows_[r].size(); ++c) {
      columns[c].width = std::max(columns[c].width, width_of(rows_[r][c]));
      if (r > 0) columns[c].right = columns[c].right && is_numeric(rows_[r][c]);
    }
  }
  std::size_t total = 2 * (columns.size() - 1);
  for (const Column& column : columns) total += column.width;
  std::string out = line_of(rows_.front(), columns) + std::string(total, '-') + "\n";
  for (std::size_t r = 1; r < rows_.size(); ++r) out += line_of(rows_[r], columns);
  return out;
}

std::string fixed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

}  // namespace osteon
