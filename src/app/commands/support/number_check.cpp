#include "commands/support/number_check.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace osteon {
namespace {

template <class Number>
std::optional<Number> read_whole(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number value{};
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = read.ec == std::errc{} && read.ptr == text.data() + text.size();
  return whole ? std::optional<Number>(value) : std::nullopt;
}

std::string quoted(const std::string& text) { return "'" + text + "'"; }

std::string refuse_not_finite(const std::string& text) {
  const auto value = read_whole<double>(text);
  return value && std::isfinite(*value) ? "" : quoted(text) + " is not a finite number";
}

std::string refuse_not_whole(const std::string& text) {
  return read_whole<std::int64_t>(text) ? "" : quoted(text) + " is not a whole number";
}

std::string refuse_not_count(const std::string& text) {
  return read_whole<std::uint64_t>(text) ? ""
                                         : quoted(text) + " is not a whole number of 0 or more";
}

}  // namespace

std::string refuse_negative(const std::string& text) {
  const auto value = read_whole<double>(text);
  return value && *value >= 0 ? "" : quoted(text) + " is not a number of 0 or more";
}

std::string refuse_not_positive(const std::string& text) {
  const auto value = read_whole<double>(text);
  return value && *value > 0 ? "" : quoted(text) + " is not a number above 0";
}

void check_all_numbers(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();
    if (type.starts_with("FLOAT")) option->check(refuse_not_finite);
    if (type.starts_with("INT")) option->check(refuse_not_whole);
    if (type.starts_with("UINT")) option->check(refuse_not_count);
  }
  for (CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; }))
    check_all_numbers(*sub);
}

}  // namespace osteon
