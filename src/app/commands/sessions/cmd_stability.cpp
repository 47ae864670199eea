#include <cstdio>
#include <memory>
#include <string>
#include "commands/support/parser.h"

#include "commands/sessions/stability_map.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

struct StabilityOptions {
  std::string out = "stability.svg";
  int cells = 24;
};

struct NamedHand {
  const char* name;
  HandParams hand;
};

// The loosest hand, a usual one, and the heaviest firm one.
constexpr NamedHand kHands[] = {
    {"0.05 kg, 50 N/m, 2 N s/m", {0.05, 50, 2}},
    {"0.15 kg, 500 N/m, 12 N s/m", {0.15, 500, 12}},
    {"0.5 kg, 1500 N/m, 5 N s/m", {0.5, 1500, 5}},
};

struct NamedGuard {
  const char* name;
  LoopGuard guard;
};

constexpr NamedGuard kGuards[] = {{"no passivity stage", LoopGuard::kNone},
                                  {"observer and damping", LoopGuard::kObserverAndDamping},
                                  {"full passivity stage", LoopGuard::kAll}};

int run_stability(const StabilityOptions& options) {
  std::vector<StabilityMap> maps;
  int swinging_with_all = 0;
  for (const NamedHand& hand : kHands)
    for (const NamedGuard& guard : kGuards) {
      StabilityMap map = map_stability(hand.hand, guard.guard, options.cells, options.cells);
      map.title = std::string(hand.name) + ": " + guard.name;
      std::printf("%-50s oscillates in %4d of %zu\n", map.title.c_str(), map.swinging(),
                  map.outcomes.size());
      std::fflush(stdout);
      if (guard.guard == LoopGuard::kAll) swinging_with_all += map.swinging();
      maps.push_back(std::move(map));
    }
  if (auto ok = write_file_atomic(options.out, to_svg(maps, std::size(kGuards))); !ok)
    return report_error(ok.error());
  std::printf("wrote %s\n", options.out.c_str());
  return swinging_with_all == 0 ? kExitDone : kExitNo;
}

}  // namespace

void add_stability_command(cli::App& app, int& exit_code) {
  const auto options = std::make_shared<StabilityOptions>();
  cli::App* command = app.add_subcommand(
      "stability",
      "Press emulated hands against virtual walls and plot where the loop oscillates (SVG); exits "
      "1 when it oscillates with the full passivity stage");
  command->add_option("--out", options->out, "SVG file to write")->capture_default_str();
  command->add_option("--cells", options->cells, "cells along each side of a map")
      ->check(cli::Range(2, 200))
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = run_stability(*options); });
}

}  // namespace osteon
