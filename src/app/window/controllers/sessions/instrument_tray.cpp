#include "window/controllers/sessions/instrument_tray.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "runs/hands/tray.h"

namespace osteon {
namespace {

constexpr const char* kWristProbeTitle = "Wrist probe";
// Places of the set come after the wrist probe.
constexpr std::uint32_t kFirst = 1;

bool is_of(const Instrument& instrument, const std::string& region) {
  return std::find(instrument.regions.begin(), instrument.regions.end(), region) !=
         instrument.regions.end();
}

std::string in_mm(double size_m) {
  char text[32];
  std::snprintf(text, sizeof text, "%g mm", 1e3 * size_m);
  return text;
}

std::string what_it_does(const Instrument& instrument) {
  std::string text, declared;
  for (const InstrumentFunction function : instrument.functions) {
    std::string& into = has_effect(instrument, function) ? text : declared;
    into += (into.empty() ? "" : ", ") + std::string(to_text(function));
  }
  if (declared.empty()) return text;
  return text + (text.empty() ? "" : "; ") + declared + " (no effect yet)";
}

// What has no effect is not driven; jaws that remove nothing carry what lies loose.
RunTray::Driven driven_of(const Instrument& instrument) {
  if (instrument.aims) return {false, true};
  // A screw has no motor of its own: the key turns it.
  const bool turned = has_effect(instrument, InstrumentFunction::kDrive);
  const bool sucks = has_effect(instrument, InstrumentFunction::kSuck) ||
                     has_effect(instrument, InstrumentFunction::kBurn);
  if (!instrument.removal)
    return {turned || sucks, instrument.can(InstrumentFunction::kGrasp) && !instrument.power};
  return {instrument.power.has_value(), instrument.removal->way == RemovalWay::kBite};
}

}  // namespace

std::string region_of(const Case& the_case) {
  const bool knee = the_case.find("femur").valid() || the_case.find("thigh").valid();
  return knee ? "knee" : "wrist";
}

InstrumentTray::InstrumentTray() {
  run_.names = {kWristProbe};
  run_.tools = {std::make_shared<const Tool>(make_wrist_probe())};
  run_.driven.emplace_back();
}

Result<InstrumentTray> InstrumentTray::make(const std::string& region,
                                            std::span<const std::string> wanted) {
  auto all = load_instruments();
  if (!all) return tl::unexpected(all.error());
  std::vector<std::string> names;
  for (const Instrument& instrument : *all)
    if (is_of(instrument, region)) names.push_back(instrument.name);
  for (const std::string& name : wanted)
    if (!name.empty() && name != kWristProbe) names.push_back(name);
  InstrumentTray tray;
  if (names.empty()) return tray;
  auto set = ToolSet::of(*all, names);
  if (!set) return tl::unexpected(set.error());
  tray.set_ = std::move(*set);
  for (const std::string& name : tray.set_.names()) tray.run_.names.push_back(name);
  for (std::size_t i = 0; i < tray.set_.tools().size(); ++i) {
    tray.run_.tools.push_back(tray.set_.tools()[i]);
    tray.run_.driven.push_back(driven_of(tray.set_.instruments()[tray.set_.at(i).instrument]));
  }
  return tray;
}

PreparedTray prepare_tray(const std::string& region, const std::vector<std::string>& wanted) {
  auto made = InstrumentTray::make(region, wanted);
  if (!made) return {InstrumentTray(), region, wanted, made.error().message()};
  return {std::move(*made), region, wanted, {}};
}

std::optional<std::uint32_t> InstrumentTray::find(const std::string& name) const {
  if (name.empty() || name == kWristProbe) return 0;
  const auto wanted = parse_tool_name(name);
  if (!wanted) return std::nullopt;
  const auto place = set_.find(wanted->name, wanted->size_mm);
  if (!place) return std::nullopt;
  return static_cast<std::uint32_t>(*place) + kFirst;
}

// The wrist probe stands before the first instrument, round and round.
std::uint32_t InstrumentTray::next(std::uint32_t place, int steps) const {
  std::vector<std::uint32_t> usual{0};
  std::size_t at = 0;
  for (std::size_t i = 0; i < set_.instruments().size(); ++i) {
    const auto found = set_.find(set_.instruments()[i].name);
    if (place >= kFirst && set_.at(place - kFirst).instrument == i) at = usual.size();
    usual.push_back(static_cast<std::uint32_t>(found.value_or(0)) + kFirst);
  }
  const auto n = static_cast<int>(usual.size());
  const int to = ((static_cast<int>(at) + steps) % n + n) % n;
  return usual[static_cast<std::size_t>(to)];
}

ProbePath InstrumentTray::sized(ProbePath path) const {
  for (PathSample& sample : path.samples) {
    if (sample.instrument.empty() || sample.size_mm > 0) continue;
    const auto place = find(sample.instrument);
    const auto name = place ? parse_tool_name(run_.names[*place]) : Result<ToolName>(ToolName{});
    if (name && name->size_mm) sample.size_mm = *name->size_mm;
  }
  return path;
}

std::uint32_t InstrumentTray::next_size(std::uint32_t place) const {
  if (place < kFirst) return place;
  return static_cast<std::uint32_t>(set_.next_size(place - kFirst)) + kFirst;
}

TrayItem InstrumentTray::item(std::uint32_t place) const {
  if (place < kFirst)
    return {kWristProbeTitle, {}, "probe: only the ball at its tip is felt", 0, 0};
  const PreparedTool& tool = set_.at(place - kFirst);
  const Instrument& instrument = set_.instruments()[tool.instrument];
  const int picture = static_cast<int>(tool.instrument) + 1;  // after the wrist probe's
  TrayItem out{instrument.title, {}, what_it_does(instrument), place, picture};
  if (instrument.sizes_m.size() > 1) out.size = in_mm(instrument.sizes_m[tool.size]);
  return out;
}

std::string InstrumentTray::title(std::uint32_t place) const {
  if (place >= run_.tools.size()) return "instrument " + std::to_string(place);
  const TrayItem of = item(place);
  return of.size.empty() ? of.title : of.title + ", " + of.size;
}

std::vector<std::string> InstrumentTray::titles() const {
  std::vector<std::string> out;
  for (std::uint32_t place = 0; place < run_.tools.size(); ++place) out.push_back(title(place));
  return out;
}

void InstrumentTray::took(std::uint32_t place) {
  std::erase(taken_, place);
  taken_.insert(taken_.begin(), place);
}

// Of what was never taken, an instrument's usual size comes before its others.
std::vector<std::uint32_t> InstrumentTray::usual_first() const {
  std::vector<std::uint32_t> out{0};
  std::vector<bool> begun(set_.instruments().size(), false);
  for (std::uint32_t place = kFirst; place < run_.tools.size(); ++place) {
    const std::size_t of = set_.at(place - kFirst).instrument;
    if (!begun[of])
      out.push_back(static_cast<std::uint32_t>(*set_.find(set_.instruments()[of].name)) + kFirst);
    begun[of] = true;
    if (std::find(out.begin(), out.end(), place) == out.end()) out.push_back(place);
  }
  return out;
}

std::vector<TrayItem> InstrumentTray::items() const {
  std::vector<TrayItem> out;
  for (const std::uint32_t place : taken_) out.push_back(item(place));
  for (const std::uint32_t place : usual_first())
    if (std::find(taken_.begin(), taken_.end(), place) == taken_.end()) out.push_back(item(place));
  return out;
}

}  // namespace osteon
