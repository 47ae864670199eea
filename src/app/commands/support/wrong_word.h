#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace osteon {

/// What is wrong with a command line that could not be read because of a command or an option that
/// is not there, with the nearest one that is; none when it failed for another reason. `words` is
/// the command line without the program's name.
std::optional<std::string> wrong_word(const CLI::App& app, const std::vector<std::string>& words);

/// The name that takes the fewest changes of a letter to get from `word`, at most a third of its
/// letters; of equals the first. Empty when there is none.
std::string nearest_name(const std::string& word, const std::vector<std::string>& names);

}  // namespace osteon
