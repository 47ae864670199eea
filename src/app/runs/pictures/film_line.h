#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>

#include "osteon/base/result.h"

namespace osteon {

/// A step in making a film that is done on a thread of its own, for one item after the other in the
/// order in which they are given, so that the step before it goes on meanwhile.
template <class Item>
class FilmLine {
 public:
  using Work = std::function<Result<void>(Item&)>;
  /// Called once, on the thread: what it makes is used and goes there alone (a graphics context).
  using Begin = std::function<Result<Work>()>;

  FilmLine(Begin begin, std::size_t most_behind)
      : begin_(std::move(begin)), most_behind_(most_behind), thread_([this] { run(); }) {}
  /// What is not done yet is given up.
  ~FilmLine() {
    {
      const std::scoped_lock lock(mutex_);
      waiting_.clear();
    }
    close();
  }
  FilmLine(const FilmLine&) = delete;
  FilmLine& operator=(const FilmLine&) = delete;

  /// Waits until it has begun. Fails where it could not.
  Result<void> begun() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return begun_ || failure_; });
    return told();
  }
  /// Waits while it is as many items behind as it may be. Fails where the work failed on this one
  /// or one before it.
  Result<void> add(Item item) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return failure_ || waiting_.size() < most_behind_; });
      if (failure_) return told();
      waiting_.push_back(std::move(item));
    }
    changed_.notify_all();
    return {};
  }
  /// Waits until all is done. Once.
  Result<void> finish() {
    close();
    return told();
  }

 private:
  Result<void> told() const {
    if (failure_) return tl::unexpected(*failure_);
    return {};
  }
  void close() {
    {
      const std::scoped_lock lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
  }
  bool take(Item& next) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return closed_ || !waiting_.empty(); });
      if (waiting_.empty()) return false;
      next = std::move(waiting_.front());
      waiting_.pop_front();
    }
    changed_.notify_all();
    return true;
  }
  Result<void> work_on_all() {
    auto work = begin_();
    if (!work) return tl::unexpected(work.error());
    {
      const std::scoped_lock lock(mutex_);
      begun_ = true;
    }
    changed_.notify_all();
    for (Item next; take(next);)
      if (auto done = (*work)(next); !done) return done;
    return {};
  }
  // An exception must not leave a thread.
  Result<void> try_all() {
    try {
      return work_on_all();
    } catch (const std::bad_alloc&) {
      return fail("there is not enough memory", "the film", "Close other programs");
    } catch (const std::exception& error) {
      return fail(error.what(), "the film");
    }
  }
  void run() {
    const auto done = try_all();
    if (done) return;
    {
      const std::scoped_lock lock(mutex_);
      failure_ = done.error();
    }
    changed_.notify_all();
  }

  Begin begin_;
  std::size_t most_behind_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> waiting_;
  bool begun_ = false;
  bool closed_ = false;           ///< nothing more comes
  std::optional<Error> failure_;  ///< of the first item on which the work failed
  std::thread thread_;
};

}  // namespace osteon
