#include "ui/desktop_portal.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "ui/libsdbus.h"

namespace osteon {
namespace {

constexpr const char* kPortal = "org.freedesktop.portal.Desktop";
constexpr const char* kPortalPath = "/org/freedesktop/portal/desktop";
constexpr const char* kFileChooser = "org.freedesktop.portal.FileChooser";
constexpr const char* kPortalRequest = "org.freedesktop.portal.Request";
constexpr const char* kChooserWords = "The desktop's file chooser";
constexpr const char* kPortalToken = "osteon";
constexpr const char* kUseList = "Choose in the list of folders instead";
constexpr std::uint64_t kPortalWait_us = 100'000;
constexpr std::uint32_t kAnswered = 0, kCancelled = 1;

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// A connection to the session's bus; closed at the end.
class SessionBus {
 public:
  explicit SessionBus(const Libsdbus& calls) : calls_(calls) {
    if (calls_.open_user(&bus_) < 0) bus_ = nullptr;
  }
  ~SessionBus() {
    if (bus_) calls_.flush_close_unref(bus_);
  }
  SessionBus(const SessionBus&) = delete;
  SessionBus& operator=(const SessionBus&) = delete;

  explicit operator bool() const { return bus_ != nullptr; }
  SdBus* get() const { return bus_; }
  const Libsdbus& calls() const { return calls_; }

 private:
  const Libsdbus& calls_;
  SdBus* bus_ = nullptr;
};

/// What the portal answered to one question.
struct PortalAnswer {
  const Libsdbus* calls = nullptr;
  bool came = false;
  std::uint32_t how = kCancelled;
  std::vector<std::string> uris;
};

void read_uris(const Libsdbus& calls, SdBusMessage* message, std::vector<std::string>& uris) {
  if (calls.message_enter_container(message, 'v', "as") <= 0) return;
  if (calls.message_enter_container(message, 'a', "s") < 0) return;
  for (const char* uri = nullptr; calls.message_read(message, "s", &uri) > 0;) uris.push_back(uri);
  calls.message_exit_container(message);
  calls.message_exit_container(message);
}

int take_answer(SdBusMessage* message, void* user, void*) {
  auto& answer = *static_cast<PortalAnswer*>(user);
  const Libsdbus& calls = *answer.calls;
  if (answer.came || calls.message_read(message, "u", &answer.how) <= 0) return 0;
  answer.came = true;
  if (calls.message_enter_container(message, 'a', "{sv}") < 0) return 0;
  while (calls.message_enter_container(message, 'e', "sv") > 0) {
    const char* key = nullptr;
    if (calls.message_read(message, "s", &key) <= 0) break;
    if (std::strcmp(key, "uris") == 0)
      read_uris(calls, message, answer.uris);
    else if (calls.message_skip(message, "v") < 0)
      break;
    if (calls.message_exit_container(message) < 0) break;
  }
  return 0;
}

bool listen(const SessionBus& bus, const std::string& handle, PortalAnswer& answer) {
  return bus.calls().match_signal(bus.get(), nullptr, kPortal, handle.c_str(), kPortalRequest,
                                  "Response", &take_answer, &answer) >= 0;
}

// A portal answers on an object whose name follows from the caller's and the token, so that one can
// listen before one asks. Each question has a connection of its own.
std::string handle_for(const SessionBus& bus) {
  const char* unique = nullptr;
  if (bus.calls().get_unique_name(bus.get(), &unique) < 0) return {};
  std::string sender = unique + 1;  // after the colon
  std::replace(sender.begin(), sender.end(), '.', '_');
  return std::string(kPortalPath) + "/request/" + sender + "/" + kPortalToken;
}

// The handle that the portal gives; empty: it does not take the question.
std::string show_chooser(const SessionBus& bus, const DesktopQuestion& question) {
  const Libsdbus& calls = bus.calls();
  SdBusMessage* reply = nullptr;
  const int several = question.folder ? 0 : 1;
  if (calls.call_method(bus.get(), kPortal, kPortalPath, kFileChooser, "OpenFile", nullptr, &reply,
                        "ssa{sv}", question.parent.c_str(), question.title.c_str(), 3,
                        "handle_token", "s", kPortalToken, "multiple", "b", several, "directory",
                        "b", question.folder ? 1 : 0) < 0)
    return {};
  const char* handle = nullptr;
  const std::string given = calls.message_read(reply, "o", &handle) > 0 ? handle : "";
  calls.message_unref(reply);
  return given;
}

Result<std::vector<std::string>> paths_of(const PortalAnswer& answer) {
  std::vector<std::string> paths;
  if (answer.how == kCancelled) return paths;
  if (answer.how != kAnswered) return fail("ended without an answer", kChooserWords, kUseList);
  for (const std::string& uri : answer.uris)
    if (const auto path = path_of_uri(uri)) paths.push_back(*path);
  if (paths.empty())
    return fail("what was chosen is not a file of this computer", kChooserWords, kUseList);
  return paths;
}

}  // namespace

std::optional<std::string> path_of_uri(const std::string& uri) {
  std::string_view rest = uri;
  for (const std::string_view start : {"file://localhost/", "file:///"}) {
    if (!rest.starts_with(start)) continue;
    rest.remove_prefix(start.size() - 1);
    std::string path;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const bool escaped = rest[i] == '%' && i + 2 < rest.size() && hex_digit(rest[i + 1]) >= 0 &&
                           hex_digit(rest[i + 2]) >= 0;
      path += escaped ? static_cast<char>(16 * hex_digit(rest[i + 1]) + hex_digit(rest[i + 2]))
                      : rest[i];
      if (escaped) i += 2;
    }
    return path;
  }
  return std::nullopt;
}

unsigned desktop_chooser_version() {
  const auto calls = load_libsdbus(libsdbus_file());
  if (!calls) return 0;
  const SessionBus bus(*calls);
  std::uint32_t version = 0;
  if (!bus || calls->get_property_trivial(bus.get(), kPortal, kPortalPath, kFileChooser, "version",
                                          nullptr, 'u', &version) < 0)
    return 0;
  return version;
}

Result<std::vector<std::string>> choose_on_desktop(const DesktopQuestion& question,
                                                   const Progress& progress) {
  const auto calls = load_libsdbus(libsdbus_file());
  if (!calls) return tl::unexpected(calls.error());
  const SessionBus bus(*calls);
  if (!bus) return fail("its message bus cannot be reached", kChooserWords, kUseList);
  PortalAnswer answer;
  answer.calls = &*calls;
  const std::string expected = handle_for(bus);
  if (!listen(bus, expected, answer))
    return fail("its message bus does not listen", kChooserWords, kUseList);
  const std::string handle = show_chooser(bus, question);
  if (handle.empty()) return fail("does not open", kChooserWords, kUseList);
  if (handle != expected && !listen(bus, handle, answer))  // portals before 0.9
    return fail("its message bus does not listen", kChooserWords, kUseList);
  while (!answer.came) {
    if (!goes_on(progress, "Waiting for the desktop's file chooser", 0)) {
      calls->call_method(bus.get(), kPortal, handle.c_str(), kPortalRequest, "Close", nullptr,
                         nullptr, "");
      return std::vector<std::string>{};
    }
    const int did = calls->process(bus.get(), nullptr);
    if (did < 0 || (did == 0 && calls->wait(bus.get(), kPortalWait_us) < 0))
      return fail("its message bus has closed", kChooserWords, kUseList);
  }
  return paths_of(answer);
}

}  // namespace osteon
