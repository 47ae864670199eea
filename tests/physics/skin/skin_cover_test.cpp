// What lies under the skin is felt through it, on knees of many patients.
#include "skin/skin_cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "osteon/collide/primitive.h"
#include "osteon/physics/skin_setup.h"
#include "physics/skin/grown_knee.h"
#include "skin/skin_world.h"

namespace osteon {
namespace {

constexpr double kFingerRadius_m = 0.0025, kPressed_n = 5, kCoverStep_s = 0.001;

/// A flat skin at z = 0, and slabs under it.
struct Slab {
  double from_x = -1, to_x = 1, top_z = 0;
};
Case flat_case(const std::vector<Slab>& slabs) {
  Case out;
  for (const Slab& slab : slabs) {
    SoftPart tendon;
    tendon.kind = "tendon";
    tendon.mesh_W.vertices = {{slab.from_x, -1, slab.top_z},
                              {slab.to_x, -1, slab.top_z},
                              {slab.to_x, 1, slab.top_z},
                              {slab.from_x, 1, slab.top_z}};
    tendon.mesh_W.triangles = {{0, 1, 2}, {0, 2, 3}};
    out.softs.push_back(std::move(tendon));
  }
  return out;
}
SkinRelief flat_relief() { return SkinRelief(0.002, 15, std::vector<double>(15 * 19, 0.0)); }

TEST(SkinCover, OverNothingItIsAllTheFat) {
  const SkinRelief cover = cover_of({}, {}, flat_relief(), 0.012);
  for (const double x : {-0.014, 0.0, 0.0077})
    EXPECT_NEAR(cover.at({x, 0.003}).height_m, 0.012, 1e-15);
}

TEST(SkinCover, IsTheWayDownToWhatIsHighest) {
  const Case over = flat_case({{-1, 1, -0.009}, {-1, 1, -0.005}, {-1, 1, -0.02}});
  const SkinRelief cover = cover_of(over, {}, flat_relief(), 0.012);
  EXPECT_NEAR(cover.at({0.001, -0.004}).height_m, 0.005, 1e-15);
  // From wherever the sheet is seen.
  const Pose X_WS{{0.001, 0.002, -0.001}, Quat::Identity()};
  EXPECT_NEAR(cover_of(over, X_WS, flat_relief(), 0.012).at({0, 0}).height_m, 0.004, 1e-15);
  // What stands out of the skin is not under it; what is just under it leaves a little.
  EXPECT_NEAR(cover_of(flat_case({{-1, 1, 0.001}}), {}, flat_relief(), 0.012).at({0, 0}).height_m,
              0.012, 1e-15);
  EXPECT_NEAR(cover_of(flat_case({{-1, 1, -1e-4}}), {}, flat_relief(), 0.012).at({0, 0}).height_m,
              0.0025, 1e-15);
}

TEST(SkinCover, OverAnEdgeItRisesWithoutSteps) {
  const SkinRelief cover = cover_of(flat_case({{-1, 0.001, -0.004}}), {}, flat_relief(), 0.012);
  EXPECT_NEAR(cover.at({-0.008, 0}).height_m, 0.004, 1e-12);
  EXPECT_NEAR(cover.at({0.009, 0}).height_m, 0.012, 1e-12);
  double before = 0;
  for (double x = -0.010; x < 0.010; x += 0.0002) {
    const double here = cover.at({x, 0.001}).height_m;
    EXPECT_GE(here, before - 1e-12) << x;
    if (before > 0) {
      EXPECT_LT(here - before, 0.0004) << x;
    }
    before = here;
  }
}

/// The triangles of bones and tendons about a patch, seen from its sheet.
struct NearTriangle {
  std::array<Vec3, 3> p;
  double from_x, to_x, from_y, to_y;
};
using NearTriangles = std::vector<NearTriangle>;
NearTriangles triangles_about(const Case& knee, const Pose& X_SW) {
  constexpr double kAbout_m = 0.03;
  NearTriangles out;
  const auto take = [&](const TriMesh& mesh, const Pose& X_SM) {
    for (const Triangle& t : mesh.triangles) {
      const std::array p{Vec3(X_SM * mesh.vertices[t[0]]), Vec3(X_SM * mesh.vertices[t[1]]),
                         Vec3(X_SM * mesh.vertices[t[2]])};
      if (std::hypot(p[0].x(), p[0].y()) > kAbout_m) continue;
      const auto [x0, x1] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
      const auto [y0, y1] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
      out.push_back({p, x0, x1, y0, y1});
    }
  };
  for (const Bone& bone : knee.bones) take(bone.mesh, X_SW * bone.X_WB);
  for (const SoftPart& soft : knee.softs)
    if (soft.kind == "tendon") take(soft.mesh_W, X_SW);
  return out;
}

/// The way from a place straight down to the first of them, by each in turn that is not beside it
/// (Moeller and Trumbore); 1 where there is none.
double ray_m(const NearTriangles& near, const Vec3& from) {
  const Vec3 d = -Vec3::UnitZ();
  const double x = from.x(), y = from.y();
  double nearest = 1;
  for (const NearTriangle& t : near) {
    if (t.from_x > x || t.to_x < x || t.from_y > y || t.to_y < y) continue;
    const Vec3 e = t.p[1] - t.p[0], f = t.p[2] - t.p[0], h = d.cross(f), s = from - t.p[0],
               q = s.cross(e);
    const double det = e.dot(h);
    if (std::abs(det) < 1e-18) continue;
    const double u = s.dot(h) / det, v = d.dot(q) / det, along = f.dot(q) / det;
    if (u >= 0 && v >= 0 && u + v <= 1 && along > 0) nearest = std::min(nearest, along);
  }
  return nearest;
}

struct Palpation {
  const Case& knee;
  SoftSetup setup;
  BoneSnapshot bones;
  std::vector<NearTriangles> near;

