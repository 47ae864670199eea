#include "commands/cases/instrument_text.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "commands/support/text_table.h"

namespace osteon {
namespace {

using Json = nlohmann::ordered_json;

std::string plain_number(double value) {
  std::string text = fixed(value, 2);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

std::string functions_of(const Instrument& instrument) {
  std::vector<std::string> words;
  for (const InstrumentFunction function : instrument.functions) {
    const std::string word(to_text(function));
    words.push_back(has_effect(instrument, function) ? word : "(" + word + ")");
  }
  return joined(words);
}

// "4 to 7 (4 sizes)" where there are many.
std::string sizes_of(const Instrument& instrument) {
  constexpr std::size_t kAFew = 4;
  std::vector<std::string> words;
  for (const double size : instrument.sizes_m) words.push_back(plain_number(1e3 * size));
  if (words.size() <= kAFew) return joined(words);
  return words.front() + " to " + words.back() + " (" + std::to_string(words.size()) + ")";
}

std::string power_of(const Instrument& instrument) {
  if (!instrument.power) return "-";
  const PowerDef& power = *instrument.power;
  return power.kind + ", " + plain_number(power.most) + " " + power.unit;
}

// Sizes are kept in metres; in a file they are mm to the micrometre.
double size_mm(double size_m) { return std::round(1e6 * size_m) * 1e-3; }

Json to_json(const Instrument& instrument) {
  Json functions = Json::array(), idle = Json::array(), sizes = Json::array();
  for (const InstrumentFunction function : instrument.functions) {
    functions.push_back(to_text(function));
    if (!has_effect(instrument, function)) idle.push_back(to_text(function));
  }
  for (const double size : instrument.sizes_m) sizes.push_back(size_mm(size));
  Json json = {{"name", instrument.name},
               {"title", instrument.title},
               {"code", instrument.code},
               {"regions", instrument.regions},
               {"functions", functions},
               {"without_effect", idle},
               {"size_of", instrument.size_of},
               {"sizes", sizes},
               {"usual_size", size_mm(instrument.sizes_m[instrument.usual_size])},
               {"power", nullptr},
               {"pedal", nullptr},
               {"jaws", instrument.jaws.has_value()},
               {"optics", nullptr},
               {"source", instrument.sources}};
  if (instrument.power) {
    const PowerDef& power = *instrument.power;
    json["power"] = {{"kind", power.kind}, {"most", power.most}, {"unit", power.unit}};
    if (power.pedal != "none") json["pedal"] = power.pedal;
  }
  if (instrument.optics)
    json["optics"] = {{"angle_deg", instrument.optics->angle_deg},
                      {"field_deg", instrument.optics->field_deg}};
  return json;
}

void add_line(std::string& text, const std::string& name, const std::string& value) {
  text += "  " + name + std::string(name.size() < 12 ? 12 - name.size() : 1, ' ') + value + "\n";
}

}  // namespace

std::string instruments_table(const std::vector<Instrument>& instruments) {
  TextTable table({"Name", "Instrument", "Functions", "Sizes, mm", "Power", "Pedal"});
  for (const Instrument& instrument : instruments)
    table.add(
        {instrument.name, instrument.title, functions_of(instrument), sizes_of(instrument),
         power_of(instrument),
         instrument.power && instrument.power->pedal != "none" ? instrument.power->pedal : "-"});
  return table.text() +
         "Functions in brackets are declared and have no effect yet. Bone is removed where it is "
         "felt as a field.\n";
}

std::string instrument_text(const Instrument& instrument) {
  std::string text = instrument.name + ": " + instrument.title + "\n";
  add_line(text, "code", std::to_string(instrument.code));
  add_line(text, "used in", joined(instrument.regions));
  add_line(text, "functions", functions_of(instrument) + "  (in brackets: no effect yet)");
  add_line(text, instrument.size_of,
           sizes_of(instrument) + " mm, usually " +
               plain_number(size_mm(instrument.sizes_m[instrument.usual_size])));
  if (instrument.power) {
    add_line(text, "power", power_of(instrument));
    add_line(text, "pedal", instrument.power->pedal);
  }
  if (instrument.optics)
    add_line(text, "view",
             plain_number(instrument.optics->angle_deg) + " degrees off the shaft, " +
                 plain_number(instrument.optics->field_deg) + " degrees wide");
  if (instrument.jaws) {
    const auto deg = [](double rad) { return plain_number(rad * 180 / std::numbers::pi); };
    add_line(text, "jaws",
             "open by " + deg(instrument.jaws->open_rad[0]) + " and " +
                 deg(instrument.jaws->open_rad[1]) + " degrees");
  }
  const Tool tool = make_tool(instrument, instrument.usual_size);
  add_line(text, "felt", std::to_string(tool.parts.size()) + " balls, rods and boxes");
  for (const std::string& source : instrument.sources) add_line(text, "source", source);
  return text;
}

std::string instruments_json(const std::vector<Instrument>& instruments) {
  Json list = Json::array();
  for (const Instrument& instrument : instruments) list.push_back(to_json(instrument));
  return list.dump(2);
}

}  // namespace osteon
