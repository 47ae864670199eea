#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/tool_set.h"

namespace osteon {

/// What `make(instrument, size)` makes of each instrument of a tray; nothing for what is none of
/// the set, as the plain probe. Fails on a size that the instrument does not have.
template <class T, class Make>
Result<std::vector<std::optional<T>>> of_tray(std::span<const std::string> tray, const Make& make) {
  std::vector<std::optional<T>> out(tray.size());
  if (tray.empty()) return out;
  const auto instruments = load_instruments();
  if (!instruments) return tl::unexpected(instruments.error());
  for (std::size_t i = 0; i < tray.size(); ++i) {
    const auto named = parse_tool_name(tray[i]);
    const Instrument* found = find_instrument(*instruments, tray[i].substr(0, tray[i].find(':')));
    if (!named || !found) continue;
    const auto size = named->size_mm ? find_size(*found, *named->size_mm)
                                     : std::optional<std::size_t>(found->usual_size);
    if (!size) return fail("the instrument has no such size", tray[i]);
    out[i] = make(*found, *size);
  }
  return out;
}

}  // namespace osteon
