#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "osteon/render/renderer.h"
#include "segment/segment_work.h"
#include "segment/segmenting.h"
#include "ui/camera_control.h"
#include "ui/side_job.h"

namespace osteon {

/// The bones of a segmentation as surfaces, drawn anew on a thread of its own after each change,
/// one bone after the other. Its World is the scan's Patient, head up. Shows kMaxBones at most.
/// Needs a current OpenGL context in every call and in the destructor.
class SolidView {
 public:
  static Result<std::unique_ptr<SolidView>> create(const GridFrame& frame);

  /// Takes surfaces that are done and begins the next; once a frame.
  void update(const Segmenting& segmenting);
  /// Turns the view; returns the label that was clicked on, 0: none.
  std::uint16_t steer(const SceneInput& input, const Viewport& viewport);
  void draw(const Viewport& viewport);
  /// A surface is being drawn or waits for it.
  bool busy() const { return busy_; }
  bool shows_anything() const;

 private:
  struct Slot {
    std::uint16_t label = 0;    ///< 0: free
    std::uint64_t version = 0;  ///< of the surface that it has, or that could not be drawn
    bool drawn = false;
    Aabb box_W;
  };
  explicit SolidView(Renderer renderer) : renderer_(std::move(renderer)) {}
  void drop_gone(const LabelEdit& edit);
  void take_surface(const LabelEdit& edit);
  void begin_next(const Segmenting& segmenting);
  void show_as(const Segmenting& segmenting);
  Slot* slot_of(std::uint16_t label);
  Slot* slot_for(std::uint16_t label);
  bool is_due(const LabelEdit& edit, std::uint16_t label);
  void look_at_all();

  Renderer renderer_;
  RenderSnapshot snapshot_;
  ViewState view_;
  CameraControl control_;
  std::array<Slot, kMaxBones> slots_;
  std::unique_ptr<SideJob<PreviewSurface>> job_;
  std::uint16_t job_label_ = 0;
  std::uint64_t job_version_ = 0;
  bool busy_ = false;
  bool steered_ = false;  ///< the user has turned it: it is no longer framed by itself
};

}  // namespace osteon
