#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <thread>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Saves an edited bone as a new case on a thread of its own: a built-in case is grown anew for it,
/// which takes seconds.
class EditSave {
 public:
  EditSave(std::string case_spec, std::string bone_name, TriMesh mesh_B, std::filesystem::path out);
  /// Waits for the thread.
  ~EditSave();
  EditSave(const EditSave&) = delete;
  EditSave& operator=(const EditSave&) = delete;

  bool done() const { return done_.load(std::memory_order_acquire); }
  /// After `done`: whether it was saved.
  const Result<void>& result() const { return result_; }
  const std::filesystem::path& folder() const { return out_; }

 private:
  std::filesystem::path out_;
  Result<void> result_;
  std::atomic<bool> done_{false};
  std::thread thread_;
};

}  // namespace osteon