  explicit Palpation(const Case& of) : knee(of) {
    const std::vector<std::string> names{"skin:portal_al", "skin:portal_am"};
    auto made = make_skin_patches(knee, names, {Vec3::UnitX()}, {});
    EXPECT_TRUE(made) << (made ? "" : made.error().message());
    if (made) add_skins(setup, std::move(*made), {});
    bones.count = static_cast<std::uint32_t>(knee.bones.size());
    for (std::size_t b = 0; b < knee.bones.size(); ++b) bones.bones[b].X_WB = knee.bones[b].X_WB;
    for (std::size_t s = 0; s < setup.skins.size(); ++s)
      near.push_back(triangles_about(knee, X_WS(s).inverse()));
  }
  Pose X_WS(std::size_t patch) const {
    return knee.bone(setup.skins[patch].bone).X_WB * setup.skins[patch].X_BS;
  }
  Vec3 on_skin(std::size_t patch, const SheetPoint& p) const {
    return X_WS(patch) * Vec3(p.x(), p.y(), setup.skins[patch].relief.at(p).height_m);
  }
  double down_m(std::size_t patch, const SheetPoint& p) const {
    return ray_m(near[patch], {p.x(), p.y(), setup.skins[patch].relief.at(p).height_m});
  }
  /// Least and greatest way down, there and 3 mm and 6 mm beside.
  std::array<double, 2> down_about_m(std::size_t patch, const SheetPoint& p) const {
    std::array<double, 2> out{1, 0};
    for (const double x : {-0.006, -0.003, 0.0, 0.003, 0.006})
      for (const double y : {-0.003, 0.0, 0.003}) {
        const double down = down_m(patch, p + SheetPoint(x, y));
        out = {std::min(out[0], down), std::max(out[1], down)};
      }
    return out;
  }
  /// How deep a ball is as the skin pushes back with 5 N; pressed slowly down the sheet's normal.
  double pressed_m(std::size_t patch, const SheetPoint& p) {
    SkinWorld world(setup, 2000, 8, kCoverStep_s);
    const RoundBox ball = round_box(make_rod(Vec3::Zero(), Vec3::Zero(), kFingerRadius_m));
    ToolState tool;
    const Vec3 from = on_skin(patch, p), in = X_WS(patch).rotate(-Vec3::UnitZ());
    for (int n = 0; n < 200; ++n) {
      tool.tick = ++bones.step;
      tool.X_WP = {from + (1e-4 * n - kFingerRadius_m - 0.001) * in, Quat::Identity()};
      const std::array hands{SkinToolNow{&tool, {&ball, 1}}};
      world.step(hands, bones);
      BandContacts contacts;
      world.tell(0, contacts);
      for (std::uint32_t k = 0; k < contacts.skin_count; ++k)
        if (contacts.skins[k].patch == patch && contacts.skins[k].force_n >= kPressed_n)
          return contacts.skins[k].deep_m;
    }
    return 1;
  }
};

/// Over the tendon, the patella or the plateau's edge the push rises early; in the soft spot it
/// gives. Without the map each place of a patch would give alike.
TEST(SkinCover, ThinPlacesAndSoftSpotsAreToldApartOnManyKnees) {
  for (const std::uint64_t seed : {1, 6}) {
    const Case knee = checks::grown_knee(seed, 80);
    Palpation hand(knee);
    ASSERT_EQ(hand.setup.skins.size(), 2u);
    double thin_most = 0, soft_least = 1;
    int thin = 0, soft = 0;
    for (std::size_t s = 0; s < 2; ++s) {
      const SkinPatch& patch = hand.setup.skins[s];
      const double half_x = 0.5 * patch.width_m - 0.0035, half_y = 0.5 * patch.height_m - 0.0035;
      for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
          const SheetPoint p(half_x * i / 2, half_y * j / 2);
          const auto [least, most] = hand.down_about_m(s, p);
          const bool is_thin = most<0.008, is_soft = least> 0.0125;
          if (!is_thin && !is_soft) continue;
          EXPECT_NEAR(patch.cover.at(p).height_m, std::min(0.012, hand.down_m(s, p)), 0.001)
              << "seed " << seed << ", patch " << s << " at " << p.transpose();
          const double deep = hand.pressed_m(s, p);
          if (is_thin) thin_most = std::max(thin_most, deep);
          if (is_soft) soft_least = std::min(soft_least, deep);
          ++(is_thin ? thin : soft);
        }
      // The portal itself lies in the soft spot.
      EXPECT_GT(patch.cover.at({0, 0}).height_m, 0.007) << seed << " " << patch.name;
    }
    std::printf("seed %d: %d thin places give %.1f mm at most to 5 N, %d soft ones %.1f at least\n",
                int(seed), thin, 1e3 * thin_most, soft, 1e3 * soft_least);
    EXPECT_GE(thin, 4) << seed;
    EXPECT_GE(soft, 4) << seed;
    EXPECT_LT(thin_most, 0.8 * soft_least) << seed;
  }
}

/// A ball that slides over the tendon's edge at one depth feels no step.
TEST(SkinCover, SlidingOverAnEdgeHasNoSteps) {
  const Case knee = checks::grown_knee(1, 80);
  Palpation hand(knee);
  ASSERT_EQ(hand.setup.skins.size(), 2u);
  for (std::size_t s = 0; s < 2; ++s) {
    const SkinPatch& patch = hand.setup.skins[s];
    SkinWorld world(hand.setup, 2000, 8, kCoverStep_s);
    const RoundBox ball = round_box(make_rod(Vec3::Zero(), Vec3::Zero(), kFingerRadius_m));
    ToolState tool;
    std::optional<double> before;
    double peak = 0, least = 1e9;
    for (int n = 0; n <= 260; ++n) {
      const double along = std::max(n - 60, 0) / 200.0, in_m = 0.0065 * std::min(n / 60.0, 1.0);
      const SheetPoint p((along - 0.5) * (patch.width_m - 0.008), -0.004);
      const Vec3 in = hand.X_WS(s).rotate(-Vec3::UnitZ());
      tool.tick = ++hand.bones.step;
      tool.X_WP = {hand.on_skin(s, p) + (in_m - 0.001 - kFingerRadius_m) * in, Quat::Identity()};
      const std::array hands{SkinToolNow{&tool, {&ball, 1}}};
      world.step(hands, hand.bones);
      BandContacts contacts;
      world.tell(0, contacts);
      for (std::uint32_t k = 0; k < contacts.skin_count; ++k) {
        if (contacts.skins[k].patch != s) continue;
        const double force = contacts.skins[k].force_n;
        if (n < 60) continue;
        EXPECT_LT(std::abs(force - before.value_or(force)), 0.15) << s << " " << n;
        before = force;
        peak = std::max(peak, force);
        least = std::min(least, force);
      }
    }
    EXPECT_GT(peak, 1.15 * least) << s << ": it did go over something";
  }
}

}  // namespace
}  // namespace osteon
