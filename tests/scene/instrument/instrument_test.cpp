#include "osteon/scene/instrument.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(OSTEON_SOURCE_DIR) / "assets/instruments";

const std::vector<Instrument>& shipped() {
  static const std::vector<Instrument> list = [] {
    auto loaded = load_instruments(kFolder);
    if (!loaded) ADD_FAILURE() << loaded.error().message();
    return loaded ? std::move(*loaded) : std::vector<Instrument>();
  }();
  return list;
}

const std::string kProbe = R"(name = "test_probe"
title = "Test probe"
code = 7
regions = ["wrist"]
functions = ["probe", "grasp"]
source = ["K of its form", "[32] of its force"]

[size]
of = "diameter"
list_mm = [1, 2]
usual_mm = 2

[shaft]
from_mm = [0, 0, 10]
to_mm = [0, 0, 100]
radius_mm = { size = 0.5 }

[jaws]
hinge_mm = [0, 0, 10]
axis = [1, 0, 0]
open_deg = [-90, 0]

[[felt]]
kind = "ball"
at_mm = [0, 0, 0]
radius_mm = { mm = 0.25, size = 0.5 }
jaw = "first"

[[felt]]
kind = "box"
at_mm = [0, 3, 50]
half_mm = [1, 2, 3]
turn_deg = [0, 0, 90]

[[look]]
kind = "ring"
at_mm = [0, 0, 50]
radius_mm = 5
thickness_mm = 1
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kProbe;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(Instrument, AFileIsReadAsItSays) {
  const auto read = parse_instrument(kProbe, "probe.toml");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->name, "test_probe");
  EXPECT_EQ(read->code, 7);
  EXPECT_TRUE(read->can(InstrumentFunction::kGrasp));
  EXPECT_FALSE(read->can(InstrumentFunction::kCut));
  EXPECT_EQ(read->usual_size, 1u);
  const Tool tool = make_tool(*read, 1);
  ASSERT_EQ(tool.parts.size(), 3u);
  EXPECT_DOUBLE_EQ(tool.parts[0].rod.radius, 0.00125);
  EXPECT_DOUBLE_EQ(tool.shaft.radius, 0.001);
  EXPECT_DOUBLE_EQ(make_tool(*read, 0).shaft.radius, 0.0005);
  // Turned by a quarter about z: what was along x lies along y.
  EXPECT_NEAR(support(tool.parts[1], Vec3::UnitX()), 0.002, 1e-15);
  EXPECT_NEAR(support(tool.parts[1], Vec3::UnitY()), 0.004, 1e-15);
}

TEST(Instrument, AJawTurnsAboutItsHinge) {
  const auto read = parse_instrument(kProbe, "probe.toml");
  ASSERT_TRUE(read);
  const Tool open = make_tool(*read, 1, 1.0);
  // (0, 0, -10) from the hinge, turned by -90 degrees about x: (0, -10, 0).
  EXPECT_NEAR((open.parts[0].rod.p0 - Vec3(0, -0.010, 0.010)).norm(), 0, 1e-15);
  const Tool half = make_tool(*read, 1, 0.5);
  const double d = 0.010 * std::sqrt(0.5);
  EXPECT_NEAR((half.parts[0].rod.p0 - Vec3(0, -d, 0.010 - d)).norm(), 0, 1e-15);
}

// The page's table says of each instrument what it can do, in brackets what has no effect yet.
TEST(Instrument, ThePageSaysWhatEachCanDo) {
  std::ifstream page(fs::path(OSTEON_SOURCE_DIR) / "docs/instruments.md");
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  for (const Instrument& instrument : shipped()) {
    std::string row = "| `" + instrument.name + "` | " + instrument.title + " | ";
    for (std::size_t i = 0; i < instrument.functions.size(); ++i) {
      const std::string word(to_text(instrument.functions[i]));
      row += i == 0 ? "" : ", ";
      row += has_effect(instrument, instrument.functions[i]) ? word : "(" + word + ")";
    }
    EXPECT_NE(text.find(row + " |"), std::string::npos) << row;
  }
}

