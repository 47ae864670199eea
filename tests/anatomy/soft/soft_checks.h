#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "mesh/surface_checks.h"
#include "osteon/anatomy/generate.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/self_crossing.h"

// Checks of soft parts that hold for every patient.
namespace osteon::checks {

inline const GeneratedSoft& soft_named(const GeneratedAnatomy& anatomy, const std::string& name) {
  for (const GeneratedSoft& soft : anatomy.softs)
    if (soft.name == name) return soft;
  throw std::out_of_range(name);
}

inline std::vector<MeshDistance> bone_surfaces_W(const GeneratedAnatomy& anatomy) {
  std::vector<MeshDistance> surfaces;
  for (const GeneratedBone& bone : anatomy.bones) {
    TriMesh mesh_W = bone.mesh;
    for (Vec3& v : mesh_W.vertices) v = bone.X_WB * v;
    surfaces.emplace_back(std::move(mesh_W));
  }
  return surfaces;
}

/// Deepest vertex of the mesh under the surface, metres; 0: none is.
inline double deepest_in(const MeshDistance& surface, const TriMesh& mesh) {
  Aabb box;
  for (const Vec3& v : surface.mesh().vertices) box.include(v);
  double deepest = 0;
  const std::size_t stride = 1 + mesh.vertices.size() / 2500;  // enough to find what runs through
  for (std::size_t k = 0; k < mesh.vertices.size(); k += stride) {
    const Vec3& p = mesh.vertices[k];
    if (box.overlaps({p, p})) deepest = std::max(deepest, -surface.closest(p).signed_distance);
  }
  return deepest;
}

/// Outer and inner triangles of a layer, of which the mesh holds one after the other, never face
/// the same way: a layer that folds over itself does.
inline std::size_t folds(const TriMesh& layer) {
  std::size_t folded = 0;
  const auto across = [&](const Triangle& t) {
    const Vec3& a = layer.vertices[t[0]];
    return Vec3((layer.vertices[t[1]] - a).cross(layer.vertices[t[2]] - a));
  };
  const auto half = static_cast<std::uint32_t>(layer.vertices.size() / 2);
  for (std::size_t i = 0; i + 1 < layer.triangles.size(); i += 2) {
    const Triangle& inner = layer.triangles[i];
    const Triangle& outer = layer.triangles[i + 1];
    if (inner[0] >= half || outer[0] != inner[0] + half || outer[1] != inner[2] + half) break;
    if (across(inner).dot(across(outer)) >= 0) ++folded;
  }
  return folded;
}

/// Whole, outward, not through a bone by more than 0.5 mm, attached on bone within 1 mm; layers of
/// cartilage apart and not folded.
inline void expect_sound_softs(const GeneratedAnatomy& anatomy) {
  const std::vector<MeshDistance> bones = bone_surfaces_W(anatomy);
  for (const GeneratedSoft& soft : anatomy.softs) {
    SCOPED_TRACE(soft.name);
    EXPECT_TRUE(is_closed_manifold(soft.mesh_W));
    EXPECT_TRUE(has_single_fans(soft.mesh_W));
    EXPECT_GT(signed_volume(soft.mesh_W), 1e-9);
    const double most = soft.kind == "cartilage" ? 2e-5 : 5e-4;
    for (std::size_t i = 0; i < bones.size() && soft.kind != "skin"; ++i)
      EXPECT_LE(deepest_in(bones[i], soft.mesh_W), most) << "in " << anatomy.bones[i].name;
    for (const GeneratedAttachment& attachment : soft.attachments)
      for (std::size_t i = 0; i < bones.size(); ++i)
        if (anatomy.bones[i].name == attachment.bone) {
          EXPECT_LE(std::abs(bones[i].closest(attachment.p_W).signed_distance), 1e-3);
          EXPECT_LE(std::abs(MeshDistance(soft.mesh_W).closest(attachment.p_W).signed_distance),
                    0.6 * soft.thickness_m + 0.7e-3)  // it may end at the rim of cartilage
              << "the band reaches its attachment at " << attachment.bone;
        }
    if (soft.kind == "cartilage") {
      EXPECT_EQ(folds(soft.mesh_W), 0u);
    }
  }
}

inline void expect_layers_apart(const GeneratedAnatomy& anatomy) {
  for (const GeneratedSoft& a : anatomy.softs) {
    if (a.kind != "cartilage") continue;
    const MeshDistance surface(a.mesh_W);
    for (const GeneratedSoft& b : anatomy.softs)
      if (b.kind == "cartilage" && a.bones != b.bones) {
        EXPECT_LE(deepest_in(surface, b.mesh_W), 1e-5) << b.name << " in " << a.name;
      }
  }
}

/// Greatest height of a layer over its own bone, metres.
inline double height_of(const GeneratedAnatomy& anatomy, const std::string& name) {
  const GeneratedSoft& soft = soft_named(anatomy, name);
  const std::vector<MeshDistance> bones = bone_surfaces_W(anatomy);
  double most = 0;
  for (std::size_t i = 0; i < bones.size(); ++i)
    if (anatomy.bones[i].name == soft.bones.at(0))
      for (const Vec3& p : soft.mesh_W.vertices)
        most = std::max(most, bones[i].closest(p).signed_distance);
  return most;
}

/// How far the rim of a layer turns to and fro along the bone, degrees per mm: all that it turns
/// from edge to edge, less what is left of that over eight edges. Vertices of a layer lie
/// on bone, then in the same order on its outer side.
inline double rim_waver_deg_per_mm(const TriMesh& layer) {
  const auto half = static_cast<std::uint32_t>(layer.vertices.size() / 2);
  std::map<std::uint32_t, std::uint32_t> next;
  for (const Triangle& t : layer.triangles)
    if (t[0] < half && t[1] < half && t[2] == t[1] + half) next[t[0]] = t[1];
  const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::vector<Vec3>& v = layer.vertices;
    const Vec3 up = (v[b + half] - v[b]).normalized();
    const auto along = [&](const Vec3& edge) { return Vec3(edge - edge.dot(up) * up); };
    const Vec3 in = along(v[b] - v[a]), out = along(v[c] - v[b]);
    return std::atan2(up.dot(in.cross(out)), in.dot(out));
  };
  double waver = 0, length = 0;
  while (!next.empty()) {
    std::vector<std::uint32_t> curve = {next.begin()->first};
    for (auto at = next.begin(); at != next.end(); at = next.find(curve.back())) {
      curve.push_back(at->second);
      next.erase(at);
    }
    for (std::size_t i = 0; i + 9 < curve.size(); i += 8) {
      double all = 0, left = 0;
      for (std::size_t k = i; k < i + 8; ++k) {
        const double angle = turn(curve[k], curve[k + 1], curve[k + 2]);
        all += std::abs(angle);
        left += angle;
        length += (layer.vertices[curve[k + 1]] - layer.vertices[curve[k]]).norm();
      }
      waver += all - std::abs(left);
    }
  }
  return waver / length * (180 / 3.14159265358979) * 1e-3;
}

