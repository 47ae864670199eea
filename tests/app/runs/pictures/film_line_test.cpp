#include "runs/pictures/film_line.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace osteon {
namespace {

using Numbers = FilmLine<int>;

TEST(FilmLine, DoesAllInOrderOnOneThreadOfItsOwn) {
  std::vector<int> done;
  std::vector<std::thread::id> threads;
  Numbers line(
      [&]() -> Result<Numbers::Work> {
        threads.push_back(std::this_thread::get_id());
        return [&](const int& k) -> Result<void> {
          threads.push_back(std::this_thread::get_id());
          done.push_back(k);
          return {};
        };
      },
      2);
  ASSERT_TRUE(line.begun());
  for (int k = 0; k < 50; ++k) ASSERT_TRUE(line.add(k));
  ASSERT_TRUE(line.finish());
  ASSERT_EQ(done.size(), 50u);
  for (int k = 0; k < 50; ++k) EXPECT_EQ(done[static_cast<std::size_t>(k)], k);
  for (const std::thread::id id : threads) {
    EXPECT_EQ(id, threads.front());
    EXPECT_NE(id, std::this_thread::get_id());
  }
}

TEST(FilmLine, WhatCannotBeginIsTold) {
  Numbers line([]() -> Result<Numbers::Work> { return fail("is not there", "the screen"); }, 2);
  const auto begun = line.begun();
  ASSERT_FALSE(begun);
  EXPECT_NE(begun.error().message().find("the screen"), std::string::npos);
  EXPECT_FALSE(line.add(1));
  EXPECT_FALSE(line.finish());
}

TEST(FilmLine, AfterAFailureNothingWaitsForIt) {
  int calls = 0;
  Numbers line(
      [&]() -> Result<Numbers::Work> {
        return [&](const int& k) -> Result<void> {
          ++calls;
          if (k == 3) return fail("is full", "the disk");
          return {};
        };
      },
      1);
  for (int k = 0; k < 20; ++k) (void)line.add(k);
  EXPECT_FALSE(line.add(20));
  const auto ended = line.finish();
  ASSERT_FALSE(ended);
  EXPECT_NE(ended.error().message().find("the disk"), std::string::npos) << ended.error().message();
  EXPECT_EQ(calls, 4);
}

TEST(FilmLine, AnExceptionIsAFailure) {
  Numbers line(
      []() -> Result<Numbers::Work> {
        return [](const int&) -> Result<void> { throw std::runtime_error("out of ink"); };
      },
      2);
  (void)line.add(1);
  const auto ended = line.finish();
  ASSERT_FALSE(ended);
  EXPECT_NE(ended.error().message().find("out of ink"), std::string::npos);
}

TEST(FilmLine, WhatMadeTheWorkGoesOnItsThread) {
  struct Owner {
    explicit Owner(std::thread::id* at) : went(at) {}
    std::thread::id* went;
    ~Owner() { *went = std::this_thread::get_id(); }
  };
  std::thread::id went, worked;
  {
    Numbers line(
        [&]() -> Result<Numbers::Work> {
          worked = std::this_thread::get_id();
          return
              [owner = std::make_shared<Owner>(&went)](const int&) -> Result<void> { return {}; };
        },
        2);
    ASSERT_TRUE(line.begun());
    (void)line.add(1);
  }
  EXPECT_EQ(went, worked);
}

}  // namespace
}  // namespace osteon