TEST(Instrument, AFunctionWithoutEffectIsSaidSo) {
  Instrument drill, rongeur;
  drill.functions = rongeur.functions = {InstrumentFunction::kProbe, InstrumentFunction::kRemove};
  drill.removal.emplace();
  EXPECT_TRUE(has_effect(drill, InstrumentFunction::kProbe));
  EXPECT_TRUE(has_effect(drill, InstrumentFunction::kRemove));
  EXPECT_TRUE(has_effect(rongeur, InstrumentFunction::kProbe));
  EXPECT_FALSE(has_effect(rongeur, InstrumentFunction::kRemove));
  // A motor that drills drives what it turns; a burr is only held.
  drill.functions.push_back(InstrumentFunction::kDrive);
  EXPECT_TRUE(has_effect(drill, InstrumentFunction::kDrive));
  drill.removal->way = RemovalWay::kBurr;
  EXPECT_FALSE(has_effect(drill, InstrumentFunction::kDrive));
  // A needle shows the way through skin.
  Instrument needle;
  needle.functions = {InstrumentFunction::kGuide};
  EXPECT_FALSE(has_effect(needle, InstrumentFunction::kGuide));
  needle.name = "spinal_needle";
  EXPECT_TRUE(has_effect(needle, InstrumentFunction::kGuide));
  // What it cannot do has none either.
  EXPECT_FALSE(has_effect(drill, InstrumentFunction::kCut));
  Instrument blade;
  blade.functions = {InstrumentFunction::kCut};
  EXPECT_TRUE(has_effect(blade, InstrumentFunction::kCut));
  // What cuts and removes bites with its jaw.
  Instrument punch;
  punch.functions = {InstrumentFunction::kCut, InstrumentFunction::kRemove};
  EXPECT_FALSE(has_effect(punch, InstrumentFunction::kCut));
  punch.jaws.emplace();
  EXPECT_TRUE(has_effect(punch, InstrumentFunction::kCut));
  EXPECT_TRUE(has_effect(punch, InstrumentFunction::kRemove));
  drill.functions = {InstrumentFunction::kProbe};
  EXPECT_FALSE(has_effect(drill, InstrumentFunction::kRemove));
  // Water is sucked and a wound is burnt by what has power.
  Instrument ablator;
  ablator.functions = {InstrumentFunction::kBurn, InstrumentFunction::kSuck};
  EXPECT_FALSE(has_effect(ablator, InstrumentFunction::kSuck));
  ablator.power.emplace();
  EXPECT_TRUE(has_effect(ablator, InstrumentFunction::kSuck));
  EXPECT_TRUE(has_effect(ablator, InstrumentFunction::kBurn));
  // What fixes a graft drives and is placed; another screw does not yet.
  Instrument screw;
  screw.functions = {InstrumentFunction::kDrive, InstrumentFunction::kPlace};
  EXPECT_FALSE(has_effect(screw, InstrumentFunction::kDrive));
  screw.name = "interference_screw";
  EXPECT_TRUE(has_effect(screw, InstrumentFunction::kDrive));
  EXPECT_TRUE(has_effect(screw, InstrumentFunction::kPlace));
  // A scope shows its view.
  Instrument scope;
  scope.functions = {InstrumentFunction::kProbe, InstrumentFunction::kLook};
  EXPECT_FALSE(has_effect(scope, InstrumentFunction::kLook));
  scope.optics.emplace();
  EXPECT_TRUE(has_effect(scope, InstrumentFunction::kLook));
}

TEST(Instrument, HowItRemovesBoneIsRead) {
  const std::string jaws = "[jaws]", removes =
                                         "[removes]\nway = \"bite\"\ncutter = \"kerrison\"\n"
                                         "back_mm = { mm = 1, size = 0.5 }\n\n[jaws]";
  const auto without = parse_instrument(with(jaws, removes), "probe.toml");
  ASSERT_FALSE(without);
  EXPECT_NE(without.error().what.find("functions"), std::string::npos);
  std::string text = with(jaws, removes);
  text.replace(text.find("\"grasp\""), 7, "\"remove\"");
  const auto read = parse_instrument(text, "probe.toml");
  ASSERT_TRUE(read) << read.error().message();
  ASSERT_TRUE(read->removal);
  EXPECT_EQ(read->removal->way, RemovalWay::kBite);
  EXPECT_EQ(read->removal->cutter, "kerrison");
  EXPECT_DOUBLE_EQ(read->removal->back_plus_m, 0.001);
  EXPECT_DOUBLE_EQ(read->removal->back_per_size, 0.5);
  for (const auto& [from, to] : {std::pair{"\"bite\"", "\"drill\""}, {"\"bite\"", "\"chew\""}}) {
    std::string bad = text;
    bad.replace(bad.find(from), std::string(from).size(), to);
    EXPECT_FALSE(parse_instrument(bad, "probe.toml")) << to;
  }
}

