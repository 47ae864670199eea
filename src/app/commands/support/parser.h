#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// What commands need of CLI11, compiled once: its templates take 15 s in every source that
/// includes it. Names and meaning are CLI11's own.
namespace osteon::cli {

/// From `least` to `most`, both taken.
struct Range {
  Range(double least, double most);
  Range(int least, int most);
  Range(std::size_t least, std::size_t most);
  std::function<void(CLI::Option&)> add;  ///< puts the check on an option
};

/// One of some words.
struct IsMember {
  explicit IsMember(std::vector<std::string> some) : words(std::move(some)) {}
  std::vector<std::string> words;
};

class Option {
 public:
  explicit Option(CLI::Option& option) : option_(option) {}

  Option* required();
  Option* capture_default_str();
  Option* check(const Range& range);
  Option* check(const IsMember& words);
  /// What is wrong with the text, empty when nothing is.
  Option* check(std::function<std::string(const std::string&)> complaint);
  Option* expected(int count);
  Option* expected(int least, int most);
  Option* delimiter(char between);
  Option* take_all();
  Option* excludes(Option* other);
  Option* needs(Option* other);
  std::size_t count() const;  ///< how often it was given

 private:
  CLI::Option& option_;
};

class App {
 public:
  App(const std::string& description, const std::string& name);
  explicit App(CLI::App& app);  ///< stays the owner's
  ~App();
  App(App&&) = delete;

  /// `T`: bool, int, an unsigned number, double, std::string, std::filesystem::path, a vector of
  /// these, or an optional of one; parser.cpp names those that are compiled.
  template <class T>
  Option* add_option(const std::string& names, T& value, const std::string& help = "");
  Option* add_flag(const std::string& names, bool& value, const std::string& help = "");
  App* add_subcommand(const std::string& name, const std::string& help);
  App* get_subcommand(const std::string& name);  ///< an added one; throws where there is none
  App* require_subcommand(int least);
  App* require_subcommand(int least, int most);
  App* callback(std::function<void()> run);
  App* footer(const std::string& text);
  bool has_chosen_subcommand() const;  ///< to be asked by a callback

  CLI::App& parser() { return *app_; }

 private:
  Option* keep(CLI::Option* option);

  std::unique_ptr<CLI::App> own_;
  CLI::App* app_;
  std::vector<std::unique_ptr<App>> subcommands_;
  std::vector<std::unique_ptr<Option>> options_;
};

/// For a callback: ends the program as a bad command line does.
[[noreturn]] void refuse(const std::string& option, const std::string& why);

}  // namespace osteon::cli
