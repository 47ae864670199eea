#include <cmath>

#include "instrument/instrument_reader.h"
#include "numbers.h"

namespace osteon {
namespace {

// An instrument ends within a metre of its tip.
constexpr NumberRange kInstrumentLength_mm{-1000, 1000};
constexpr NumberRange kSizeShare{-10, 10};

}  // namespace

double InstrumentReader::within(const toml::node* node, std::string_view key, NumberRange range) {
  if (!node) return 0;
  const auto value = node->is_number() ? node->value<double>() : std::nullopt;
  if (value && *value >= range.lo && *value <= range.hi) return *value;
  set_error("'" + std::string(key) + "' must hold numbers from " + format_number(range.lo) +
                " to " + format_number(range.hi),
            key);
  return 0;
}

SizedLength InstrumentReader::as_length(const toml::node& node, std::string_view key,
                                        bool above_zero) {
  SizedLength out;
  if (const toml::table* parts = node.as_table()) {
    for (const auto& [name, value] : *parts)
      if (name.str() != "mm" && name.str() != "size")
        set_error("'" + std::string(key) + "' must be mm or { mm = ..., size = ... }", key);
    out.plus_m = kMmPerFile * within(parts->get("mm"), key, kInstrumentLength_mm);
    out.per_size = within(parts->get("size"), key, kSizeShare);
  } else {
    out.plus_m = kMmPerFile * within(&node, key, kInstrumentLength_mm);
  }
  const bool positive = out.per_size != 0 || out.plus_m > 0;
  if (above_zero && !positive) set_error("'" + std::string(key) + "' must be above 0", key);
  return out;
}

SizedLength InstrumentReader::length(std::string_view key, bool above_zero) {
  const toml::node* node = table_.get(key);
  if (node) return as_length(*node, key, above_zero);
  set_error("the key '" + std::string(key) + "' is missing", key);
  return {1, 0};
}

SizedPoint InstrumentReader::point(std::string_view key, bool above_zero) {
  SizedPoint out;
  const toml::array* list = table_.get_as<toml::array>(key);
  if (!list || list->size() != 3) {
    set_error("'" + std::string(key) + "' must be a list of three lengths in mm", key);
    return out;
  }
  for (std::size_t i = 0; i < 3; ++i) out.axis[i] = as_length(*list->get(i), key, above_zero);
  return out;
}

std::vector<SizedLength> InstrumentReader::lengths(std::string_view key) {
  std::vector<SizedLength> out;
  const toml::array* list = table_.get_as<toml::array>(key);
  if (!list) set_error("'" + std::string(key) + "' must be a list of lengths in mm", key);
  for (std::size_t i = 0; list && i < list->size(); ++i)
    out.push_back(as_length(*list->get(i), key, true));
  return out;
}

Vec3 InstrumentReader::turn_deg(std::string_view key) {
  if (!has(key)) return Vec3::Zero();
  const std::vector<double> deg = numbers(key, 3, {-360, 360});
  return {deg[0], deg[1], deg[2]};
}

Jaw InstrumentReader::jaw(std::string_view key) {
  if (!has(key)) return Jaw::kNone;
  const std::string name = text(key);
  if (name != "first" && name != "second")
    set_error("'" + std::string(key) + "' must be \"first\" or \"second\"", key);
  return name == "second" ? Jaw::kSecond : Jaw::kFirst;
}

}  // namespace osteon
