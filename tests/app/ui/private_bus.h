#pragma once

// A message bus of the test's own, and a desktop's portal on it whose user answers at once.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "ui/libsdbus.h"

namespace osteon {

/// dbus-daemon with nothing on it; the session's bus of this process while it lives.
class PrivateBus {
 public:
  PrivateBus() {
    const char* before = std::getenv("DBUS_SESSION_BUS_ADDRESS");
    before_ = before ? before : "";
    dir_ = std::filesystem::temp_directory_path() / ("osteon_bus_" + std::to_string(::getpid()));
    std::filesystem::create_directories(dir_);
    std::ofstream(dir_ / "bus.conf")
        << "<busconfig><type>session</type><listen>unix:path=" << (dir_ / "bus").string()
        << "</listen><policy context=\"default\"><allow send_destination=\"*\"/>"
           "<allow receive_sender=\"*\"/><allow own=\"*\"/></policy></busconfig>";
    start();
    ::setenv("DBUS_SESSION_BUS_ADDRESS", address_.c_str(), 1);
  }
  ~PrivateBus() {
    if (daemon_ > 0) {
      ::kill(daemon_, SIGTERM);
      ::waitpid(daemon_, nullptr, 0);
    }
    ::setenv("DBUS_SESSION_BUS_ADDRESS", before_.c_str(), 1);
    std::filesystem::remove_all(dir_);
  }
  PrivateBus(const PrivateBus&) = delete;
  PrivateBus& operator=(const PrivateBus&) = delete;

  bool works() const { return !address_.empty(); }

 private:
  // Its address comes once it listens.
  void start() {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return;
    const std::string config = "--config-file=" + (dir_ / "bus.conf").string();
    const std::string tell = "--print-address=" + std::to_string(ends[1]);
    daemon_ = ::fork();
    if (daemon_ == 0) {
      ::execlp("dbus-daemon", "dbus-daemon", config.c_str(), "--nofork", tell.c_str(), nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) address_ += c;
    ::close(ends[0]);
  }

  std::filesystem::path dir_;
  std::string before_, address_;
  pid_t daemon_ = -1;
};

/// org.freedesktop.portal.Desktop, answered by a thread.
class FakePortal {
 public:
  struct Manners {
    std::uint32_t version = 4;
    std::uint32_t response = 0;  ///< 0 chosen, 1 cancelled, 2 ended otherwise
    std::string uri = "file:///tmp/a%20case";
    bool answers = true;      ///< else the user leaves the chooser open
    bool own_handle = false;  ///< another object than the token says, as old portals
  };

  explicit FakePortal(const Manners& manners) : manners_(manners) {
    load();
    EXPECT_GE(calls_.open_user(&bus_), 0);
    EXPECT_GE(request_name_(bus_, "org.freedesktop.portal.Desktop", 0), 0);
    EXPECT_GE(add_filter_(bus_, nullptr, &FakePortal::take, this), 0);
    thread_ = std::thread([this] {
      while (!stop_)
        if (calls_.process(bus_, nullptr) == 0) calls_.wait(bus_, 10'000);
    });
  }
  ~FakePortal() {
    stop_ = true;
    thread_.join();
    calls_.flush_close_unref(bus_);
  }
  FakePortal(const FakePortal&) = delete;
  FakePortal& operator=(const FakePortal&) = delete;

  bool asked() const { return asked_; }
  bool closed() const { return closed_; }
  /// Of the last question, once `asked`.
  bool for_folder() const { return for_folder_; }
  bool for_several() const { return for_several_; }
  const std::string& parent() const { return parent_; }

 private:
  void load() {
    calls_ = load_libsdbus(libsdbus_file()).value();
    void* library = ::dlopen(libsdbus_file().c_str(), RTLD_NOW | RTLD_LOCAL);
    const auto find = [&](auto& function, const char* name) {
      function =
          reinterpret_cast<std::remove_reference_t<decltype(function)>>(::dlsym(library, name));
      ASSERT_TRUE(function) << name;
    };
    find(request_name_, "sd_bus_request_name");
    find(add_filter_, "sd_bus_add_filter");
    find(is_call_, "sd_bus_message_is_method_call");
    find(reply_, "sd_bus_reply_method_return");
    find(emit_, "sd_bus_emit_signal");
    find(sender_, "sd_bus_message_get_sender");
  }

  static int take(SdBusMessage* message, void* user, void*) {
    return static_cast<FakePortal*>(user)->answer(message);
  }

  int answer(SdBusMessage* message) {
    if (is_call_(message, "org.freedesktop.DBus.Properties", "Get") > 0)
      return reply_(message, "v", "u", manners_.version);
    if (is_call_(message, "org.freedesktop.portal.Request", "Close") > 0) {
      closed_ = true;
      return reply_(message, "");
    }
    if (is_call_(message, "org.freedesktop.portal.FileChooser", "OpenFile") <= 0) return 0;
    const std::string handle = read_question(message);
    reply_(message, "o", handle.c_str());
    if (manners_.answers)
      emit_(bus_, handle.c_str(), "org.freedesktop.portal.Request", "Response", "ua{sv}",
            manners_.response, 2, "choices", "a(ss)", 0, "uris", "as", 1, manners_.uri.c_str());
    asked_ = true;
    return 1;
  }

  std::string read_question(SdBusMessage* message) {
    const char *parent = nullptr, *title = nullptr, *key = nullptr, *token = nullptr;
    calls_.message_read(message, "ss", &parent, &title);
    parent_ = parent;
    calls_.message_enter_container(message, 'a', "{sv}");
    while (calls_.message_enter_container(message, 'e', "sv") > 0) {
      calls_.message_read(message, "s", &key);
      const std::string option = key;
      int on = 0;
      if (option == "handle_token")
        calls_.message_read(message, "v", "s", &token);
      else
        calls_.message_read(message, "v", "b", &on);
      if (option == "directory") for_folder_ = on != 0;
      if (option == "multiple") for_several_ = on != 0;
      calls_.message_exit_container(message);
    }
    if (manners_.own_handle) return "/org/freedesktop/portal/desktop/request/7";
    std::string sender = sender_(message) + 1;
    for (char& c : sender)
      if (c == '.') c = '_';
    return "/org/freedesktop/portal/desktop/request/" + sender + "/" + token;
  }

  Manners manners_;
  Libsdbus calls_;
  SdBus* bus_ = nullptr;
  int (*request_name_)(SdBus*, const char*, std::uint64_t) = nullptr;
  int (*add_filter_)(SdBus*, void**, SdBusHandler, void*) = nullptr;
  int (*is_call_)(SdBusMessage*, const char*, const char*) = nullptr;
  int (*reply_)(SdBusMessage*, const char*, ...) = nullptr;
  int (*emit_)(SdBus*, const char*, const char*, const char*, const char*, ...) = nullptr;
  const char* (*sender_)(SdBusMessage*) = nullptr;
  std::atomic<bool> stop_{false}, asked_{false}, closed_{false};
  bool for_folder_ = false, for_several_ = false;
  std::string parent_;
  std::thread thread_;
};

}  // namespace osteon
