#include "osteon/anatomy/variation.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <limits>
#include <map>

#include "anatomy/anatomy_assets.h"
#include "anatomy/morphometry.h"
#include "anatomy/surface_probe.h"
#include "mesh/surface_checks.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

const std::filesystem::path kWristFile = kAnatomyAssets / "wrist.toml";
const std::filesystem::path kTable = kAnatomyAssets / "wrist_variation.toml";

GenerateOptions cells(double cell_m) {
  GenerateOptions options;
  options.cell_m = cell_m;
  options.soft_parts = false;
  return options;
}

VariedAnatomy varied_wrist(const VariationRequest& request, double cell_m = 0.0012) {
  auto r = generate_varied(kWristFile, kTable, request, cells(cell_m));
  if (!r) throw std::runtime_error(r.error().message());
  return std::move(*r);
}

GeneratedAnatomy with(const std::vector<ParameterValue>& set, double cell_m = 0.0012) {
  return varied_wrist({{}, set, ""}, cell_m).anatomy;
}

std::string complaint(const VariationRequest& request) {
  const auto r = generate_varied(kWristFile, kTable, request, cells(0.0012));
  return r ? "" : r.error().message();
}

std::uint64_t hash_of_bones(const GeneratedAnatomy& anatomy) {
  Hasher hasher;
  for (const GeneratedBone& bone : anatomy.bones) {
    hasher.add(bone.X_WB);
    hasher.add(checks::hash_of(bone.mesh));
  }
  for (const GeneratedLandmark& landmark : anatomy.landmarks) hasher.add(landmark.p_W);
  return hasher.value();
}

double length_mm(const GeneratedAnatomy& anatomy, const std::string& bone) {
  return checks::figures_of(checks::bone_named(anatomy, bone)).extents_mm.x();
}

TEST(Variation, UnknownNamesAndValuesOutOfRangeListWhatThereIs) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ParameterValue& bad : {ParameterValue{"radial_inclination_deg", 90},
                                    {"radial_inclination_deg", nan},
                                    {"nose_mm", 3}}) {
    const std::string text = complaint({{}, {bad}, ""});
    EXPECT_NE(text.find("'" + bad.first + "'"), std::string::npos) << text;
    EXPECT_NE(text.find("radial_inclination_deg 16 to 32"), std::string::npos) << text;
    EXPECT_NE(text.find("size_percent"), std::string::npos) << text;
  }
  EXPECT_NE(complaint({{}, {}, "upper"}).find("left or right"), std::string::npos);
}

TEST(Variation, WithNothingAskedForItIsTheBuiltInWristToTheBit) {
  const auto plain = generate_anatomy(kWristFile, cells(0.0012));
  ASSERT_TRUE(plain);
  EXPECT_EQ(hash_of_bones(with({})), hash_of_bones(*plain));
}

TEST(Variation, EveryParameterSaysItsFiguresAndTheBuiltInOnesAreMeasured) {
  const auto parameters = list_variation(kTable);
  ASSERT_TRUE(parameters) << parameters.error().message();
  EXPECT_EQ(parameters->size(), 6u);
  const auto f = checks::distal_radius_figures(with({}, 0.0008));
  const std::map<std::string, std::pair<double, double>> measured = {
      {"radial_inclination_deg", {f.inclination_deg, 1.0}},
      {"volar_tilt_deg", {f.volar_tilt_deg, 1.5}},
      {"ulnar_variance_mm", {f.ulnar_variance_mm, 0.3}}};
  for (const VariationParameter& p : *parameters) {
    EXPECT_GT(p.sd, 0) << p.name;
    const auto found = measured.find(p.name);
    if (found == measured.end()) continue;
    EXPECT_NEAR(p.built_in, found->second.first, found->second.second) << p.name;
  }
}

TEST(Variation, RadialInclinationIsMeasuredAsItWasSet) {
  for (const double want : {17.0, 24.0, 31.0}) {
    const auto f = checks::distal_radius_figures(with({{"radial_inclination_deg", want}}, 0.0008));
    std::printf("inclination %g: %.2f deg, variance %.2f mm\n", want, f.inclination_deg,
                f.ulnar_variance_mm);
    EXPECT_NEAR(f.inclination_deg, want, 1.0);
    EXPECT_NEAR(f.ulnar_variance_mm, -1.2, 0.5) << "stays as it was";
  }
}

