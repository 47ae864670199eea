#include "ui/libsdbus.h"

#include <dlfcn.h>

namespace osteon {
namespace {

template <class Function>
bool find_bus(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library, name));
  return function != nullptr;
}

bool find_all_bus(void* l, Libsdbus& bus) {
  return find_bus(l, "sd_bus_open_user", bus.open_user) &&
         find_bus(l, "sd_bus_flush_close_unref", bus.flush_close_unref) &&
         find_bus(l, "sd_bus_get_unique_name", bus.get_unique_name) &&
         find_bus(l, "sd_bus_get_property_trivial", bus.get_property_trivial) &&
         find_bus(l, "sd_bus_match_signal", bus.match_signal) &&
         find_bus(l, "sd_bus_call_method", bus.call_method) &&
         find_bus(l, "sd_bus_process", bus.process) && find_bus(l, "sd_bus_wait", bus.wait) &&
         find_bus(l, "sd_bus_message_read", bus.message_read) &&
         find_bus(l, "sd_bus_message_enter_container", bus.message_enter_container) &&
         find_bus(l, "sd_bus_message_exit_container", bus.message_exit_container) &&
         find_bus(l, "sd_bus_message_skip", bus.message_skip) &&
         find_bus(l, "sd_bus_message_unref", bus.message_unref);
}

}  // namespace

std::string libsdbus_file() { return "libsystemd.so.0"; }

Result<Libsdbus> load_libsdbus(const std::string& file) {
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) return fail("systemd's library was not found", file);
  Libsdbus bus;
  if (!find_all_bus(library, bus)) return fail("this is not systemd's library", file);
  return bus;
}

}  // namespace osteon
