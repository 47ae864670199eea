// The tick must not touch the heap, a lock or a file. This program's own malloc, mutex and write
// stand before the C library's and count.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>

#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "test_scene.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define OSTEON_SANITIZED 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define OSTEON_SANITIZED 1
#endif

#if defined(__GLIBC__) && !defined(OSTEON_SANITIZED)
#include <dlfcn.h>
#include <pthread.h>
#include <sys/types.h>

namespace {
thread_local bool watching = false;
thread_local int heap_calls = 0;
thread_local int lock_calls = 0;
thread_local int write_calls = 0;

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}
}  // namespace

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) noexcept {
  heap_calls += watching;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  heap_calls += watching;
  return __libc_calloc(count, size);
}
void* realloc(void* p, std::size_t size) noexcept {
  heap_calls += watching;
  return __libc_realloc(p, size);
}
void free(void* p) noexcept {
  heap_calls += watching && p;
  __libc_free(p);
}
int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  static const auto real = next<int (*)(pthread_mutex_t*)>("pthread_mutex_lock");
  lock_calls += watching;
  return real(mutex);
}
ssize_t write(int file, const void* data, std::size_t size) {
  static const auto real = next<ssize_t (*)(int, const void*, std::size_t)>("write");
  write_calls += watching;
  return real(file, data, size);
}
}

namespace osteon {
namespace {

using test::Rig;

TEST(Realtime, TheWatchSeesWhatItShould) {
  watching = true;
  void* block = ::operator new(16);
  ::operator delete(block);
  watching = false;
  EXPECT_GE(heap_calls, 2);
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  watching = true;
  pthread_mutex_lock(&mutex);
  pthread_mutex_unlock(&mutex);
  const auto written = write(-1, "", 0);
  watching = false;
  EXPECT_EQ(written, -1);
  EXPECT_GE(lock_calls, 1);
  EXPECT_GE(write_calls, 1);
}

void expect_no_calls(Tool tool) {
  std::vector<Bone> bones;
  Random random(2);
  for (int i = 0; i < 12; ++i) {
    Pose X_WB;
    const Vec3 dir = random.direction();
    X_WB.p = 0.014 * dir;
    X_WB.q = random.rotation();
    bones.push_back(test::bone_of(
        {test::box_hull(Vec3(0.005, 0.004, 0.003)), test::box_hull(Vec3(0.003, 0.004, 0.005))},
        X_WB, {2000, 0.3, 0.2}));
  }
  bones.push_back(test::field_bone(test::cube(0.004), {}, {2000, 0.3, 0.2}));
  Rig rig(std::move(bones), std::move(tool));
  rig.params = HapticParams{};
  heap_calls = lock_calls = write_calls = 0;
  int contacts = 0;
  int kinds = 0;
  Vec3 p = Vec3::Zero();
  for (int i = 0; i < 5000; ++i) {
    const Vec3 dir = random.direction();
    p += 0.0004 * dir;
    if (p.norm() > 0.02) p *= 0.3;
    const Quat q = random.rotation();
    ToolInput input;
    input.X_WD = {p, q};
    input.v_W = 0.4 * dir;
    if (i % 500 == 499) input.v_W.x() = std::numeric_limits<double>::quiet_NaN();
    rig.bones.bones[i % 13].X_WB.p += 1e-5 * dir;
    watching = true;
    const ToolState& s = rig.loop.tick(input, rig.bones, 0.001, rig.params);
    watching = false;
    contacts += s.contact_count > 0;
    kinds |= static_cast<int>(s.status);
  }
  EXPECT_EQ(heap_calls, 0);
  EXPECT_EQ(lock_calls, 0);
  EXPECT_EQ(write_calls, 0);
  EXPECT_GT(contacts, 500);
  EXPECT_TRUE(kinds & kTickInputNotFinite);
  EXPECT_TRUE(kinds & kTickSticking);
}

TEST(Realtime, TheTickTouchesNoHeapLockOrFile) { expect_no_calls(make_wrist_probe()); }

TEST(Realtime, NorDoesThatOfAWholeInstrument) {
  Tool tool;
  tool.parts.push_back(make_rod(Vec3::Zero(), Vec3::Zero(), 0.001));
  tool.parts.push_back(make_rod(Vec3(0, 0, 0.004), Vec3(0, 0, 0.05), 0.002));
  tool.parts.push_back(make_box({Vec3(0, 0.004, 0.02), Quat::Identity()}, 0.002 * Vec3::Ones()));
  expect_no_calls(std::move(tool));
}

}  // namespace
}  // namespace osteon
#endif
