#pragma once

#include <map>
#include <string>
#include <string_view>

#include "osteon/base/result.h"

namespace osteon {

/// The files of a tar archive by their names without folders; views into `bytes`.
Result<std::map<std::string, std::string_view>> read_tar(std::string_view bytes,
                                                         const std::string& where);

}  // namespace osteon
