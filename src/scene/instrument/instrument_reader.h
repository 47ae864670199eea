#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "case/case_toml_reader.h"
#include "osteon/scene/instrument.h"

namespace osteon {

inline constexpr double kMmPerFile = 1e-3;  ///< files of instruments hold mm

/// Reads what files of instruments hold beyond numbers and text: lengths that may grow with the
/// size, points of them, and jaws.
class InstrumentReader : public CaseTomlReader {
 public:
  InstrumentReader(const toml::table& table, std::string where, std::string title)
      : CaseTomlReader(table, std::move(where), std::move(title)), table_(table) {}

  /// mm, or { mm = 1, size = 0.5 }: 1 mm and half the size. Above 0 when `above_zero`, in which
  /// case neither part may be negative.
  SizedLength length(std::string_view key, bool above_zero);
  SizedPoint point(std::string_view key, bool above_zero = false);
  /// Lists of `Width` lengths each; none where the key is absent.
  template <std::size_t Width>
  std::vector<std::array<SizedLength, Width>> rows(std::string_view key);
  std::vector<SizedLength> lengths(std::string_view key);
  Vec3 turn_deg(std::string_view key);
  Jaw jaw(std::string_view key);

 private:
  SizedLength as_length(const toml::node& node, std::string_view key, bool above_zero);
  double within(const toml::node* node, std::string_view key, NumberRange range);

  const toml::table& table_;
};

/// One [[felt]] or [[look]] table.
FeltPart read_felt(InstrumentReader& in);
LookPart read_look(InstrumentReader& in);

/// Whether every part can be made in every size.
Result<void> check_instrument(const Instrument& instrument);

template <std::size_t Width>
std::vector<std::array<SizedLength, Width>> InstrumentReader::rows(std::string_view key) {
  std::vector<std::array<SizedLength, Width>> out;
  const toml::array* list = table_.get_as<toml::array>(key);
  if (!list) {
    if (has(key)) set_error("'" + std::string(key) + "' must be a list of lists", key);
    return out;
  }
  for (const toml::node& node : *list) {
    const toml::array* row = node.as_array();
    if (!row || row->size() != Width) {
      set_error("'" + std::string(key) + "' must hold lists of " + std::to_string(Width), key);
      return out;
    }
    std::array<SizedLength, Width> values;
    for (std::size_t i = 0; i < Width; ++i) values[i] = as_length(*row->get(i), key, false);
    out.push_back(values);
  }
  return out;
}

}  // namespace osteon
