// Bone that was cut in two, before X-rays: what is left, the gap, and the piece where it lies.
#include "runs/pictures/xray_cuts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "carve/carve_fixtures.h"
#include "osteon/carve/loose_pieces.h"
#include "osteon/image/tissue.h"
#include "osteon/scene/build_case.h"
#include "xray/phantoms.h"

namespace osteon {
namespace {

using namespace testing_xray;
using test::cutter;
using test::pose_along;
using test::value;

const Vec3 kHalf = Vec3::Constant(0.004);  // of the block

CaseBodyOptions bare_options() {
  CaseBodyOptions options;
  options.flesh_m = 0;
  return options;
}

CaseBodyOptions phantom_options() {
  CaseBodyOptions options;
  options.bones_hu = 700;
  return options;
}

XrayBody block_body(const CaseBodyOptions& options) {
  CaseDef def;
  def.name = "block";
  BoneDef bone;
  bone.name = "block";
  bone.mesh = test::box_mesh(kHalf);
  bone.felt = Felt::kHull;
  def.bones.push_back(bone);
  const Case block = value(build_case(std::move(def)));
  return value(CaseBody::create(block, value(load_default_tissues()), options)).at_rest();
}

// Sawn between z = 1 and 2 mm; the lid of 2 mm is taken off it.
CutScene sawn(const std::shared_ptr<const UncutField>& bone) {
  CarvedField field = value(CarvedField::make(bone, {}, 4096));
  LoosePieces loose(field);
  const Cutter burr = cutter("burr", 1);
  for (double y = -0.0065; y <= 0.0066; y += 0.00025)
    (void)field.cut(burr, pose_along({-0.007, y, 0.0015}, Vec3::UnitZ()),
                    pose_along({0.007, y, 0.0015}, Vec3::UnitZ()));
  CutScene out;
  const std::vector<LoosePiece> pieces = loose.find(field);
  for (const LoosePiece& piece : pieces) {
    out.pieces.push_back(PieceShape::of(field, loose, piece, 0));
    EXPECT_TRUE(loose.take_away(field, piece, 0.001));
  }
  out.bones.emplace_back(0, std::move(field));
  return out;
}

BoneSnapshot lying(const CutScene& cut, const Pose& X_WL) {
  BoneSnapshot bones;
  bones.count = 1;
  bones.loose.count = 1;
  bones.loose.bones[0] = {cut.pieces.at(0)->hash(), 0, X_WL};
  return bones;
}

constexpr double kRim_m = 0.0006;

/// A box that stands anywhere, and how a ray goes through it.
struct PlacedBox {
  Pose X_WB;
  Vec3 lo, hi;

