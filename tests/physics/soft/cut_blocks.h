#pragma once

// A block as a meniscus and one as a stump, with the shipped instruments that cut them: for random
// cuts, in tests and in a fuzz target.
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "osteon/base/check.h"
#include "osteon/mesh/append_mesh.h"
#include "osteon/mesh/measure.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/physics/stump_setup.h"
#include "osteon/scene/build_case.h"
#include "osteon/scene/instrument.h"
#include "osteon/tissue/cut_solid_work.h"
#include "soft/cut_shape.h"
#include "soft/solid_fields.h"

namespace osteon::testing {

/// The next number from -1 to 1 of what leads the cuts.
using CutNumbers = std::function<double()>;

inline Vec3 vector_of(const CutNumbers& next) {
  const double x = next();
  const double y = next();
  const double z = next();
  return {x, y, z};
}

inline Quat turn_of(const CutNumbers& next) {
  const Vec3 axis = vector_of(next);
  Quat q(next(), axis.x(), axis.y(), axis.z());
  if (!(q.norm() > 1e-3)) q = Quat::Identity();
  q.normalize();
  return q;
}

inline TriMesh block_about(const Vec3& middle, const Vec3& half) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(
        middle + Vec3((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1).cwiseProduct(half));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

inline std::vector<std::string> cutting_instruments() {
  return {"scalpel_15", "basket_punch", "scalpel_11", "shaver", "rf_ablator"};
}

struct CutBlocks {
  CutBlocks() {
    make_case();
    make_setup();
  }
  /// One thin block of few cubes on the bone z < 0, whose stiffness is made soon. No session takes
  /// it: of the case there is nothing.
  explicit CutBlocks(const Vec3& half) : middles_B{{0, 0, half.z()}}, halves{half} {
    whole_m3.push_back(8 * half.x() * half.y() * half.z());
    SoftSolid solid;
    const bool made_fields =
        make_solid_fields(block_about(middles_B[0], half), "a block", nullptr, solid).has_value();
    demand(made_fields, "a block has no field");
    solid.hangs = [](const Vec3& p_B) { return p_B.z() < 0.0007; };
    PressedSolidDef def;
    def.box = {middles_B[0] - half, middles_B[0] + half};
    def.field = solid.field;
    def.held = solid.hangs;
    def.rests = [](const Vec3&) { return false; };
    def.most_nodes = 60;
    solid.body = std::make_shared<const PressedSolid>(std::move(*PressedSolid::make(def)));
    SoftSetup made;
    made.solids.push_back(std::move(solid));
    made.cutters = std::move(*make_solid_cutters(cutting_instruments()));
    setup = std::make_shared<const SoftSetup>(std::move(made));
  }
  std::shared_ptr<const Case> the_case;
  std::vector<Vec3> middles_W, middles_B, halves;  ///< of each solid
  std::vector<double> whole_m3;
  std::vector<std::shared_ptr<const Tool>> tray;
  std::shared_ptr<const SoftSetup> setup;
  std::size_t solids() const { return setup->solids.size(); }

 private:
  void make_case() {
    CaseDef def;
    def.name = "a meniscus and a stump";
    constexpr double kApart_m = 0.1;
    const Vec3 bone_half(0.010, 0.008, 0.006);
    for (const bool second : {false, true}) {
      BoneDef bone;
      bone.name = second ? "femur" : "tibia";
      bone.X_WB.p = {second ? kApart_m : 0, 0, -bone_half.z()};
      bone.mesh = block_about(Vec3::Zero(), bone_half);
      def.bones.push_back(bone);
    }
    const Vec3 meniscus_half(0.006, 0.004, 0.0025), stump_half(0.0035, 0.0035, 0.0045);
    const Vec3 beside(0, 0.05, 0.02), stump(0, 0, stump_half.z()), far(kApart_m, 0, 0);
    SoftDef meniscus;
    meniscus.name = "medial_meniscus";
    meniscus.tissue = meniscus.kind = "meniscus";
    meniscus.mesh_W = block_about(beside, meniscus_half);
    meniscus.bones = {"tibia"};
    SoftDef torn;
    torn.name = "acl";
    torn.tissue = torn.kind = "ligament";
    torn.mesh_W = block_about(stump, stump_half);
    append_mesh(torn.mesh_W, block_about(far + stump, stump_half));
    torn.bones = {"tibia", "femur"};
    torn.attachments = {{"foot", "tibia", {0, 0, 0}}, {"head", "femur", far}};
    def.softs = {meniscus, torn};
    the_case = std::make_shared<const Case>(std::move(*build_case(std::move(def))));
    middles_W = {beside, stump};
    halves = {meniscus_half, stump_half};
  }

  void make_setup() {
    const std::vector<std::string> names = cutting_instruments();
    const auto instruments = load_instruments();
    for (const std::string& name : names) {
      const Instrument* found = find_instrument(*instruments, name);
      tray.push_back(std::make_shared<const Tool>(make_tool(*found, found->usual_size)));
    }
    std::vector<SoftSolid> both =
        std::move(*make_soft_solids(*the_case, std::vector<std::string>{"menisci"}, 900));
    auto stumps = std::move(*make_stumps(*the_case, {800, 8}));
    both.push_back(std::move(stumps.front()));
    SoftSetup made;
    add_solids(made, std::move(both));
    add_cutters(made, std::move(*make_solid_cutters(names)), 6);
    add_pieces(made,
               std::make_shared<const PiecesSetup>(std::move(*make_pieces(*the_case, names))));
    setup = std::make_shared<const SoftSetup>(std::move(made));
    for (std::size_t s = 0; s < solids(); ++s) {
      middles_B.push_back(the_case->bone(setup->solids[s].bone).X_WB.inverse() * middles_W[s]);
      const Vec3& h = halves[s];
      whole_m3.push_back(8 * h.x() * h.y() * h.z());
    }
  }
};

/// One for all: the stiffness of the whole takes a while to make.
inline const CutBlocks& cut_blocks() {
  static const CutBlocks blocks;
  return blocks;
}

/// Where the surface runs between nodes 0.3 mm apart: of a block's edges, and of a cut's walls.
inline constexpr double kCutVolumeSlack_m3 = 4e-9, kCutVolumeShare = 0.02;

/// What is left of a solid, as it is drawn, from cut to cut.
class CutBlockWatch {
 public:
  CutBlockWatch(const SoftSolid& solid, double whole_m3)
      : shape_(solid), whole_m3_(whole_m3), left_m3_(whole_m3) {}

  /// What is wrong with it; empty: nothing. It is a closed surface about less than before.
  std::string why_unsound(const CarveState& cuts) {
    constexpr double kBack_m3 = 0.05e-9;
    if (!shape_.show(cuts)) return "its surface cannot be made";
    if (!topology(shape_.mesh_B()).closed()) return "its surface is open, or no manifold";
    const double left = volume(shape_.mesh_B());
    took_m3_ = left_m3_ - left;
    left_m3_ = left;
    return took_m3_ > -kBack_m3 ? "" : "some of what was gone came back";
  }
  /// Between the last two looks.
  bool took_something() const { return took_m3_ > 0.01e-9; }

  /// What is left and what is told to be gone are the whole, but for the surface between nodes.
  std::string why_not_whole(double removed_m3) {
    off_m3_ = left_m3_ + removed_m3 - whole_m3_;
    return std::abs(off_m3_) <= kCutVolumeSlack_m3 + kCutVolumeShare * removed_m3
               ? ""
               : "a volume of " + std::to_string(1e9 * off_m3_) + " mm3 came from nowhere";
  }
  double off_m3() const { return off_m3_; }

 private:
  CutShape shape_;
  double whole_m3_, left_m3_, took_m3_ = 0, off_m3_ = 0;
};

/// What is wrong with the stiffness that those cells of a whole solid leave; empty: nothing. It
/// gives way by a finite way, and never towards the push.
inline std::string why_not_elastic(const CutBlocks& blocks, std::size_t s,
                                   const std::vector<CutCell>& cells) {
  // What hangs on nothing: 25 mm of way under the force that a stump bears at all.
  constexpr double kMost_m_per_n = 25.0 / 400;
  CutSolidWork work(blocks.setup->solids[s].body, cells);
  while (!work.step()) {
  }
  const auto body = work.take();
  for (const double x : {-0.6, 0.0, 0.6})
    for (const Vec3& n : {Vec3(Vec3::UnitZ()), Vec3(Vec3::UnitX())}) {
      const SolidPush push = body->push_at(blocks.middles_B[s] + x * blocks.halves[s], n);
      const double yields = body->compliance(push, push);
      if (!(std::isfinite(yields) && yields >= 0 && yields <= kMost_m_per_n))
        return "it gives way by " + std::to_string(yields) + " m/N";
    }
  return {};
}

}  // namespace osteon::testing
