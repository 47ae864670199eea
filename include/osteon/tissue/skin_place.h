#pragma once

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/tissue/skin_scene.h"

namespace osteon {

/// The frame of a sheet on a body's skin: at the skin's point nearest `near_W`, z out of it by the
/// mean normal within `reach_m`, y towards `up_W` as far as that lies across z, then turned about
/// z. Fails where the skin is empty or `up_W` goes straight out of it.
Result<Pose> sheet_frame(const TriMesh& skin_W, const Vec3& near_W, const Vec3& up_W,
                         double turn_rad, double reach_m);

/// A sheet's surface laid on the skin: each vertex goes along z by the height of the skin there.
/// The way along the skin is not stretched, so a sheet is to lie where the skin is nearly flat.
/// Fails where the skin is not under all of the sheet.
Result<TriMesh> lay_on(const TriMesh& skin_W, const Pose& X_WS, const TriMesh& surface_S);

/// The skin with the sheet's rectangle cut out of it. Its first vertices are the skin's own; those
/// on the rectangle's border follow.
TriMesh around(const TriMesh& skin_W, const Pose& X_WS, double width_m, double height_m);

}  // namespace osteon
