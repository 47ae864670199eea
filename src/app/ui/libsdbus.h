#pragma once

// The client of the desktop's message bus (D-Bus) that is part of systemd's library, found when it
// is needed: Osteon runs without it, and links none of it. Its binary interface is fixed (versioned
// symbols, sd-bus(3)): what is used of it is declared here.
#include <cstdint>
#include <string>

#include "osteon/base/result.h"

namespace osteon {

/// A connection, and a message on it; both belong to the library.
struct SdBus;
struct SdBusMessage;
using SdBusHandler = int (*)(SdBusMessage* message, void* user, void* error);

/// What is called of it, under its own names without "sd_bus_". Negative answers are errors.
struct Libsdbus {
  int (*open_user)(SdBus** bus) = nullptr;
  SdBus* (*flush_close_unref)(SdBus* bus) = nullptr;
  int (*get_unique_name)(SdBus* bus, const char** name) = nullptr;
  int (*get_property_trivial)(SdBus* bus, const char* destination, const char* path,
                              const char* interface, const char* member, void* error, char type,
                              void* value) = nullptr;
  int (*match_signal)(SdBus* bus, void** slot, const char* sender, const char* path,
                      const char* interface, const char* member, SdBusHandler handler,
                      void* user) = nullptr;
  int (*call_method)(SdBus* bus, const char* destination, const char* path, const char* interface,
                     const char* member, void* error, SdBusMessage** reply, const char* types,
                     ...) = nullptr;
  int (*process)(SdBus* bus, SdBusMessage** message) = nullptr;
  int (*wait)(SdBus* bus, std::uint64_t timeout_us) = nullptr;
  int (*message_read)(SdBusMessage* message, const char* types, ...) = nullptr;
  int (*message_enter_container)(SdBusMessage* message, char type, const char* contents) = nullptr;
  int (*message_exit_container)(SdBusMessage* message) = nullptr;
  int (*message_skip)(SdBusMessage* message, const char* types) = nullptr;
  SdBusMessage* (*message_unref)(SdBusMessage* message) = nullptr;
};

/// The usual file of the library.
std::string libsdbus_file();
/// Fails where it does not load or lacks a function. It stays loaded.
Result<Libsdbus> load_libsdbus(const std::string& file);

}  // namespace osteon
