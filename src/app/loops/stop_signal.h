#pragma once

namespace osteon {

/// While one exists, SIGINT, SIGTERM and SIGHUP ask the loops to end instead of killing the
/// program, so that the motors are left at zero and the recording is closed. A second signal kills
/// as usual. An uncaught exception, an abort and a crash (SIGSEGV, SIGBUS, SIGFPE, SIGILL) on any
/// thread but the haptic loop's give that loop a moment to do the same before the program dies.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
};

/// A loop that has a device to leave at zero holds one, made and ended on the loop's own thread. A
/// dying program waits for those of other threads, three seconds at most; for anything else only a
/// moment.
class LoopToEnd {
 public:
  LoopToEnd();
  ~LoopToEnd();
  LoopToEnd(const LoopToEnd&) = delete;
  LoopToEnd& operator=(const LoopToEnd&) = delete;
};

/// A signal, or the end of the program, has asked every loop to end. Any thread.
bool stop_requested();
/// Which signal; 0: none. A program that ends by it returns 128 more.
int stop_signal();

}  // namespace osteon
