#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>
#include "commands/support/parser.h"

#include "commands/cases/instrument_text.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/render_options.h"
#include "runs/hands/instrument_sheet.h"

namespace osteon {
namespace {

struct InstrumentOptions {
  std::string folder;  // empty: those that Osteon ships
  bool json = false;
  std::vector<std::string> names;
  std::string size = "1600x1400";
  std::string out;
};

// Those named, in that order; all when none is.
Result<std::vector<Instrument>> chosen(const InstrumentOptions& options) {
  auto all = options.folder.empty() ? load_instruments() : load_instruments(options.folder);
  if (!all || options.names.empty()) return all;
  std::vector<Instrument> out;
  for (const std::string& name : options.names) {
    const Instrument* found = find_instrument(*all, name);
    if (!found)
      return fail("there is no instrument '" + name + "'", "instruments",
                  "See: osteon instruments");
    out.push_back(*found);
  }
  return out;
}

int list(const InstrumentOptions& options) {
  const auto all = chosen(options);
  if (!all) return report_error(all.error());
  if (options.json)
    std::puts(instruments_json(*all).c_str());
  else
    std::fputs(instruments_table(*all).c_str(), stdout);
  return kExitDone;
}

int show(const InstrumentOptions& options) {
  const auto found = chosen(options);
  if (!found) return report_error(found.error());
  if (options.json) {
    std::puts(instruments_json(*found).c_str());
    return kExitDone;
  }
  for (const Instrument& instrument : *found)
    std::fputs(instrument_text(instrument).c_str(), stdout);
  return kExitDone;
}

Result<void> draw(const InstrumentOptions& options) {
  const auto size = parse_picture_size(options.size);
  if (!size) return tl::unexpected(size.error());
  const auto found = chosen(options);
  if (!found) return tl::unexpected(found.error());
  constexpr std::size_t kMostColumns = 7;
  const std::size_t columns = std::min(kMostColumns, found->size());
  const auto image =
      instrument_sheet(sheet_items(*found), static_cast<int>(columns), size->width, size->height);
  if (!image) return tl::unexpected(image.error());
  if (auto saved = save_png(*image, options.out); !saved) return saved;
  std::printf("%zu instruments -> %s, row by row:\n", found->size(), options.out.c_str());
  for (std::size_t i = 0; i < found->size(); ++i)
    std::printf("%s%s", (*found)[i].name.c_str(),
                i % columns + 1 == columns || i + 1 == found->size() ? "\n" : ", ");
  return {};
}

void add_show(cli::App& group, const std::shared_ptr<InstrumentOptions>& options, int& exit_code) {
  cli::App* command = group.add_subcommand("show", "Describe instruments in full");
  command->add_option("names", options->names, "names")->required();
  command->add_flag("--json", options->json, "print JSON");
  command->callback([options, &exit_code] { exit_code = show(*options); });
}

void add_draw(cli::App& group, const std::shared_ptr<InstrumentOptions>& options, int& exit_code) {
  cli::App* command =
      group.add_subcommand("render", "Draw instruments side by side, each with its tip enlarged");
  command->add_option("names", options->names, "names; default: all");
  command->add_option("--size", options->size, "width x height in pixels")->capture_default_str();
  command->add_option("--out", options->out, "PNG file to write")->required();
  command->callback([options, &exit_code] {
    const auto done = draw(*options);
    exit_code = done ? kExitDone : report_error(done.error());
  });
}

}  // namespace

void add_instruments_command(cli::App& app, int& exit_code) {
  const auto options = std::make_shared<InstrumentOptions>();
  cli::App* group = app.add_subcommand(
      "instruments", "List the instruments: what they do, their sizes, power and sources");
  group->add_flag("--json", options->json, "print JSON");
  group->add_option("--folder", options->folder,
                    "folder of instrument files; default: the bundled ones");
  add_show(*group, options, exit_code);
  add_draw(*group, options, exit_code);
  group->callback([options, group, &exit_code] {
    if (!group->has_chosen_subcommand()) exit_code = list(*options);
  });
}

}  // namespace osteon