/// On a fine surface: the lips are two of its vertices, and which ones they are moves the reading
/// by up to 2 degrees where the cells are 0.8 mm.
TEST(Variation, VolarTiltIsMeasuredAsItWasSet) {
  for (const double want : {5.0, 13.8, 22.0}) {
    const auto f = checks::distal_radius_figures(with({{"volar_tilt_deg", want}}, 0.0005));
    std::printf("tilt %g: %.2f deg\n", want, f.volar_tilt_deg);
    EXPECT_NEAR(f.volar_tilt_deg, want, 1.8);
    EXPECT_NEAR(f.inclination_deg, 25.8, 1.0) << "stays as it was";
  }
}

TEST(Variation, UlnarVarianceIsMeasuredAsItWasSet) {
  for (const double want : {-4.0, -0.45, 3.0}) {
    const auto f = checks::distal_radius_figures(with({{"ulnar_variance_mm", want}}, 0.0008));
    std::printf("variance %g: %.2f mm\n", want, f.ulnar_variance_mm);
    EXPECT_NEAR(f.ulnar_variance_mm, want, 0.4);
  }
}

/// Readings at fixed places of World need the size taken out first.
TEST(Variation, UlnarVarianceKeepsItsMillimetresInALargeWrist) {
  constexpr double kOverallSize = 1.1;
  auto large = with({{"ulnar_variance_mm", 2}, {"size_percent", 110}}, 0.0008);
  for (GeneratedBone& bone : large.bones) {
    bone.X_WB.p /= kOverallSize;
    for (Vec3& v : bone.mesh.vertices) v /= kOverallSize;
  }
  EXPECT_NEAR(checks::distal_radius_figures(large).ulnar_variance_mm * kOverallSize, 2, 0.4);
}

TEST(Variation, CarpalsGrowAloneAndMetacarpalsGrowAlone) {
  const GeneratedAnatomy plain = with({});
  for (const double percent : {93.0, 107.0}) {
    const auto carpus = with({{"carpal_size_percent", percent}});
    for (const char* name : {"scaphoid", "lunate", "capitate", "trapezium", "hamate", "pisiform"})
      EXPECT_NEAR(length_mm(carpus, name) / length_mm(plain, name) * 100, percent, 1.5) << name;
    EXPECT_NEAR(length_mm(carpus, "metacarpal_3") / length_mm(plain, "metacarpal_3"), 1, 0.01);
    const auto hand = with({{"metacarpal_length_percent", percent}});
    for (int i = 1; i <= 5; ++i) {
      const std::string name = "metacarpal_" + std::to_string(i);
      EXPECT_NEAR(length_mm(hand, name) / length_mm(plain, name) * 100, percent, 1.0) << name;
    }
    EXPECT_NEAR(length_mm(hand, "capitate") / length_mm(plain, "capitate"), 1, 0.01);
  }
}

TEST(Variation, SizeScalesBonesPlacesAndLandmarks) {
  const GeneratedAnatomy plain = with({});
  for (const double percent : {88.0, 112.0}) {
    // The variance is in mm of the finished wrist: it has to be asked for in proportion.
    const GeneratedAnatomy sized =
        with({{"size_percent", percent}, {"ulnar_variance_mm", -1.2 * percent / 100}});
    for (const GeneratedBone& bone : plain.bones) {
      const auto was = checks::figures_of(bone);
      const auto is = checks::figures_of(checks::bone_named(sized, bone.name));
      const double cube = percent * percent * percent / 1e6;
      EXPECT_NEAR(is.volume_mm3 / was.volume_mm3 / cube, 1, 0.03) << bone.name;
      EXPECT_LT((is.centroid_W - percent / 100 * was.centroid_W).norm(), 0.0002) << bone.name;
    }
    // Portals are searched for on the skin's field, to some nanometres.
    for (std::size_t i = 0; i < plain.landmarks.size(); ++i)
      EXPECT_LT((sized.landmarks[i].p_W - percent / 100 * plain.landmarks[i].p_W).norm(), 2e-8);
  }
}

TEST(Variation, TheLeftWristIsTheRightOneInTheMirror) {
  const GeneratedAnatomy right = with({});
  const GeneratedAnatomy left = varied_wrist({{}, {}, "left"}).anatomy;
  EXPECT_EQ(left.side, "left");
  const auto mirrored = [](const Vec3& p) { return Vec3(p.x(), -p.y(), p.z()); };
  for (std::size_t i = 0; i < right.bones.size(); ++i) {
    const auto a = checks::vertices_in_world(right.bones[i]);
    const auto b = checks::vertices_in_world(left.bones[i]);
    for (std::size_t k = 0; k < a.size(); ++k) ASSERT_LT((b[k] - mirrored(a[k])).norm(), 1e-12);
    EXPECT_TRUE(checks::is_closed_manifold(left.bones[i].mesh));
    EXPECT_GT(checks::signed_volume(left.bones[i].mesh), 0) << "faces outwards";
  }
  EXPECT_EQ(left.landmarks[0].p_W, mirrored(right.landmarks[0].p_W));
  EXPECT_EQ(hash_of_bones(varied_wrist({{}, {}, "right"}).anatomy), hash_of_bones(right));
}

