// The counters behind count_locks.h: the program's own pthread_mutex_lock and write stand before
// those of the C library, which they call.
#include "count_locks.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <unistd.h>

#include <mutex>

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
#define OSTEON_COUNTS_LOCKS 0
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer) || __has_feature(address_sanitizer)
#define OSTEON_COUNTS_LOCKS 0
#endif
#endif
#ifndef OSTEON_COUNTS_LOCKS
#define OSTEON_COUNTS_LOCKS 1
#endif

namespace {
thread_local std::uint64_t lock_count = 0;
thread_local std::uint64_t write_count = 0;
}  // namespace

#if OSTEON_COUNTS_LOCKS
namespace {

using Lock = int (*)(pthread_mutex_t*);
using Write = ssize_t (*)(int, const void*, size_t);

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) {
  static const Lock real = next<Lock>("pthread_mutex_lock");
  ++lock_count;
  return real(mutex);
}

extern "C" ssize_t write(int file, const void* data, size_t size) {
  static const Write real = next<Write>("write");
  ++write_count;
  return real(file, data, size);
}
#endif

namespace osteon {

std::uint64_t testing::locks() { return lock_count; }
std::uint64_t testing::writes() { return write_count; }
bool testing::counts_locks() { return OSTEON_COUNTS_LOCKS != 0; }

namespace {

TEST(Locks, TheCountersCount) {
  if (!testing::counts_locks()) GTEST_SKIP() << "not under a sanitizer";
  std::mutex mutex;
  const std::uint64_t locked = testing::locks(), written = testing::writes();
  { const std::lock_guard<std::mutex> held(mutex); }
  EXPECT_EQ(testing::locks(), locked + 1);
  EXPECT_EQ(::write(STDOUT_FILENO, "", 0), 0);
  EXPECT_EQ(testing::writes(), written + 1);
}

}  // namespace
}  // namespace osteon
