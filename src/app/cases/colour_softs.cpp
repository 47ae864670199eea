#include "cases/colour_softs.h"

#include "osteon/image/tissue.h"

namespace osteon {

void colour_softs(CaseDef& def) {
  if (def.softs.empty()) return;
  const auto tissues = load_default_tissues();
  if (!tissues) return;
  for (SoftDef& soft : def.softs)
    if (const Tissue* tissue = tissues->find(soft.tissue))
      for (std::size_t k = 0; k < 3; ++k)
        soft.color_srgb[k] = static_cast<float>(tissue->colour_srgb[k]);
}

}  // namespace osteon
