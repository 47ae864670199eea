// The first byte chooses the kind, the rest is the text: a description of an anatomy, its
// variations, its findings, or a table of tissues. An error or something that keeps its promises.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "describe/description.h"
#include "finding/finding_table.h"
#include "osteon/base/check.h"
#include "osteon/image/tissue.h"
#include "vary/variation_table.h"

namespace {

void read_anatomy(std::string_view text) {
  const auto anatomy = osteon::parse_description(text, "fuzz.toml");
  if (!anatomy) return;
  osteon::demand(!anatomy->bones.empty(), "an anatomy has bones");
  for (const auto& soft : anatomy->softs)
    osteon::demand(osteon::carrier(soft) < anatomy->bones.size(), "a soft part is on no bone");
  for (const auto& landmark : anatomy->landmarks) {
    osteon::demand(osteon::is_finite(landmark.p_W), "a landmark is not finite");
    osteon::demand(!landmark.on_soft || *landmark.on_soft < anatomy->softs.size(),
                   "a landmark lies on nothing");
  }
}

void read_variation(std::string_view text) {
  const auto table = osteon::parse_variation(text, "fuzz.toml");
  if (!table) return;
  osteon::demand(table->overall_size < table->rules.size(), "there is no overall size");
}

void read_findings(std::string_view text) {
  const auto table = osteon::parse_findings(text, "fuzz.toml");
  if (!table) return;
  for (const auto& rule : table->rules)
    osteon::demand(!rule.steps.empty(), "a finding does nothing");
}

void read_tissues(std::string_view text) {
  const auto table = osteon::parse_tissue_table(text, "fuzz.toml");
  if (!table) return;
  for (const auto& tissue : table->tissues)
    osteon::demand(table->find(tissue.name) == &tissue, "a name stands for two tissues");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr void (*kReaders[])(std::string_view) = {read_anatomy, read_variation, read_findings,
                                                    read_tissues};
  if (size == 0) return 0;
  kReaders[data[0] % 4]({reinterpret_cast<const char*>(data) + 1, size - 1});
  return 0;
}
