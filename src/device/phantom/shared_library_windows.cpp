// Without its macros min and max.
#define NOMINMAX
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include "shared_library.h"

namespace osteon {

Result<void*> load_shared_library(std::span<const std::string> candidates) {
  std::string said;
  for (const std::string& name : candidates) {
    if (HMODULE library = LoadLibraryA(name.c_str())) return static_cast<void*>(library);
    said += (said.empty() ? "" : "; ") + name + ": Windows error " + std::to_string(GetLastError());
  }
  return fail("the library could not be loaded", said);
}

void* find_symbol(void* library, const char* name) {
  return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(library), name));
}

}  // namespace osteon
