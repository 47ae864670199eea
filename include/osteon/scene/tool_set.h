#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// One instrument in one size, made ready.
struct PreparedTool {
  std::size_t instrument = 0;  ///< in ToolSet::instruments
  std::size_t size = 0;        ///< of Instrument::sizes_m
  std::shared_ptr<const Tool> tool;
};

/// Everything that the hands of a session may take, made at load, so that an exchange makes
/// nothing. Places count from 0; the sizes of one instrument stand together, in their order.
class ToolSet {
 public:
  /// All sizes of each of the instruments, in their order.
  static ToolSet of(std::vector<Instrument> instruments);
  /// Of those named: "hook_probe" in all its sizes, "cannulated_drill:9" in that one (mm). A name
  /// that comes again adds sizes. Fails on a name or size that there is not, and on none.
  static Result<ToolSet> of(std::span<const Instrument> all, std::span<const std::string> names);

  std::size_t count() const { return tools_.size(); }
  const PreparedTool& at(std::size_t place) const { return tools_[place]; }
  const Instrument& instrument_at(std::size_t place) const {
    return instruments_[tools_[place].instrument];
  }
  const std::vector<Instrument>& instruments() const { return instruments_; }

  /// Place of an instrument in a size; in the size that is usual where none is given, or the
  /// nearest to it that the set has. None: it is not in the set.
  std::optional<std::size_t> find(std::string_view name,
                                  std::optional<double> size_mm = std::nullopt) const;
  /// Place of the instrument that a device names by its code, in the usual size.
  std::optional<std::size_t> find_code(int code) const;
  /// The place of the next instrument in its usual size, round and round; `steps` may be negative.
  std::size_t next(std::size_t place, int steps = 1) const;
  /// The next larger size of the same instrument, from the largest to the smallest.
  std::size_t next_size(std::size_t place) const;

  /// Of all tools, by place.
  std::vector<std::shared_ptr<const Tool>> tools() const;
  /// Of all, by place, as `of` takes them: "cannulated_drill:9".
  std::vector<std::string> names() const;
  /// Over all that is felt of them.
  std::uint64_t hash() const;

 private:
  void add(const Instrument& instrument, std::size_t size);
  std::size_t usual_place(std::size_t instrument) const;

  std::vector<Instrument> instruments_;
  std::vector<PreparedTool> tools_;
};

/// "cannulated_drill:9" in parts. Fails when the size is not a number above 0.
struct ToolName {
  std::string name;
  std::optional<double> size_mm;
};
Result<ToolName> parse_tool_name(std::string_view text);

}  // namespace osteon
