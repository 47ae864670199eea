#pragma once

#include "osteon/base/types.h"
#include "osteon/render/camera.h"
#include "osteon/scene/case.h"

namespace osteon {

/// Directions of a hand in World: unit, at right angles to each other. Of a knee: proximal, to the
/// front, and lateral stand in the places of distal, dorsal and radial.
struct AnatomicalFrame {
  Vec3 distal_W = Vec3::UnitY();   ///< towards the finger tips; upwards in every preset view
  Vec3 dorsal_W = Vec3::UnitZ();   ///< out of the back of the hand
  Vec3 radial_W = -Vec3::UnitX();  ///< towards the thumb
  bool from_bones = false;         ///< false: the bones did not tell, these are World's axes
};

/// Frame of the case's rest pose. Distal runs from the radius (the ulna, else the mean of the
/// carpal bones) to the third metacarpal's centroid, radial from the ulna (the fifth metacarpal) to
/// the radius (the second metacarpal); the pisiform, which lies palmar of the triquetrum, tells the
/// back from the palm, else the case's side does (right when it does not say). A knee is told by
/// its femur, tibia, fibula and patella. World's axes (z
/// dorsal, y distal, the right hand's -x radial) when these bones are missing or lie on a line.
AnatomicalFrame anatomical_frame(const Case& the_case);

/// kAp and kLateral are orthographic, as radiographs are hung: AP as seen from the dorsal side (the
/// wrist's posteroanterior film), lateral as seen from the radial side.
enum class ViewPreset { kDorsal, kPalmar, kRadial, kUlnar, kAp, kLateral };

/// Shares of the picture that something covers at its edges, each 0..1: panels that float over it.
struct CoveredEdges {
  double left = 0, right = 0, bottom = 0, top = 0;
};

/// Camera that frames all of the case in its rest pose, fingers up, as large as it can be in the
/// part of the picture that is not covered, with a margin. An empty case gives the default camera
/// turned to the preset.
Camera preset_camera(ViewPreset preset, const Case& the_case, double aspect,
                     const CoveredEdges& covered = {});

/// The same direction, nearer: frames one bone, or without one the carpal bones, what lies about
/// the patella, or all of a case that has neither.
Camera close_up_camera(const Camera& from, const Case& the_case, BoneId bone, double aspect,
                       const CoveredEdges& covered = {});

}  // namespace osteon
