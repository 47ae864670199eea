#pragma once

#include <cstdint>
#include <map>
#include <utility>

namespace osteon {

/// What a cache holds in memory: entries by key, and which of them were asked for or put.
template <class T>
class KeyedEntries {
 public:
  /// Takes what a file holds, where nothing stands yet.
  void take(std::map<std::uint64_t, T> read) {
    for (auto& [key, value] : read) entries_.try_emplace(key, Entry{std::move(value), false});
  }
  const T* find(std::uint64_t key) {
    const auto at = entries_.find(key);
    if (at == entries_.end()) return nullptr;
    at->second.used = true;
    return &at->second.value;
  }
  void put(std::uint64_t key, T value) {
    entries_[key] = {std::move(value), true};
    changed_ = true;
  }
  /// Whether anything was put since the start or the last `saved`.
  bool changed() const { return changed_; }
  void saved() { changed_ = false; }
  /// What was found or put since the start.
  std::map<std::uint64_t, T> used() const {
    std::map<std::uint64_t, T> out;
    for (const auto& [key, entry] : entries_)
      if (entry.used) out.emplace(key, entry.value);
    return out;
  }

 private:
  struct Entry {
    T value;
    bool used = false;
  };
  std::map<std::uint64_t, Entry> entries_;
  bool changed_ = false;
};

}  // namespace osteon
