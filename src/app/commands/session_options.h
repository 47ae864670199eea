#pragma once

#include "osteon/device/virtual_hand.h"
#include "osteon/session/session.h"

namespace osteon::cli {
class App;
}

namespace osteon {

/// Options that every command with a session shares, with their defaults.
struct SessionOptions {
  SessionSettings settings;
  HandParams hand;
  bool free_bones = false;

  void add_to(cli::App& command);
  /// Settings after parsing.
  SessionSettings resolved() const;
};

}  // namespace osteon
