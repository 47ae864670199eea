#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "osteon/base/result.h"

namespace osteon {

/// What a user types while devices run: "on left", "off", "on 2".
struct ForceOrder {
  bool on = false;
  std::optional<std::size_t> hand;  ///< none: every hand
};

/// `names`: of the hands, in their order; a hand may also be named by its number from 1 on. Fails
/// on anything else, and says what there is.
Result<ForceOrder> parse_force_order(std::string_view line, std::span<const std::string> names);

/// Lines from the standard input, without ever waiting for one.
class InputLines {
 public:
  /// The next whole line; none: there is none yet. After the input's end, or where it is not this
  /// program's turn to read (in the background of a terminal), never one.
  std::optional<std::string> next();

 private:
  bool read_some();
  std::string waiting_;
  bool ended_ = false;
};

}  // namespace osteon
