#include "runs/pictures/film_queue.h"

#include <new>
#include <utility>

namespace osteon {
namespace {

constexpr std::size_t kMostBehind = 2;  // pictures; one has 50 MB at most

}  // namespace

FilmQueue::FilmQueue(FilmWriter writer) : writer_(std::move(writer)), thread_([this] { run(); }) {}

FilmQueue::~FilmQueue() {
  {
    const std::scoped_lock lock(mutex_);
    waiting_.clear();
  }
  close();
}

Result<void> FilmQueue::add(std::vector<float> sound, Image picture) {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return failure_ || waiting_.size() < kMostBehind; });
    if (failure_) return tl::unexpected(*failure_);
    waiting_.push_back({std::move(sound), std::move(picture)});
  }
  changed_.notify_all();
  return {};
}

void FilmQueue::close() {
  {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

Result<void> FilmQueue::finish() {
  close();
  if (failure_) return tl::unexpected(*failure_);
  return writer_.finish();
}

bool FilmQueue::take(Next& next) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || !waiting_.empty(); });
  if (waiting_.empty()) return false;
  next = std::move(waiting_.front());
  waiting_.pop_front();
  lock.unlock();
  changed_.notify_all();
  return true;
}

void FilmQueue::run() {
  const auto write = [this](const Next& next) -> Result<void> {
    try {
      if (auto ok = writer_.add_sound(next.sound); !ok) return ok;
      return writer_.add_picture(next.picture.rgb);
    } catch (const std::bad_alloc&) {
      return fail("there is not enough memory", "the film", "Close other programs");
    }
  };
  for (Next next; take(next);) {
    auto written = write(next);
    if (written) continue;
    {
      const std::scoped_lock lock(mutex_);
      failure_ = written.error();
    }
    changed_.notify_all();
    return;
  }
}

}  // namespace osteon
