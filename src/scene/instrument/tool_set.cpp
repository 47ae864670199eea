#include "osteon/scene/tool_set.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "numbers.h"
#include "osteon/base/hash.h"
#include "osteon/scene/tool_hash.h"

namespace osteon {
namespace {

// Sizes of one instrument that are wanted; none: all of them.
struct Wanted {
  const Instrument* instrument = nullptr;
  std::set<std::size_t> sizes;
};

Result<void> add_wanted(std::span<const Instrument> all, const std::string& text,
                        std::vector<Wanted>& wanted) {
  const auto parsed = parse_tool_name(text);
  if (!parsed) return tl::unexpected(parsed.error());
  const Instrument* found = find_instrument(all, parsed->name);
  if (!found)
    return fail("there is no instrument '" + parsed->name + "'", "instruments",
                "See: osteon instruments");
  auto at = std::find_if(wanted.begin(), wanted.end(),
                         [&](const Wanted& w) { return w.instrument == found; });
  if (at == wanted.end()) at = wanted.insert(wanted.end(), {found, {}});
  if (!parsed->size_mm) {
    for (std::size_t i = 0; i < found->sizes_m.size(); ++i) at->sizes.insert(i);
    return {};
  }
  const auto size = find_size(*found, *parsed->size_mm);
  if (!size)
    return fail("'" + parsed->name + "' has no such size: '" + text + "'", "instruments",
                "See: osteon instruments show " + parsed->name);
  at->sizes.insert(*size);
  return {};
}

}  // namespace

Result<ToolName> parse_tool_name(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return ToolName{std::string(text), std::nullopt};
  const std::string_view number = text.substr(colon + 1);
  double mm = 0;
  const auto read = std::from_chars(number.data(), number.data() + number.size(), mm);
  const bool whole = read.ec == std::errc() && read.ptr == number.data() + number.size();
  if (!whole || !(mm > 0) || !std::isfinite(mm))
    return fail("the size must be a number above 0: '" + std::string(text) + "'", "instruments",
                "Write it as in cannulated_drill:9");
  return ToolName{std::string(text.substr(0, colon)), mm};
}

void ToolSet::add(const Instrument& instrument, std::size_t size) {
  tools_.push_back(
      {instruments_.size() - 1, size, std::make_shared<const Tool>(make_tool(instrument, size))});
}

ToolSet ToolSet::of(std::vector<Instrument> instruments) {
  ToolSet set;
  for (Instrument& instrument : instruments) {
    set.instruments_.push_back(std::move(instrument));
    const Instrument& kept = set.instruments_.back();
    for (std::size_t size = 0; size < kept.sizes_m.size(); ++size) set.add(kept, size);
  }
  return set;
}

Result<ToolSet> ToolSet::of(std::span<const Instrument> all, std::span<const std::string> names) {
  std::vector<Wanted> wanted;
  for (const std::string& name : names)
    if (auto ok = add_wanted(all, name, wanted); !ok) return tl::unexpected(ok.error());
  if (wanted.empty()) return fail("no instrument is named", "instruments", "Name one or more");
  ToolSet set;
  for (const Wanted& one : wanted) {
    set.instruments_.push_back(*one.instrument);
    for (const std::size_t size : one.sizes) set.add(*one.instrument, size);
  }
  return set;
}

std::size_t ToolSet::usual_place(std::size_t instrument) const {
  const double usual = instruments_[instrument].sizes_m[instruments_[instrument].usual_size];
  std::size_t best = tools_.size();
  double least = 0;
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    if (tools_[i].instrument != instrument) continue;
    const double off = std::abs(instruments_[instrument].sizes_m[tools_[i].size] - usual);
    if (best < tools_.size() && !(off < least)) continue;
    best = i;
    least = off;
  }
  return best;
}

std::optional<std::size_t> ToolSet::find(std::string_view name,
                                         std::optional<double> size_mm) const {
  for (std::size_t k = 0; k < instruments_.size(); ++k) {
    if (instruments_[k].name != name) continue;
    if (!size_mm) return usual_place(k);
    const auto size = find_size(instruments_[k], *size_mm);
    for (std::size_t i = 0; size && i < tools_.size(); ++i)
      if (tools_[i].instrument == k && tools_[i].size == *size) return i;
  }
  return std::nullopt;
}

std::optional<std::size_t> ToolSet::find_code(int code) const {
  for (std::size_t k = 0; k < instruments_.size(); ++k)
    if (instruments_[k].code == code) return usual_place(k);
  return std::nullopt;
}

std::size_t ToolSet::next(std::size_t place, int steps) const {
  const auto n = static_cast<long>(instruments_.size());
  const auto from = static_cast<long>(tools_[place].instrument);
  return usual_place(static_cast<std::size_t>(((from + steps) % n + n) % n));
}

std::size_t ToolSet::next_size(std::size_t place) const {
  const std::size_t instrument = tools_[place].instrument;
  if (place + 1 < tools_.size() && tools_[place + 1].instrument == instrument) return place + 1;
  while (place > 0 && tools_[place - 1].instrument == instrument) --place;
  return place;
}

std::vector<std::shared_ptr<const Tool>> ToolSet::tools() const {
  std::vector<std::shared_ptr<const Tool>> out;
  for (const PreparedTool& tool : tools_) out.push_back(tool.tool);
  return out;
}

std::vector<std::string> ToolSet::names() const {
  std::vector<std::string> out;
  for (const PreparedTool& one : tools_) {
    const Instrument& instrument = instruments_[one.instrument];
    out.push_back(instrument.name + ":" +
                  format_number(std::round(1e6 * instrument.sizes_m[one.size]) * 1e-3));
  }
  return out;
}

std::uint64_t ToolSet::hash() const {
  Hasher hasher;
  for (const PreparedTool& one : tools_) {
    hasher.add(static_cast<std::uint64_t>(one.size));
    hasher.add(felt_hash(*one.tool));
  }
  return hasher.value();
}

}  // namespace osteon