/// Height of the wall that a layer ends with, metres; its vertices as rim_waver_deg_per_mm has
/// them.
inline double ledge_of(const TriMesh& layer) {
  const auto half = static_cast<std::uint32_t>(layer.vertices.size() / 2);
  double most = 0;
  for (const Triangle& t : layer.triangles)
    if (t[0] < half && t[1] < half && t[2] == t[1] + half)
      most = std::max(most, (layer.vertices[t[2]] - layer.vertices[t[1]]).norm());
  return most;
}

/// Every layer runs out to its rim.
inline void expect_no_ledges(const GeneratedAnatomy& anatomy) {
  constexpr double kUnseen_m = 3e-4;
  for (const GeneratedSoft& soft : anatomy.softs) {
    if (soft.kind != "cartilage") continue;
    const double ledge = ledge_of(soft.mesh_W);
    EXPECT_GT(ledge, 0) << soft.name << " has a rim";
    EXPECT_LT(ledge, kUnseen_m) << soft.name;
  }
}

/// Prints it of every layer, and expects no more than `most`; no layer crosses itself.
inline void expect_smooth_rims(const GeneratedAnatomy& anatomy, double most_deg_per_mm) {
  for (const GeneratedSoft& soft : anatomy.softs) {
    if (soft.kind != "cartilage") continue;
    const double waver = rim_waver_deg_per_mm(soft.mesh_W);
    std::printf("%-24s %.1f deg/mm\n", soft.name.c_str(), waver);
    EXPECT_LE(waver, most_deg_per_mm) << soft.name;
    EXPECT_TRUE(self_crossings(soft.mesh_W).empty()) << soft.name;
  }
}

inline std::uint64_t hash_of_softs(const GeneratedAnatomy& anatomy) {
  Hasher hasher;
  for (const GeneratedSoft& soft : anatomy.softs) hasher.add(hash_of(soft.mesh_W));
  return hasher.value();
}

}  // namespace osteon::checks
