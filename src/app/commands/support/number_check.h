#pragma once

#include <string>

namespace CLI {
class App;
}

namespace osteon {

/// Gives every option of a command and of its subcommands that takes a number one more check: it
/// must be a whole finite number, without a sign where it counts something, and small enough to be
/// held. Call it when all options are there.
void check_all_numbers(CLI::App& command);

/// For `CLI::Option::check`: what is wrong with the text, empty when nothing is. NaN is refused.
std::string refuse_negative(const std::string& text);
std::string refuse_not_positive(const std::string& text);

}  // namespace osteon
