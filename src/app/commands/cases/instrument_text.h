#pragma once

#include <string>
#include <vector>

#include "osteon/scene/instrument.h"

namespace osteon {

/// A table for a person, a line an instrument; functions that have no effect are in brackets.
std::string instruments_table(const std::vector<Instrument>& instruments);

/// All of one instrument in words.
std::string instrument_text(const Instrument& instrument);

/// A list for a program: name, title, code, regions, functions, without_effect, size_of, sizes
/// (mm), usual_size, power, pedal, jaws, optics, source.
std::string instruments_json(const std::vector<Instrument>& instruments);

}  // namespace osteon