TEST(Variation, ASeedGivesTheSameWristAgainAndAnotherSeedAnother) {
  const VariedAnatomy a = varied_wrist({7, {}, ""}), b = varied_wrist({7, {}, ""}),
                      c = varied_wrist({8, {}, ""});
  EXPECT_EQ(hash_of_bones(a.anatomy), hash_of_bones(b.anatomy));
  EXPECT_NE(hash_of_bones(a.anatomy), hash_of_bones(c.anatomy));
  EXPECT_EQ(a.values, b.values);
  // What is told can be given back.
  EXPECT_EQ(hash_of_bones(with(a.values)), hash_of_bones(a.anatomy));
  std::printf("hash of seed 7: %016llx\n",
              static_cast<unsigned long long>(hash_of_bones(a.anatomy)));
  const auto set = varied_wrist({7, {{"volar_tilt_deg", 9}}, ""});
  for (std::size_t i = 0; i < a.values.size(); ++i)
    EXPECT_EQ(set.values[i].second, a.values[i].first == "volar_tilt_deg" ? 9 : a.values[i].second);
}

/// The probe is another way to tell inside from outside than the generator's own check.
double deepest_mm(const GeneratedAnatomy& anatomy) {
  std::vector<checks::SurfaceProbe> probes;
  for (const GeneratedBone& bone : anatomy.bones) probes.emplace_back(bone.mesh, bone.X_WB);
  double deepest = 0;
  for (const auto& a : probes)
    for (const auto& b : probes)
      for (const Vec3& p : a.vertices_W())
        if (&a != &b && b.box_W().overlaps({p, p}) && b.inside(p))
          deepest = std::max(deepest, b.distance(p, 0.003));
  return deepest * 1000;
}

TEST(Variation, NoBonesOfRandomPatientsOverlapAndAllAreWhole) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const VariedAnatomy patient = varied_wrist({seed, {}, ""});
    EXPECT_LE(deepest_mm(patient.anatomy), 0.1) << "seed " << seed;
    for (const GeneratedBone& bone : patient.anatomy.bones) {
      EXPECT_TRUE(checks::is_closed_manifold(bone.mesh)) << seed << bone.name;
      EXPECT_EQ(checks::euler_number(bone.mesh), 2) << seed << bone.name;
    }
    std::printf("seed %d: %d halvings\n", static_cast<int>(seed), patient.halvings);
  }
}

/// A table of the test's own, whose ulna may run far into the carpus.
class WildTable : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(write_file_atomic(path_, R"(overall_size = "size_percent"
[[parameter]]
name = "ulna_mm"
mean = 0
sd = 30
min = -40
max = 40
built_in = 0
source = "test"
meaning = "far"
shift = [{ bones = ["ulna"], mm = [1, 0, 0] }]
[[parameter]]
name = "size_percent"
mean = 100
sd = 0
min = 90
max = 110
built_in = 100
source = "test"
meaning = "size"
scale = [{ bones = ["*"], center_mm = [0, 0, 0], percent = 1 }]
)"));
  }
  void TearDown() override { std::filesystem::remove(path_); }
  std::filesystem::path path_ = std::filesystem::path(testing::TempDir()) /
                                ("wild_table_" + std::to_string(::getpid()) + ".toml");
};

TEST_F(WildTable, BonesThatWereSetToMeetAreAnErrorThatNamesThem) {
  const auto r = generate_varied(kWristFile, path_, {{}, {{"ulna_mm", 20}}, ""}, cells(0.0015));
  ASSERT_FALSE(r);
  EXPECT_NE(r.error().message().find("ulna"), std::string::npos) << r.error().message();
  EXPECT_NE(r.error().message().find(" mm into "), std::string::npos) << r.error().message();
}

TEST_F(WildTable, DrawnValuesMoveToTheMeanUntilBonesArePartAndSaySo) {
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    const auto r = generate_varied(kWristFile, path_, {seed, {}, ""}, cells(0.0015));
    if (!r || r->halvings == 0) continue;
    EXPECT_LE(deepest_mm(r->anatomy), 0.1);
    EXPECT_GT(r->values[0].second, 0);
    return;
  }
  ADD_FAILURE() << "no seed made bones meet";
}

}  // namespace
}  // namespace osteon
