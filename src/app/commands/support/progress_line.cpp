#include "commands/support/progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <stdexcept>

namespace osteon {
namespace {

// A signal handler can reach nothing but a global of this type.
volatile std::sig_atomic_t interrupted = 0;
void on_interrupt(int) { interrupted = 1; }

// One command line is one program: what it said of silence holds to its end.
bool silent = false;

}  // namespace

ProgressLine::ProgressLine() : terminal_(!silent && ::isatty(STDERR_FILENO) == 1) {
  interrupted = 0;
  before_ = std::signal(SIGINT, on_interrupt);
}

ProgressLine::~ProgressLine() {
  std::signal(SIGINT, before_ == SIG_ERR ? SIG_DFL : before_);
  if (!shown_.empty()) std::fprintf(stderr, "\r%*s\r", 72, "");
}

Progress ProgressLine::callback() {
  return [this](const char* what, double share) { return show(what, share); };
}

std::function<void(const char* what, double share)> ProgressLine::stopping() {
  return [this](const char* what, double share) {
    if (!show(what, share)) throw std::runtime_error("stopped; nothing was written");
  };
}

void ProgressLine::keep_silent() { silent = true; }

bool ProgressLine::show(const char* what, double share) {
  if (interrupted) return false;
  if (!terminal_) return true;
  const int done = static_cast<int>(std::clamp(share, 0.0, 1.0) * 20);
  std::string line = "\r[" + std::string(static_cast<std::size_t>(done), '#') +
                     std::string(static_cast<std::size_t>(20 - done), ' ') + "] " + what;
  line.resize(72, ' ');
  if (line == shown_) return true;
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  shown_ = line;
  return true;
}

}  // namespace osteon
