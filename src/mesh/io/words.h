#pragma once

#include <cstddef>
#include <string_view>

namespace osteon {

/// Blank-separated words of a text, with the line that each stands on.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// Empty at the end of the text.
  std::string_view next();
  /// Empty at the end of the line, which is not passed.
  std::string_view next_on_line();
  /// The rest of the line; passes its end.
  std::string_view rest_of_line();

  bool at_end() const { return at_ >= text_.size(); }
  /// Of the last word, counted from 1.
  std::size_t line() const { return line_; }
  std::size_t offset() const { return at_; }

 private:
  std::string_view take_word();

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

/// Equal to `lower`, in upper or lower case.
bool same_word(std::string_view word, std::string_view lower);

/// The whole word as a number, the same in every locale; a leading plus is fine.
bool parse_number(std::string_view word, double& value);
bool parse_integer(std::string_view word, long long& value);

}  // namespace osteon