TEST(Instrument, HowItClearsSoftTissueIsRead) {
  const std::string jaws = "[jaws]";
  const std::string power =
      "[power]\nkind = \"motor\"\nmost = 6000\nunit = \"rpm\"\npedal = \"right\"\n\n";
  const std::string clears =
      "[clears]\nfrom_mm = [0, 0, { size = 0.5 }]\nto_mm = [0, 0, 6]\nradius_mm = { size = 0.5 "
      "}\nface = [0, 0.5, 0]\nmm_per_s = 8\n\n";
  const auto text = [&](const std::string& tables) {
    std::string out = with(jaws, tables + jaws);
    return out.replace(out.find("\"grasp\""), 7, "\"remove\"");
  };
  const auto read = parse_instrument(text(power + clears), "probe.toml");
  ASSERT_TRUE(read) << read.error().message();
  ASSERT_TRUE(read->clears);
  EXPECT_EQ(read->clears->from.at(0.004), Vec3(0, 0, 0.002));
  EXPECT_EQ(read->clears->face, Vec3(0, 1, 0));
  EXPECT_DOUBLE_EQ(read->clears->speed_m_per_s, 0.008);
  EXPECT_TRUE(has_effect(*read, InstrumentFunction::kRemove));
  // Without power, without the function, with a face of no length, too slow, with a key too many.
  EXPECT_FALSE(parse_instrument(text(clears), "probe.toml"));
  EXPECT_FALSE(parse_instrument(with(jaws, power + clears + jaws), "probe.toml"));
  for (const auto& [from, to] : {std::pair{"[0, 0.5, 0]", "[0, 0, 0]"},
                                 {"mm_per_s = 8", "mm_per_s = 0"},
                                 {"mm_per_s = 8", "mm_per_s = 8\nrpm = 2"}}) {
    std::string bad = text(power + clears);
    bad.replace(bad.find(from), std::string(from).size(), to);
    EXPECT_FALSE(parse_instrument(bad, "probe.toml")) << to;
  }
}

TEST(Instrument, AFunctionHasItsName) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kInstrumentFunctions; ++i) {
    const auto function = static_cast<InstrumentFunction>(i);
    names.insert(to_text(function));
    EXPECT_EQ(function_from_text(to_text(function)), function);
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"probe", "look", "cut", "remove", "burn", "suck",
                                               "grasp", "retract", "guide", "drive", "place"}));
}

struct Bad {
  std::string from, to, line, what;
};

TEST(Instrument, WhatIsWrongIsNamedWithItsLine) {
  const std::vector<Bad> all{
      {"code = 7", "code = 700", ":3", "code"},
      {"code = 7", "code = \"x\"", ":3", "code"},
      {"\"grasp\"", "\"fly\"", ":5", "no function 'fly'"},
      {"\"K of its form\"", "\"of its form\"", ":6", "mark"},
      {"usual_mm = 2", "usual_mm = 3", ":11", "usual_mm"},
      {"list_mm = [1, 2]", "list_mm = [2, 1]", ":10", "increasing"},
      {"to_mm = [0, 0, 100]", "to_mm = [0, 0, nan]", ":15", "to_mm"},
      {"to_mm = [0, 0, 100]", "to_mm = [0, 0]", ":15", "three"},
      {"radius_mm = { size = 0.5 }", "radius_mm = { szie = 0.5 }", ":16", "radius_mm"},
      {"radius_mm = { size = 0.5 }", "radius_mm = 0", ":16", "above 0"},
      {"kind = \"ball\"", "kind = \"cone\"", ":24", "kind"},
      {"kind = \"ring\"", "kind = \"hat\"", ":36", "kind"},
      {"jaw = \"first\"", "jaw = \"third\"", ":27", "jaw"},
      {"thickness_mm = 1", "thickness = 1", ":39", "unknown"},
      {"title = \"Test probe\"", "title = ", ":2", "TOML"},
      {"axis = [1, 0, 0]", "axis = [0, 0, 0]", ":20", "zero"},
      {"open_deg = [-90, 0]", "open_deg = [-90, 0]\nholds_n = -1", ":22", "holds_n"},
      {"open_deg = [-90, 0]", "open_deg = [-90, 0]\nholds_n = 501", ":22", "holds_n"}};
  for (const Bad& bad : all) {
    const auto read = parse_instrument(with(bad.from, bad.to), "probe.toml");
    ASSERT_FALSE(read) << bad.to;
    EXPECT_NE(read.error().what.find(bad.what), std::string::npos)
        << bad.to << " -> " << read.error().message();
    EXPECT_NE(read.error().where.find("probe.toml" + bad.line), std::string::npos)
        << bad.to << " -> " << read.error().message();
  }
}

