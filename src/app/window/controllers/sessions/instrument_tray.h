#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osteon/scene/tool_set.h"
#include "runs/hands/live_run.h"
#include "window/hands_model.h"

namespace osteon {

/// Where the instruments of a case's tray are used: "knee" or "wrist".
std::string region_of(const Case& the_case);

/// What the hands of a window's run may take: the wrist probe at place 0, then the instruments of a
/// region of the body in all their sizes. Knows neither window nor picture.
class InstrumentTray {
 public:
  /// The wrist probe alone.
  InstrumentTray();
  /// `wanted`: names as a command line gives them, which come in whatever the region is. Fails on
  /// one that there is not.
  static Result<InstrumentTray> make(const std::string& region,
                                     std::span<const std::string> wanted);

  const RunTray& run() const { return run_; }
  /// None: it is not in the tray. Empty is the wrist probe.
  std::optional<std::uint32_t> find(const std::string& name) const;
  /// `path` with every instrument in a size, as the tray names it: the usual one where it says
  /// none.
  ProbePath sized(ProbePath path) const;
  std::uint32_t next(std::uint32_t place, int steps) const;
  std::uint32_t next_size(std::uint32_t place) const;
  /// "Hook probe, 1.5 mm"
  std::string title(std::uint32_t place) const;
  std::vector<std::string> titles() const;
  const std::vector<Instrument>& instruments() const { return set_.instruments(); }

  /// Comes first in the list from now on.
  void took(std::uint32_t place);
  std::vector<TrayItem> items() const;

 private:
  std::vector<std::uint32_t> usual_first() const;
  TrayItem item(std::uint32_t place) const;

  ToolSet set_;
  RunTray run_;
  std::vector<std::uint32_t> taken_;  ///< the last one first
};

/// A tray and what it was made of. Where it cannot be made it is the wrist probe alone, and
/// `problem` says why.
struct PreparedTray {
  InstrumentTray tray;
  std::string region;
  std::vector<std::string> wanted;
  std::string problem;
};
PreparedTray prepare_tray(const std::string& region, const std::vector<std::string>& wanted);

}  // namespace osteon
