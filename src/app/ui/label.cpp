#include "ui/label.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace osteon {
namespace {

constexpr std::array<std::string_view, 7> kAbbreviations = {"tfcc", "acl", "pcl", "mcl",
                                                            "lcl",  "al",  "am"};

char upper(char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); }

}  // namespace

std::string label_of(const std::string& name) {
  std::string label = name;
  std::replace(label.begin(), label.end(), '_', ' ');
  if (label.empty()) return label;
  label[0] = upper(label[0]);
  for (std::size_t begin = 0; begin < label.size();) {
    const std::size_t end = std::min(label.find(' ', begin), label.size());
    const std::string word = name.substr(begin, end - begin);
    if (std::find(kAbbreviations.begin(), kAbbreviations.end(), word) != kAbbreviations.end())
      for (std::size_t i = begin; i < end; ++i) label[i] = upper(label[i]);
    begin = end + 1;
  }
  return label;
}

}  // namespace osteon
