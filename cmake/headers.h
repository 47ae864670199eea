// Headers that most sources read, parsed once for builds with OSTEON_PCH. Sources include what they
// use all the same: -DOSTEON_PCH=OFF builds without.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
