#include "commands/support/wrong_word.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>

namespace osteon {
namespace {

// Least number of letters put in, left out or exchanged (Levenshtein 1966), row by row: row[j] is
// the count between the letters of `a` so far and the first j of `b`.
std::size_t changes_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t exchanged = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({exchanged, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

const CLI::App* command_named(const CLI::App& app, const std::string& word) {
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    if (sub->get_name() == word) return sub;
  return nullptr;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(sub->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string said(const std::string& command, const std::string& kind, const std::string& word,
                 const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(word, names);
  return "there is no " + kind + " '" + word + "'." +
         (nearest.empty() ? "" : " Did you mean " + nearest + "?") + " See " + command + " --help.";
}

}  // namespace

std::string nearest_name(const std::string& word, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t fewest = word.size() / 3 + 1;
  for (const std::string& name : names)
    if (const std::size_t changes = changes_between(word, name); changes < fewest) {
      fewest = changes;
      nearest = name;
    }
  return nearest;
}

std::optional<std::string> wrong_word(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  std::string name = app.get_name();
  for (const std::string& word : words) {
    if (word.starts_with('-')) {
      const std::string option = word.substr(0, word.find('='));
      if (!option.starts_with("--") || option.size() < 3) continue;
      if (command->get_option_no_throw(option) || app.get_option_no_throw(option)) continue;
      std::vector<std::string> names = option_names(*command);
      for (const std::string& any : option_names(app)) names.push_back(any);
      return said(name, "option", option, names);
    }
    if (const CLI::App* sub = command_named(*command, word)) {
      command = sub;
      name += " " + word;
    } else if (command->get_require_subcommand_min() > 0) {
      return said(name, "command", word, command_names(*command));
    }
  }
  return std::nullopt;
}

}  // namespace osteon
