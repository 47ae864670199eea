#include "commands/support/parser.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace osteon::cli {

Range::Range(double least, double most)
    : add([=](CLI::Option& option) { option.check(CLI::Range(least, most)); }) {}
Range::Range(int least, int most)
    : add([=](CLI::Option& option) { option.check(CLI::Range(least, most)); }) {}
Range::Range(std::size_t least, std::size_t most)
    : add([=](CLI::Option& option) { option.check(CLI::Range(least, most)); }) {}

Option* Option::required() {
  option_.required();
  return this;
}

Option* Option::capture_default_str() {
  option_.capture_default_str();
  return this;
}

Option* Option::check(const Range& range) {
  range.add(option_);
  return this;
}

Option* Option::check(const IsMember& words) {
  option_.check(CLI::IsMember(words.words));
  return this;
}

Option* Option::check(std::function<std::string(const std::string&)> complaint) {
  option_.check(std::move(complaint));
  return this;
}

Option* Option::expected(int count) {
  option_.expected(count);
  return this;
}

Option* Option::expected(int least, int most) {
  option_.expected(least, most);
  return this;
}

Option* Option::delimiter(char between) {
  option_.delimiter(between);
  return this;
}

Option* Option::take_all() {
  option_.take_all();
  return this;
}

Option* Option::excludes(Option* other) {
  option_.excludes(&other->option_);
  return this;
}

Option* Option::needs(Option* other) {
  option_.needs(&other->option_);
  return this;
}

std::size_t Option::count() const { return option_.count(); }

App::App(const std::string& description, const std::string& name)
    : own_(std::make_unique<CLI::App>(description, name)), app_(own_.get()) {}
App::App(CLI::App& app) : app_(&app) {}
App::~App() = default;

Option* App::keep(CLI::Option* option) {
  return options_.emplace_back(std::make_unique<Option>(*option)).get();
}

template <class T>
Option* App::add_option(const std::string& names, T& value, const std::string& help) {
  return keep(app_->add_option(names, value, help));
}

Option* App::add_flag(const std::string& names, bool& value, const std::string& help) {
  return keep(app_->add_flag(names, value, help));
}

App* App::add_subcommand(const std::string& name, const std::string& help) {
  return subcommands_.emplace_back(std::make_unique<App>(*app_->add_subcommand(name, help))).get();
}

App* App::get_subcommand(const std::string& name) {
  const CLI::App* wanted = app_->get_subcommand(name);
  for (const auto& sub : subcommands_)
    if (sub->app_ == wanted) return sub.get();
  throw CLI::OptionNotFound(name);
}

App* App::require_subcommand(int least) {
  app_->require_subcommand(least);
  return this;
}

App* App::require_subcommand(int least, int most) {
  app_->require_subcommand(static_cast<std::size_t>(least), static_cast<std::size_t>(most));
  return this;
}

App* App::callback(std::function<void()> run) {
  app_->callback(std::move(run));
  return this;
}

App* App::footer(const std::string& text) {
  app_->footer(text);
  return this;
}

bool App::has_chosen_subcommand() const { return !app_->get_subcommands().empty(); }

void refuse(const std::string& option, const std::string& why) {
  throw CLI::ValidationError(option, why);
}

template Option* App::add_option(const std::string&, bool&, const std::string&);
template Option* App::add_option(const std::string&, int&, const std::string&);
template Option* App::add_option(const std::string&, unsigned&, const std::string&);
template Option* App::add_option(const std::string&, std::size_t&, const std::string&);
template Option* App::add_option(const std::string&, double&, const std::string&);
template Option* App::add_option(const std::string&, std::string&, const std::string&);
template Option* App::add_option(const std::string&, std::filesystem::path&, const std::string&);
template Option* App::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template Option* App::add_option(const std::string&, std::vector<std::filesystem::path>&,
                                 const std::string&);
template Option* App::add_option(const std::string&, std::vector<double>&, const std::string&);
template Option* App::add_option(const std::string&, std::vector<int>&, const std::string&);
template Option* App::add_option(const std::string&, std::optional<double>&, const std::string&);
template Option* App::add_option(const std::string&, std::optional<int>&, const std::string&);
template Option* App::add_option(const std::string&, std::optional<std::uint64_t>&,
                                 const std::string&);
template Option* App::add_option(const std::string&, std::optional<std::string>&,
                                 const std::string&);

}  // namespace osteon::cli
