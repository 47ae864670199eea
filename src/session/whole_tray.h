#pragma once

#include <memory>
#include <utility>

#include "osteon/session/session.h"

namespace osteon {

/// An empty tray holds the wrist probe alone.
inline Tray whole_tray(Tray tray, const SessionSettings& settings) {
  if (tray.empty())
    tray.push_back(std::make_shared<const Tool>(make_wrist_probe(settings.probe_radius_m)));
  return tray;
}

}  // namespace osteon
