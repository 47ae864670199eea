#include "window/jobs/edit_save.h"

#include <new>
#include <utility>

#include "window/controllers/bone_edit.h"

namespace osteon {

EditSave::EditSave(std::string case_spec, std::string bone_name, TriMesh mesh_B,
                   std::filesystem::path out)
    : out_(std::move(out)),
      thread_([this, spec = std::move(case_spec), name = std::move(bone_name),
               mesh = std::move(mesh_B)] {
        try {
          result_ = save_edited_case(spec, name, mesh, out_);
        } catch (const std::bad_alloc&) {
          result_ = fail("there is not enough memory", {}, "Close other programs and try again");
        }
        done_.store(true, std::memory_order_release);
      }) {}

EditSave::~EditSave() { thread_.join(); }

}  // namespace osteon
