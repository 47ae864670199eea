#include "hd_api.h"

#include <cstdlib>

#include "shared_library.h"

namespace osteon {
namespace {

// Binds calls by name and keeps the names that are missing.
class Binder {
 public:
  explicit Binder(void* library) : library_(library) {}

  template <class Function>
  void operator()(Function*& call, const char* name) {
    call = reinterpret_cast<Function*>(find_symbol(library_, name));
    if (!call) missing_ += (missing_.empty() ? "" : ", ") + std::string(name);
  }

  const std::string& missing() const { return missing_; }

 private:
  void* library_;
  std::string missing_;
};

void bind_device_calls(Binder& bind, HdApi& api) {
  bind(api.init_device, "hdInitDevice");
  bind(api.disable_device, "hdDisableDevice");
  bind(api.make_current_device, "hdMakeCurrentDevice");
  bind(api.begin_frame, "hdBeginFrame");
  bind(api.end_frame, "hdEndFrame");
  bind(api.get_error, "hdGetError");
  bind(api.get_error_string, "hdGetErrorString");
  bind(api.enable, "hdEnable");
  bind(api.disable, "hdDisable");
  bind(api.is_enabled, "hdIsEnabled");
  bind(api.check_calibration, "hdCheckCalibration");
  bind(api.update_calibration, "hdUpdateCalibration");
}

void bind_state_calls(Binder& bind, HdApi& api) {
  bind(api.get_doublev, "hdGetDoublev");
  bind(api.set_doublev, "hdSetDoublev");
  bind(api.get_integerv, "hdGetIntegerv");
  bind(api.get_booleanv, "hdGetBooleanv");
  bind(api.get_string, "hdGetString");
}

void bind_scheduler_calls(Binder& bind, HdApi& api) {
  bind(api.start_scheduler, "hdStartScheduler");
  bind(api.stop_scheduler, "hdStopScheduler");
  bind(api.set_scheduler_rate, "hdSetSchedulerRate");
  bind(api.schedule_synchronous, "hdScheduleSynchronous");
  bind(api.schedule_asynchronous, "hdScheduleAsynchronous");
  bind(api.unschedule, "hdUnschedule");
}

}  // namespace

std::vector<std::string> hd_library_candidates() {
  if (const char* chosen = std::getenv("OSTEON_HD_LIBRARY"); chosen && *chosen) return {chosen};
#ifdef _WIN32
  return {"HD.dll"};
#else
  return {"libHD.so.3.4", "libHD.so"};
#endif
}

Result<HdApi> load_hd_api(std::span<const std::string> candidates) {
  const auto library = load_shared_library(candidates);
  if (!library) {
    const std::string name = candidates.empty() ? "libHD" : candidates.back();
    const std::string& said = library.error().where;
    return fail(said.empty() ? name + " was not found" : name + " could not be loaded: " + said,
                "OpenHaptics",
                "Install OpenHaptics and the device's driver from its maker, or name the library "
                "in OSTEON_HD_LIBRARY");
  }
  HdApi api;
  Binder bind(*library);
  bind_device_calls(bind, api);
  bind_state_calls(bind, api);
  bind_scheduler_calls(bind, api);
  if (!bind.missing().empty())
    return fail("the OpenHaptics library lacks " + bind.missing(), candidates.back(),
                "Install OpenHaptics 3.4 or newer");
  return api;
}

}  // namespace osteon
