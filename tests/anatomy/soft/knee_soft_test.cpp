#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "anatomy/anatomy_assets.h"
#include "anatomy/knee_figures.h"
#include "anatomy/soft/soft_checks.h"
#include "osteon/anatomy/variation.h"

namespace osteon {
namespace {

GeneratedAnatomy patient(const VariationRequest& request) {
  auto r = generate_varied(kAnatomyAssets / "knee.toml", kAnatomyAssets / "knee_variation.toml",
                           request);
  if (!r) throw std::runtime_error(r.error().message());
  return std::move(r->anatomy);
}

const GeneratedAnatomy& soft_knee() {
  static const GeneratedAnatomy grown = patient({{}, {}, ""});
  return grown;
}

Vec3 extent_mm(const std::string& name) {
  Aabb box;
  for (const Vec3& v : checks::soft_named(soft_knee(), name).mesh_W.vertices) box.include(v);
  return box.extent() * 1e3;
}

TEST(KneeSoft, IsSound) {
  checks::expect_sound_softs(soft_knee());
  checks::expect_layers_apart(soft_knee());
}

/// Length from front to back, width across.
TEST(KneeSoft, MenisciHaveTheirPublishedSizes) {
  const Vec3 medial = extent_mm("medial_meniscus"), lateral = extent_mm("lateral_meniscus");
  std::printf("medial %.1f x %.1f mm, lateral %.1f x %.1f mm\n", medial.z(), medial.y(),
              lateral.z(), lateral.y());
  EXPECT_NEAR(medial.z(), 42.3, 1.5);
  EXPECT_NEAR(medial.y(), 31.7, 1.5);
  EXPECT_NEAR(lateral.z(), 32.7, 1.5);
  EXPECT_NEAR(lateral.y(), 33.2, 1.5);
}

/// Where the section of a meniscus by a half plane upwards through `middle` (y, z), at `angle` from
/// y to z, lies: heights over how far it is from the middle.
struct MeniscusSection {
  double inner = 1, outer = 0;
  std::vector<std::pair<Vec3, Vec3>> edges;  ///< (distance, height, 0)
  MeniscusSection(const TriMesh& mesh, double y, double z, double angle) {
    const Vec3 out(0, std::cos(angle), std::sin(angle)), across(0, -out.z(), out.y());
    const Vec3 middle(0, y, z);
    for (const Triangle& t : mesh.triangles) {
      std::vector<Vec3> cut;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = mesh.vertices[t[k]] - middle, b = mesh.vertices[t[(k + 1) % 3]] - middle;
        const double da = across.dot(a), db = across.dot(b);
        if ((da < 0) == (db < 0)) continue;
        const Vec3 p = a + da / (da - db) * (b - a);
        cut.push_back({out.dot(p), p.x(), 0});
      }
      if (cut.size() != 2 || cut[0].x() < 0) continue;
      edges.emplace_back(cut[0], cut[1]);
      inner = std::min({inner, cut[0].x(), cut[1].x()});
      outer = std::max({outer, cut[0].x(), cut[1].x()});
    }
  }
  /// Lowest and highest height at a share of the way from the inner edge to the rim.
  std::pair<double, double> heights(double share) const {
    const double at = inner + share * (outer - inner);
    std::pair<double, double> found{1, -1};
    for (const auto& [a, b] : edges) {
      if ((a.x() < at) == (b.x() < at)) continue;
      const double h = a.y() + (at - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
      found = {std::min(found.first, h), std::max(found.second, h)};
    }
    return found;
  }
  double thickness(double share) const {
    const auto [low, high] = heights(share);
    return high - low;
  }
};

/// Thick at the rim, thin at the inner edge, hollow above: also where no condyle presses.
TEST(KneeSoft, MenisciAreWedges) {
  struct Compartment {
    const char* name;
    double y, z;
    std::array<double, 4> angles_deg;
  };
  for (const Compartment& at :
       {Compartment{"medial_meniscus", 0.014, -0.0047, {0, -30, -60, -80}},
        Compartment{"lateral_meniscus", -0.014, -0.005, {180, 240, 260, 275}}}) {
    const TriMesh& mesh = checks::soft_named(soft_knee(), at.name).mesh_W;
    for (const double angle_deg : at.angles_deg) {
      const MeniscusSection section(mesh, at.y, at.z, angle_deg * 3.14159265358979 / 180);
      const double edge = section.thickness(0.12), middle = section.thickness(0.4);
      const double rim = section.thickness(0.75);
      EXPECT_LT(edge, 0.45 * rim) << at.name << " " << angle_deg;
      EXPECT_LT(edge, middle) << at.name << " " << angle_deg;
      EXPECT_LT(middle, rim) << at.name << " " << angle_deg;
      // Up is towards smaller x.
      const double straight = 0.5 * (section.heights(0.1).first + section.heights(0.7).first);
      EXPECT_GT(section.heights(0.4).first, straight) << at.name << " " << angle_deg;
    }
  }
}

/// How far the part of a mesh within 2 mm of `end`, across x, stands off `bone`.
struct HornEnd {
  double least = 1, most = 0;
  HornEnd(const TriMesh& mesh, const MeshDistance& bone, const Vec3& end) {
    for (const Vec3& v : mesh.vertices) {
      if (std::hypot(v.y() - end.y(), v.z() - end.z()) > 0.002) continue;
      const double off = bone.closest(v).signed_distance;
      least = std::min(least, off);
      most = std::max(most, off);
    }
  }
};

/// Each horn runs down to its root: there it lies on bare bone and is thin.
TEST(KneeSoft, HornsOfMenisciEndInTheirRoots) {
  const auto bones = checks::bone_surfaces_W(soft_knee());
  std::size_t tibia = 0;
  while (soft_knee().bones.at(tibia).name != "tibia") ++tibia;
  for (const auto& [name, end] : {std::pair{"medial_meniscus", Vec3(0, 0.008, 0.0112)},
                                  std::pair{"medial_meniscus", Vec3(0, 0.0083, -0.0187)},
                                  std::pair{"lateral_meniscus", Vec3(0, -0.0085, 0.0073)},
                                  std::pair{"lateral_meniscus", Vec3(0, -0.009, -0.0147)}}) {
    const TriMesh& mesh = checks::soft_named(soft_knee(), name).mesh_W;
    const HornEnd horn(mesh, bones[tibia], end);
    std::printf("%s ends %.2f to %.1f mm off bone\n", name, horn.least * 1e3, horn.most * 1e3);
    EXPECT_LT(horn.least, 1e-4) << name;
    EXPECT_GT(horn.most, 0.0005) << name;
    EXPECT_LT(horn.most, 0.0035) << name;
  }
}

/// Section of the ligament by the plane in its middle, at right angles to its run.
TEST(KneeSoft, AnteriorCruciateLigamentHasItsPublishedFigures) {
  const GeneratedSoft& acl = checks::soft_named(soft_knee(), "acl");
  ASSERT_EQ(acl.attachments.size(), 2u);
  const Vec3 from = acl.attachments[0].p_W, to = acl.attachments[1].p_W;
  const double length_mm = (to - from).norm() * 1e3;
  const Vec3 along = (to - from).normalized(), middle = 0.5 * (from + to);
  std::vector<Vec3> section;
  for (const Vec3& v : acl.mesh_W.vertices)
    if (std::abs(along.dot(v - middle)) < 0.001) section.push_back(v);
  double widest = 0, narrowest = 1;
  const Vec3 u = along.unitOrthogonal(), w = along.cross(u);
  for (int k = 0; k < 36; ++k) {
    const double turn = 3.14159265358979 * k / 36;
    const Vec3 direction = std::cos(turn) * u + std::sin(turn) * w;
    double lo = 1, hi = -1;
    for (const Vec3& v : section) {
      lo = std::min(lo, direction.dot(v));
      hi = std::max(hi, direction.dot(v));
    }
    widest = std::max(widest, hi - lo);
    narrowest = std::min(narrowest, hi - lo);
  }
  std::printf("ACL %.1f mm long, %.1f x %.1f mm in its middle\n", length_mm, widest * 1e3,
              narrowest * 1e3);
  EXPECT_NEAR(length_mm, 32, 4);
  EXPECT_NEAR(widest * 1e3, 9.9, 1.0);
  EXPECT_NEAR(narrowest * 1e3, 3.9, 0.6);
}

/// The ends of both tendons lie on the front of the patella, their corners too.
TEST(KneeSoft, TendonsDoNotOverhangThePatella) {
  const auto bones = checks::bone_surfaces_W(soft_knee());
  std::size_t patella = 0;
  while (soft_knee().bones.at(patella).name != "patella") ++patella;
  for (const char* name : {"patellar_tendon", "quadriceps_tendon"}) {
    const GeneratedSoft& tendon = checks::soft_named(soft_knee(), name);
    ASSERT_EQ(tendon.attachments.at(0).bone, "patella");
    const Vec3 end = tendon.attachments[0].p_W;
    Vec3 middle = Vec3::Zero();
    for (const Vec3& v : tendon.mesh_W.vertices) middle += v;
    middle /= static_cast<double>(tendon.mesh_W.vertices.size());
    const Vec3 along = (middle - end).normalized();
    double most = 0;
    for (const Vec3& v : tendon.mesh_W.vertices)
      if (along.dot(v - end) < 0) most = std::max(most, bones[patella].closest(v).signed_distance);
    std::printf("%s stands %.1f mm over the patella\n", name, most * 1e3);
    EXPECT_LT(most, 5e-3) << name;
  }
}

TEST(KneeSoft, CartilageEndsWithoutALedge) { checks::expect_no_ledges(soft_knee()); }

TEST(KneeSoft, RimsOfCartilageAreSmoothCurves) { checks::expect_smooth_rims(soft_knee(), 1.5); }

TEST(KneeSoft, CartilageIsAboutTwoMillimetresThick) {
  for (const char* name : {"femoral_cartilage", "medial_tibial_plateau", "lateral_tibial_plateau",
                           "patellar_cartilage"}) {
    const double height_mm = checks::height_of(soft_knee(), name) * 1e3;
    std::printf("%-24s %.2f mm\n", name, height_mm);
    EXPECT_GT(height_mm, 1.7) << name;
    EXPECT_LE(height_mm, 2.101) << name;
  }
}

TEST(KneeSoft, PortalsLieOnTheSkinBesideThePatellarTendon) {
  const MeshDistance skin(checks::soft_named(soft_knee(), "skin").mesh_W);
  const MeshDistance tendon(checks::soft_named(soft_knee(), "patellar_tendon").mesh_W);
  for (const char* name : {"portal_al", "portal_am"}) {
    const Vec3 portal = checks::landmark_of(soft_knee(), name);
    EXPECT_LT(std::abs(skin.closest(portal).signed_distance), 5e-5) << name;
    EXPECT_GT(tendon.closest(portal).signed_distance, 0.001) << name;
  }
}

TEST(KneeSoft, RandomPatientsAreSound) {
  const GeneratedAnatomy other = patient({7, {}, "left"});
  EXPECT_EQ(other.side, "left");
  checks::expect_sound_softs(other);
  std::printf("hash of the soft parts of seed 7: %016llx\n",
              static_cast<unsigned long long>(checks::hash_of_softs(other)));
}

}  // namespace
}  // namespace osteon
