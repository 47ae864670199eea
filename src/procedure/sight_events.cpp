#include "osteon/procedure/sight_events.h"

namespace osteon {

const char* to_text(SightLost cause) {
  switch (cause) {
    case SightLost::kPressure:
      return "pressure";
    case SightLost::kBlood:
      return "blood";
    case SightLost::kDebris:
      return "debris";
  }
  return "";
}

}  // namespace osteon
