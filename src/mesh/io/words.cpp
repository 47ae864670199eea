#include "io/words.h"

#include <algorithm>
#include <charconv>

namespace osteon {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

template <class T>
bool parse_whole(std::string_view word, T& value) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, ec] = std::from_chars(word.data(), word.data() + word.size(), value);
  return ec == std::errc{} && end == word.data() + word.size();
}

}  // namespace

std::string_view Words::take_word() {
  const std::size_t start = at_;
  while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
  return text_.substr(start, at_ - start);
}

std::string_view Words::next() {
  while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n';
  return take_word();
}

std::string_view Words::next_on_line() {
  while (at_ < text_.size() && text_[at_] != '\n' && is_space(text_[at_])) ++at_;
  return take_word();
}

std::string_view Words::rest_of_line() {
  const std::size_t start = at_;
  at_ = std::min(text_.find('\n', at_), text_.size());
  const std::string_view rest = text_.substr(start, at_ - start);
  if (at_ < text_.size()) {
    ++at_;
    ++line_;
  }
  return rest;
}

bool same_word(std::string_view word, std::string_view lower) {
  return word.size() == lower.size() &&
         std::equal(word.begin(), word.end(), lower.begin(), [](char a, char b) {
           return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
         });
}

bool parse_number(std::string_view word, double& value) { return parse_whole(word, value); }
bool parse_integer(std::string_view word, long long& value) { return parse_whole(word, value); }

}  // namespace osteon
