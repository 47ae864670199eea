#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "osteon/base/result.h"
#include "osteon/scene/case.h"

namespace osteon {

struct CarvingSetup;

/// How bone is removed in a session.
struct CarveSettings {
  bool on = false;
  double cell_m = 0.00025;   ///< of the fields; twice as much for a bone longer than 200 mm
  double cortex_m = 0.0012;  ///< tissue by depth, as `osteon carve` has it
  double marrow_m = 0;
  double thrust_scale = 20;          ///< see CarvingSetup
  double guided_n = 0;               ///< likewise
  double irrigation_ml_per_min = 0;  ///< of water over the bone that is cut
  friend bool operator==(const CarveSettings&, const CarveSettings&) = default;
};

/// Whether anything of a session can be carved: an instrument whose file says how it removes bone
/// (Instrument::removal), named as a tray does ("drill", "microdrill:4"), and a bone felt as a
/// field. False where the instruments cannot be read.
bool can_carve(const Case& the_case, std::span<const std::string> tray);

/// Runs tasks 0 .. count - 1 in any order, on any threads.
using RunFieldTasks =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// Makes the fields of all bones that are felt as fields, and the cutters of the tray. Null when
/// `settings` say off. Fails when a bone's mesh is not closed, an instrument has not that size, or
/// a file of the assets cannot be read.
Result<std::shared_ptr<const CarvingSetup>> make_carving(const Case& the_case,
                                                         std::span<const std::string> tray,
                                                         const CarveSettings& settings,
                                                         const RunFieldTasks& run = {});

}  // namespace osteon