  double chord(const XrayView& view, const Vec3& ray, double grown = 0) const {
    const Vec3 more = Vec3::Constant(grown);
    return chord_in_box(X_WB.inverse() * view.source_W, X_WB.q.conjugate() * ray, lo - more,
                        hi + more);
  }
  bool is_near_an_edge(const Vec3& p) const {
    int faces = 0;
    for (int a = 0; a < 3; ++a) faces += std::min(p[a] - lo[a], hi[a] - p[a]) < kRim_m;
    return faces > 1;
  }
  /// Whether a ray comes and goes near an edge, or passes one.
  bool is_grazed(const XrayView& view, const Vec3& ray) const {
    const double in = chord(view, ray);
    if (in == 0) return chord(view, ray, kRim_m) > 0;
    const Vec3 from = X_WB.inverse() * view.source_W, dir = X_WB.q.conjugate() * ray;
    double enter = 0;
    for (int a = 0; a < 3; ++a)
      enter = std::max(enter, std::min((lo[a] - from[a]) / dir[a], (hi[a] - from[a]) / dir[a]));
    return is_near_an_edge(from + enter * dir) || is_near_an_edge(from + (enter + in) * dir);
  }
};

const Vec3 kLeftLo = -kHalf, kLeftHi(0.004, 0.004, 0.001);
const Vec3 kLidLo(-0.004, -0.004, 0.002), kLidHi = kHalf;

TEST(XrayCuts, WhereNothingWasCutABodyStaysAsItIs) {
  XrayBody body = block_body(phantom_options());
  auto cuts = value(XrayCuts::create(phantom_options()));
  BoneSnapshot bones;
  bones.count = 1;
  cuts.add_to(body, {}, bones);
  EXPECT_EQ(body.layers.size(), 1u);
}

// Of one density: rays meet what is left and the lid, which lies beside it on its edge. Rays that
// touch an edge, which the piece has rounded, are left out.
TEST(XrayCuts, ABlockCutInTwoIsTheChordsOfBothParts) {
  const CutScene cut = sawn(test::block_field(0.004));
  ASSERT_EQ(cut.pieces.size(), 1u);
  Pose X_WL;
  X_WL.p = Vec3(0, 0.003, 0.012);
  X_WL.q = Quat(Eigen::AngleAxisd(0.9, Vec3(0.2, 1, 0.1).normalized()));
  XrayBody body = block_body(phantom_options());
  auto cuts = value(XrayCuts::create(phantom_options()));
  cuts.add_to(body, cut, lying(cut, X_WL));
  const XrayView view = view_from_above(96, 0.0005);
  const auto got = value(areal_density(body, view)).total();
  const double density = material_of_hu(700).density_g_per_cm3;
  const PlacedBox lid{X_WL, kLidLo, kLidHi}, left{Pose{}, kLeftLo, kLeftHi};
  int both = 0, lid_alone = 0, left_alone = 0, none = 0;
  for (int row = 0; row < view.height; ++row)
    for (int column = 0; column < view.width; ++column) {
      const Vec3 ray = ray_W(view, column, row);
      if (lid.is_grazed(view, ray) || left.is_grazed(view, ray)) continue;
      const double in_lid = lid.chord(view, ray), in_left = left.chord(view, ray);
      const double is =
          static_cast<double>(got[static_cast<std::size_t>(row * view.width + column)]);
      EXPECT_NEAR(is, 100 * density * (in_lid + in_left), 100 * density * 1.5e-4)
          << column << ", " << row;
      (in_lid > 0 ? (in_left > 0 ? both : lid_alone) : (in_left > 0 ? left_alone : none)) += 1;
    }
  EXPECT_GT(both, 20);
  EXPECT_GT(lid_alone, 20);
  EXPECT_GT(left_alone, 20);
  EXPECT_GT(none, 1000);
}

// Depths count from the surface that the bone had: the sawn face of the lid is cancellous bone, and
// 1.2 mm under its top cortical bone begins, wherever it lies.
TEST(XrayCuts, APieceHasTheTissuesThatItHadInItsBone) {
  const CutScene cut = sawn(test::block_field(0.004));
  ASSERT_EQ(cut.pieces.size(), 1u);
  const auto tissues = value(load_default_tissues());
  const double cortical = material_of_hu(tissues.find("cortical_bone")->hu.value).density_g_per_cm3;
  const double cancellous =
      material_of_hu(tissues.find("cancellous_bone")->hu.value).density_g_per_cm3;
  const double water = material_of_hu(0).density_g_per_cm3;
  Pose X_WL;
  X_WL.p = Vec3(0.02, 0, 0);
  XrayBody body = block_body(bare_options());
  auto cuts = value(XrayCuts::create(bare_options()));
  cuts.add_to(body, cut, lying(cut, X_WL));
  const auto mass_through = [&](double x_m) {
    XrayView view = view_from_above(1, 1e-4);
    view.source_W.x() = view.detector_center_W.x() = x_m;
    return static_cast<double>(value(areal_density(body, view)).total()[0]);
  };
  EXPECT_NEAR(mass_through(0.02), 0.12 * cortical + 0.08 * cancellous, 0.006 * cortical);
  // Of the block itself 1.2 mm of cortical and 3.8 mm of cancellous bone are left, and water
  // where the saw and the lid were.
  EXPECT_NEAR(mass_through(0), 0.12 * cortical + 0.38 * cancellous + 0.3 * water, 0.006 * cortical);
}

// A piece that is held no more, and gone, leaves no shadow: the snapshot does not name it.
TEST(XrayCuts, APieceThatIsGoneIsNotShown) {
  const CutScene cut = sawn(test::block_field(0.004));
  XrayBody body = block_body(phantom_options());
  auto cuts = value(XrayCuts::create(phantom_options()));
  BoneSnapshot bones;
  bones.count = 1;
  cuts.add_to(body, cut, bones);
  XrayView view = view_from_above(1, 1e-4);
  const double density = material_of_hu(700).density_g_per_cm3;
  EXPECT_NEAR(static_cast<double>(value(areal_density(body, view)).total()[0]), 0.5 * density,
              0.01 * density);
}

}  // namespace
}  // namespace osteon