TEST(Instrument, JawsThatHoldGrasp) {
  const std::string jaws = "open_deg = [-90, 0]", holding = jaws + "\nholds_n = 8";
  const auto none = parse_instrument(kProbe, "probe.toml");
  ASSERT_TRUE(none);
  EXPECT_EQ(none->jaws->holds_n, 0);
  EXPECT_FALSE(has_effect(*none, InstrumentFunction::kGrasp));
  const auto holds = parse_instrument(with(jaws, holding), "probe.toml");
  ASSERT_TRUE(holds) << holds.error().message();
  EXPECT_EQ(holds->jaws->holds_n, 8);
  EXPECT_TRUE(has_effect(*holds, InstrumentFunction::kGrasp));
  std::string text = with(jaws, holding);
  text.replace(text.find(", \"grasp\""), 9, "");
  const auto cannot = parse_instrument(text, "probe.toml");
  ASSERT_FALSE(cannot);
  EXPECT_NE(cannot.error().message().find("grasp"), std::string::npos);
}

TEST(Instrument, WhatCannotBeMadeInASizeIsRefused) {
  // In size 1 the ball has no radius left.
  EXPECT_FALSE(parse_instrument(with("{ mm = 0.25, size = 0.5 }", "{ mm = -0.5, size = 0.5 }"),
                                "probe.toml"));
  // A ring thicker than it is wide is turned inside out in its middle, but closed: that is fine;
  // one without a hinge that its parts turn about is not.
  EXPECT_FALSE(parse_instrument(with("[jaws]", "[power]"), "probe.toml"));
}

class InstrumentFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() /
           ("osteon_instruments_" +
            std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(dir_);
    fs::create_directories(dir_);
  }
  void TearDown() override { fs::remove_all(dir_); }
  void put(const std::string& name, const std::string& text) { std::ofstream(dir_ / name) << text; }
  fs::path dir_;
};

TEST_F(InstrumentFolder, OneFileIsOneInstrument) {
  EXPECT_FALSE(load_instruments(dir_));
  EXPECT_FALSE(load_instruments(dir_ / "missing"));
  put("test_probe.toml", kProbe);
  put("notes.txt", "not one");
  const auto one = load_instruments(dir_);
  ASSERT_TRUE(one) << one.error().message();
  EXPECT_EQ(one->size(), 1u);
  put("other.toml", with("test_probe", "other"));
  const auto twice = load_instruments(dir_);
  ASSERT_FALSE(twice);
  EXPECT_NE(twice.error().what.find("code 7"), std::string::npos);
  put("other.toml", kProbe);
  EXPECT_FALSE(load_instruments(dir_));
}

