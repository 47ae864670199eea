#include "osteon/scene/instrument.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

struct FunctionRow {
  InstrumentFunction function;
  std::string_view name;
  bool has_effect;
};
constexpr std::array<FunctionRow, kInstrumentFunctions> kFunctions{
    {{InstrumentFunction::kProbe, "probe", true},
     {InstrumentFunction::kLook, "look", false},
     {InstrumentFunction::kCut, "cut", false},
     {InstrumentFunction::kRemove, "remove", false},
     {InstrumentFunction::kBurn, "burn", false},
     {InstrumentFunction::kSuck, "suck", false},
     {InstrumentFunction::kGrasp, "grasp", false},
     {InstrumentFunction::kRetract, "retract", false},
     {InstrumentFunction::kGuide, "guide", false},
     {InstrumentFunction::kDrive, "drive", false},
     {InstrumentFunction::kPlace, "place", false}}};

const FunctionRow& row_of(InstrumentFunction function) {
  return kFunctions[static_cast<std::size_t>(function)];
}

}  // namespace

std::string_view to_text(InstrumentFunction function) { return row_of(function).name; }

bool has_effect(InstrumentFunction function) { return row_of(function).has_effect; }

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
