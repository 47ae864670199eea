#include <dlfcn.h>

#include "shared_library.h"

namespace osteon {
namespace {

// "libX.so: cannot open shared object file: No such file or directory": that libX itself is not
// there, which the caller says better; of a library that libX needs it is news.
bool just_missing(const std::string& name, const std::string& reason) {
  return reason.starts_with(name + ": cannot open shared object file: No such file");
}

}  // namespace

Result<void*> load_shared_library(std::span<const std::string> candidates) {
  std::string said;
  for (const std::string& name : candidates) {
    if (void* library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
    const char* text = dlerror();
    const std::string reason = text ? text : name + " did not load";
    if (!just_missing(name, reason)) said += (said.empty() ? "" : "; ") + reason;
  }
  return fail("the library could not be loaded", said);
}

void* find_symbol(void* library, const char* name) { return dlsym(library, name); }

}  // namespace osteon
