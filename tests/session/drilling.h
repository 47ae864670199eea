#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "osteon/physics/carving.h"
#include "osteon/physics/carving_setup.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/tool_set.h"
#include "session_fixtures.h"

namespace osteon::testing {

inline constexpr double kTop_m = 0.004;  ///< of the block

inline std::shared_ptr<const Case> drilled_block() {
  CaseDef def;
  def.name = "block";
  BoneDef bone;
  bone.name = "block";
  bone.mesh = box_mesh(Vec3(0.005, 0.005, kTop_m));
  bone.felt = Felt::kField;
  def.bones.push_back(bone);
  auto built = build_case(std::move(def));
  EXPECT_TRUE(built);
  return std::make_shared<const Case>(std::move(*built));
}

/// A session with one instrument on a block that is felt as a field.
struct Drilling {
  std::shared_ptr<const Case> the_case = drilled_block();
  SessionSettings settings;
  Tray tray;
  std::shared_ptr<const CarvingSetup> setup;

  explicit Drilling(const std::string& instrument = "drill:3.2") {
    settings.carve.on = true;
    settings.carve.cell_m = 0.0004;
    settings.haptic.max_force_n = 8;
    also(instrument);
  }
  /// Puts one more instrument into the tray.
  void also(const std::string& instrument) {
    settings.tray.push_back(instrument);
    const auto all = load_instruments();
    EXPECT_TRUE(all);
    const auto name = parse_tool_name(instrument);
    const Instrument* found = find_instrument(*all, name->name);
    tray.push_back(std::make_shared<const Tool>(
        make_tool(*found, *find_size(*found, name->size_mm.value_or(3.2)))));
    auto made = make_carving(*the_case, settings.tray, settings.carve);
    EXPECT_TRUE(made);
    setup = *made;
  }
  template <class Change>
  void with(const Change& change) {
    auto changed = std::make_shared<CarvingSetup>(*setup);
    change(*changed);
    setup = std::move(changed);
  }
  Session session() const { return Session(the_case, settings, tray, setup); }
};

/// Straight down on the block's top from 1 mm above, `speed` fast, to `deepest` under it.
inline HandInput down_at(std::uint64_t n, double power, double speed = 0.02,
                         double deepest = 0.003) {
  HandInput hand;
  const double z = std::max(0.001 - speed * 0.001 * static_cast<double>(n), -deepest);
  hand.input.X_WD.p = {0.0003, 0.0002, kTop_m + z};
  if (n == 2) hand.command = {CommandKind::kPower, power};
  return hand;
}

}  // namespace osteon::testing
