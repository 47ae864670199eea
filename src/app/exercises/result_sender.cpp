#include "exercises/result_sender.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <vector>

#include "cases/xdg.h"

namespace osteon {
namespace {

std::string lrs_setting(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

std::vector<std::string> sending_words(const std::string& endpoint) {
  std::vector<std::string> words{"osteon", "results", "send", "--to", endpoint};
  const std::string user = lrs_setting("OSTEON_LRS_USER");
  const std::string certificates = lrs_setting("OSTEON_LRS_CERTIFICATES");
  if (!user.empty()) words.insert(words.end(), {"--user", user});
  if (!certificates.empty()) words.insert(words.end(), {"--certificates", certificates});
  return words;
}

// After a fork: nothing here may allocate. Whoever reads the caller's output must not wait for it.
[[noreturn]] void become_sender(char* const* words, const char* log) {
  const int nothing = ::open("/dev/null", O_RDWR);
  int out = ::open(log, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (out < 0) out = nothing;
  ::dup2(nothing, 0);
  ::dup2(out, 1);
  ::dup2(out, 2);
  for (int fd = 3; fd < 1024; ++fd) ::close(fd);
  ::execv("/proc/self/exe", words);
  ::_exit(127);
}

}  // namespace

std::filesystem::path sending_log() { return data_home_dir() / "sending.log"; }

bool send_results_in_background() {
  const std::string endpoint = lrs_setting("OSTEON_LRS");
  if (endpoint.empty()) return false;
  std::vector<std::string> text = sending_words(endpoint);
  std::vector<char*> words;
  for (std::string& word : text) words.push_back(word.data());
  words.push_back(nullptr);
  const std::string log = sending_log().string();
  // A child of a child, which has left: nobody need wait for the one that sends.
  const pid_t child = ::fork();
  if (child < 0) return false;
  if (child == 0) {
    ::setsid();
    const pid_t sender = ::fork();
    if (sender != 0) ::_exit(sender < 0 ? 1 : 0);
    become_sender(words.data(), log.c_str());
  }
  int status = 0;
  pid_t ended;
  do {
    ended = ::waitpid(child, &status, 0);
  } while (ended < 0 && errno == EINTR);
  if (ended != child) return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace osteon
