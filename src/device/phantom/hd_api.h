#pragma once

#include <span>
#include <string>
#include <vector>

#include "hd_abi.h"
#include "osteon/base/result.h"

namespace osteon {

/// The calls of a loaded OpenHaptics library. Plain pointers: the library is never unloaded.
struct HdApi {
  hd::Handle (*init_device)(const char* config_name) = nullptr;
  void (*disable_device)(hd::Handle) = nullptr;
  void (*make_current_device)(hd::Handle) = nullptr;
  void (*begin_frame)(hd::Handle) = nullptr;
  void (*end_frame)(hd::Handle) = nullptr;
  hd::ErrorInfo (*get_error)() = nullptr;
  const char* (*get_error_string)(hd::ErrorCode) = nullptr;
  void (*enable)(hd::Enum) = nullptr;
  void (*disable)(hd::Enum) = nullptr;
  hd::Boolean (*is_enabled)(hd::Enum) = nullptr;
  void (*get_doublev)(hd::Enum, double*) = nullptr;
  void (*set_doublev)(hd::Enum, const double*) = nullptr;
  void (*get_integerv)(hd::Enum, int*) = nullptr;
  void (*get_booleanv)(hd::Enum, hd::Boolean*) = nullptr;
  const char* (*get_string)(hd::Enum) = nullptr;
  hd::Enum (*check_calibration)() = nullptr;
  void (*update_calibration)(hd::Enum style) = nullptr;
  void (*start_scheduler)() = nullptr;
  void (*stop_scheduler)() = nullptr;
  void (*set_scheduler_rate)(hd::ULong rate_hz) = nullptr;
  void (*schedule_synchronous)(hd::Callback, void* user, std::uint16_t priority) = nullptr;
  hd::ULong (*schedule_asynchronous)(hd::Callback, void* user, std::uint16_t priority) = nullptr;
  void (*unschedule)(hd::ULong handle) = nullptr;
};

/// Where the library is looked for: $OSTEON_HD_LIBRARY when set, else the names under which the
/// vendor installs it.
std::vector<std::string> hd_library_candidates();

/// Loads the library and binds every call. Fails with what the system said, or with the name of
/// each call that the library lacks.
Result<HdApi> load_hd_api(std::span<const std::string> candidates);

}  // namespace osteon
