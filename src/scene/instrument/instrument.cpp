#include "osteon/scene/instrument.h"

#include <algorithm>
#include <cmath>

#include "osteon/scene/needle.h"

namespace osteon {
namespace {

struct FunctionRow {
  InstrumentFunction function;
  std::string_view name;
};
constexpr std::array<FunctionRow, kInstrumentFunctions> kFunctions{
    {{InstrumentFunction::kProbe, "probe"},
     {InstrumentFunction::kLook, "look"},
     {InstrumentFunction::kCut, "cut"},
     {InstrumentFunction::kRemove, "remove"},
     {InstrumentFunction::kBurn, "burn"},
     {InstrumentFunction::kSuck, "suck"},
     {InstrumentFunction::kGrasp, "grasp"},
     {InstrumentFunction::kRetract, "retract"},
     {InstrumentFunction::kGuide, "guide"},
     {InstrumentFunction::kDrive, "drive"},
     {InstrumentFunction::kPlace, "place"}}};

constexpr std::array<std::string_view, kRemovalWays> kWays{"drill",  "twist",  "burr",
                                                           "scrape", "strike", "bite"};

const FunctionRow& row_of(InstrumentFunction function) {
  return kFunctions[static_cast<std::size_t>(function)];
}

// A session finds by name what makes, places and fixes the graft of a knee.
bool works_on_grafts(std::string_view name) {
  constexpr std::array<std::string_view, 4> kNames{"endobutton", "graft_sizer",
                                                   "interference_screw", "passing_pin"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

}  // namespace

std::string_view to_text(InstrumentFunction function) { return row_of(function).name; }

bool has_effect(const Instrument& instrument, InstrumentFunction function) {
  using enum InstrumentFunction;
  if (!instrument.can(function)) return false;
  // Of the water in a joint, and of wounds that bleed into it.
  if (function == kSuck || function == kBurn) return instrument.power.has_value();
  if (works_on_grafts(instrument.name)) return true;
  // What cuts and removes bites with its jaw: what it takes of a meniscus is gone.
  const bool bites = instrument.jaws && instrument.can(kCut) && instrument.can(kRemove);
  if (function == kRemove) return instrument.removal || instrument.clears || bites;
  if (function == kLook) return instrument.optics.has_value();
  // An edge cuts ligaments and menisci that are felt; what else removes does not cut yet.
  if (function == kCut) return instrument.jaws || !instrument.can(kRemove);
  // A needle shows where a portal comes through, a trocar makes one for what follows.
  if (function == kGuide)
    return instrument.aims || pierces_skin(instrument.name) ||
           (instrument.removal && instrument.removal->way == RemovalWay::kDrill);
  // Its motor, or the hand, drives it into the bone.
  if (function == kDrive)
    return instrument.removal && (instrument.removal->way == RemovalWay::kDrill ||
                                  instrument.removal->way == RemovalWay::kTwist);
  if (function == kGrasp) return instrument.jaws && instrument.jaws->holds_n > 0;
  // A retractor holds tissue back by standing in its way.
  return function == kProbe || function == kRetract;
}

std::string_view to_text(RemovalWay way) { return kWays[static_cast<std::size_t>(way)]; }

std::optional<RemovalWay> removal_way_from_text(std::string_view text) {
  for (std::size_t i = 0; i < kWays.size(); ++i)
    if (kWays[i] == text) return static_cast<RemovalWay>(i);
  return std::nullopt;
}

std::optional<InstrumentFunction> function_from_text(std::string_view text) {
  for (const FunctionRow& row : kFunctions)
    if (row.name == text) return row.function;
  return std::nullopt;
}

bool Instrument::can(InstrumentFunction function) const {
  return std::find(functions.begin(), functions.end(), function) != functions.end();
}

const Instrument* find_instrument(std::span<const Instrument> instruments, std::string_view name) {
  for (const Instrument& instrument : instruments)
    if (instrument.name == name) return &instrument;
  return nullptr;
}

std::optional<std::size_t> find_size(const Instrument& instrument, double size_mm) {
  constexpr double kSame_m = 1e-6;
  for (std::size_t i = 0; i < instrument.sizes_m.size(); ++i)
    if (std::abs(instrument.sizes_m[i] - 1e-3 * size_mm) < kSame_m) return i;
  return std::nullopt;
}

}  // namespace osteon
