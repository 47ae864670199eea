#include "html_page.h"

#include <charconv>

namespace osteon {

std::string tenths(double value) {
  char digits[64];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, 1).ptr;
  return std::string(digits, end);
}

std::string html_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string svg_line(double x1, double y1, double x2, double y2, const char* look) {
  return "<line x1=\"" + tenths(x1) + "\" y1=\"" + tenths(y1) + "\" x2=\"" + tenths(x2) +
         "\" y2=\"" + tenths(y2) + "\" class=\"" + look + "\"/>";
}
std::string svg_text(double x, double y, const std::string& text) {
  return "<text x=\"" + tenths(x) + "\" y=\"" + tenths(y) + "\">" + html_text(text) + "</text>";
}

std::string html_row(const std::vector<std::string>& cells, const char* tag) {
  std::string row = "<tr>";
  for (const std::string& cell : cells)
    row += "<" + std::string(tag) + ">" + html_text(cell) + "</" + tag + ">";
  return row + "</tr>\n";
}

std::string shown_name(const std::string& learner, const LearnerNames& names) {
  const auto it = names.find(learner);
  return it == names.end() ? learner : it->second + " (" + learner + ")";
}

}  // namespace osteon