TEST(ShippedInstruments, HaveTheNamesThatCasesAndLessonsUse) {
  for (const char* name : {"arthroscope_0",
                           "arthroscope_30",
                           "arthroscope_70",
                           "hook_probe",
                           "scalpel_11",
                           "scalpel_15",
                           "wrist_arthroscope_1_9",
                           "wrist_arthroscope_2_7",
                           "wrist_hook_probe",
                           "trocar_blunt",
                           "shaver",
                           "rf_ablator",
                           "basket_punch",
                           "grasper",
                           "clamp",
                           "needle_holder",
                           "tendon_stripper",
                           "tibial_aimer",
                           "femoral_offset_aimer",
                           "guide_pin",
                           "cannulated_drill",
                           "passing_pin",
                           "graft_sizer",
                           "interference_screw",
                           "screw_driver_interference",
                           "endobutton",
                           "suction",
                           "bipolar",
                           "microdrill",
                           "kerrison_punch",
                           "bone_curette",
                           "rongeur",
                           "implant_applicator",
                           "awl",
                           "guidewire",
                           "reamer",
                           "drill",
                           "malleable_retractor",
                           "freer_elevator",
                           "plate_forceps",
                           "screwdriver",
                           "endoscope"})
    EXPECT_NE(find_instrument(shipped(), name), nullptr) << name;
  const Instrument* drill = find_instrument(shipped(), "cannulated_drill");
  ASSERT_NE(drill, nullptr);
  EXPECT_TRUE(find_size(*drill, 4.5));
  EXPECT_TRUE(find_size(*drill, 12));
  EXPECT_FALSE(find_size(*drill, 4.6));
}

// Each part that is seen is a closed surface, so that the whole has a volume; what is felt lies
// within a few millimetres of what is seen, else the hand would meet nothing that the eye sees.
TEST(ShippedInstruments, AreFeltWhereTheyAreSeen) {
  for (const Instrument& instrument : shipped()) {
    for (std::size_t size = 0; size < instrument.sizes_m.size(); ++size) {
      for (const double opening : {0.0, 1.0}) {
        const Tool tool = make_tool(instrument, size, opening);
        EXPECT_TRUE(topology(tool.mesh).closed()) << instrument.name;
        EXPECT_GT(volume(tool.mesh), 0) << instrument.name;
        EXPECT_GT(tool.tip_radius_m, 0) << instrument.name;
        const Aabb seen = bounds(tool.mesh);
        for (const Primitive& part : tool.parts)
          for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0}) {
              const Vec3 n = sign * Vec3::Unit(axis);
              const double end = sign > 0 ? seen.hi[axis] : -seen.lo[axis];
              EXPECT_LT(support(part, n), end + 0.004) << instrument.name << " axis " << axis;
            }
      }
    }
  }
}

// Apart by most of what they turn, at their tips.
TEST(ShippedInstruments, JawsStandApartWhenTheyAreOpen) {
  for (const Instrument& instrument : shipped()) {
    if (!instrument.can(InstrumentFunction::kGrasp) || !instrument.jaws ||
        instrument.name == "kerrison_punch")  // its jaw slides
      continue;
    const auto width = [&](double opening) {
      const Tool tool = make_tool(instrument, instrument.usual_size, opening);
      Aabb ends;
      for (const Vec3& p : tool.mesh.vertices)
        if (p.z() < 0.012) ends.include(p);
      return ends.extent().y();
    };
    EXPECT_GT(width(1), 1.6 * width(0)) << instrument.name;
    const Tool open = make_tool(instrument, instrument.usual_size, 1);
    double first = -1, other = 1;  // heights of the jaw that opens upwards and of what is below
    for (std::size_t i = 0; i < instrument.felt.size(); ++i) {
      if (open.parts[i].middle.z() > 0.040) continue;
      const bool turns =
          std::visit([](const auto& p) { return p.jaw == Jaw::kFirst; }, instrument.felt[i]);
      (turns ? first : other) = open.parts[i].middle.y();
    }
    EXPECT_GT(first, other) << instrument.name;
  }
}

TEST(ShippedInstruments, SayWhereTheirNumbersComeFrom) {
  for (const Instrument& instrument : shipped()) {
    EXPECT_FALSE(instrument.sources.empty()) << instrument.name;
    EXPECT_TRUE(instrument.can(InstrumentFunction::kProbe)) << instrument.name;
    EXPECT_EQ(instrument.can(InstrumentFunction::kLook), instrument.optics.has_value());
    EXPECT_LT(instrument.shaft.from.at(instrument.sizes_m[0]).z(),
              instrument.shaft.to.at(instrument.sizes_m[0]).z());
  }
}

}  // namespace
}  // namespace osteon
