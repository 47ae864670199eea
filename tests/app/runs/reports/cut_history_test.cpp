#include "runs/reports/cut_history.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "osteon/carve/carved_field.h"
#include "osteon/physics/carving.h"

namespace osteon {
namespace {

// A block of 6 mm; its cuts are of a burr that goes down through it, a step every 20 ms.
struct Burred {
  std::shared_ptr<CarvingSetup> setup = std::make_shared<CarvingSetup>();
  CutHistory history;

  Burred() {
    TriMesh mesh;
    for (int i = 0; i < 8; ++i)
      mesh.vertices.emplace_back(i & 1 ? 0.003 : -0.003, i & 2 ? 0.003 : -0.003,
                                 i & 4 ? 0.003 : -0.003);
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    UncutFieldOptions options;
    options.cell_m = 0.0005;
    setup->bones.push_back(UncutField::make(mesh, options).value());
    setup->most_blocks = 200;
    setup->air_m = 0.001;
    CarvedField field = CarvedField::make(setup->bones[0], {}, 200, setup->air_m).value();
    const Cutter burr = make_cutter("burr", 0.002).value();
    for (int n = 0; n < 50; ++n) {
      Pose at;
      at.p.z() = 0.0035 - 0.00007 * n;
      const std::uint64_t before = field.step();
      (void)field.cut(burr, at);
      CutsPatch patch;
      for (std::size_t k = 0; k < field.block_count(); ++k) {
        if (field.changed_at(k) <= before) continue;
        patch.block = field.block_at(k);
        std::copy_n(field.cuts(patch.block), CutsPatch::kNodes, patch.cut.begin());
        history.add(patch, 0.02 * n);
      }
    }
  }
};

// Of what was inside: depths are those of the nearest node, half a cell's diagonal away at most.
double lowest(const CarvedPicture::Changed& changed) {
  double z = 1;
  for (const SurfaceCube& cube : changed.cubes)
    for (std::size_t v = 0; v < cube.vertices.size(); ++v)
      if (cube.depth_m[v] > 0.0006f) z = std::min(z, cube.vertices[v].z());
  return z;
}

TEST(CutHistory, APictureGoesForwardAndBack) {
  const Burred with;
  CarvedPicture picture(with.setup);
  std::size_t place = with.history.show(0.98, 0, picture);
  auto changes = picture.changes();
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].bone.index, 0u);
  const double deep = lowest(changes[0]);
  // The burr's lowest point at the end: 0.07 mm above the block's middle, 1 mm under its own.
  EXPECT_NEAR(deep, 0.00007 - 0.001, 0.0002);
  EXPECT_TRUE(picture.changes().empty());
  place = with.history.show(0.5, place, picture);
  changes = picture.changes();
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_GT(lowest(changes[0]), deep + 0.0008);
  // Before the first cut nothing is deep.
  EXPECT_EQ(with.history.show(-1, place, picture), 0u);
  changes = picture.changes();
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(lowest(changes[0]), 1);
}

TEST(CutHistory, OfWhatGoesOnChangingATenthOfASecondIsKept) {
  const Burred with;
  CarvedPicture at_once(with.setup), slowly(with.setup);
  (void)with.history.show(0.98, 0, at_once);
  std::size_t place = 0;
  for (int n = 0; n < 50; ++n) place = with.history.show(0.02 * n, place, slowly);
  const auto a = at_once.changes(), b = slowly.changes();
  ASSERT_EQ(a.size(), 1u);
  ASSERT_EQ(b.size(), 1u);
  EXPECT_EQ(lowest(a[0]), lowest(b[0]));
}

TEST(CutHistory, TemperaturesGoForwardAndBackToo) {
  const Burred with;
  CutHistory history = with.history;
  for (int n = 0; n < 40; ++n) {
    CutsPatch patch;
    patch.heat.emplace();
    patch.heat->dt_s = 0.05;
    patch.heat->sources[0].bone = 0;
    patch.heat->sources[0].heat.joules = 0.1;
    patch.heat->sources[0].heat.ball = true;
    patch.heat->sources[0].heat.radius_m = 0.001;
    history.add(patch, 0.05 * n);
  }
  const auto hottest = [](CarvedPicture& picture) {
    std::uint8_t most = 0;
    for (const CarvedPicture::Warmed& warmed : picture.warmed())
      for (const auto& cell : warmed.volume.cells) most = std::max(most, cell[0]);
    return most;
  };
  CarvedPicture picture(with.setup);
  std::size_t place = history.show(0.31, 0, picture);
  EXPECT_EQ(picture.pulses(), 7u);
  EXPECT_TRUE(picture.warmed().empty());  // nobody has asked for it yet
  EXPECT_FALSE(picture.follow_heat(3));
  EXPECT_TRUE(picture.follow_heat());
  const std::uint8_t early = hottest(picture);
  EXPECT_GT(early, 0);
  place = history.show(1.2, place, picture);
  EXPECT_TRUE(picture.follow_heat());
  EXPECT_GT(hottest(picture), early);
  place = history.show(0.31, place, picture);
  EXPECT_TRUE(picture.follow_heat());
  EXPECT_EQ(hottest(picture), early);
}

TEST(CutHistory, NothingCarvedShowsNothing) {
  const CutHistory none;
  CarvedPicture picture(nullptr);
  EXPECT_EQ(none.show(1, 0, picture), 0u);
  picture.make_whole();
  picture.take(CutsPatch{});
  EXPECT_TRUE(picture.changes().empty());
}

}  // namespace
}  // namespace osteon
