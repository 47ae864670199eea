#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "osteon/base/id.h"
#include "osteon/base/types.h"
#include "osteon/collide/capsule_contact.h"
#include "osteon/collide/round_box.h"
#include "osteon/collide/segments.h"
#include "osteon/scene/made_portal.h"
#include "osteon/scene/skin_contact.h"
#include "osteon/scene/soft_hold.h"
#include "osteon/scene/soft_solid.h"

namespace osteon {

/// Fibres of a band that get tight together: springs that only pull. With strain e over their slack
/// length their force is k e^2 / (4 toe) below twice the toe strain and k (e - toe) above
/// (Blankevoort and Huiskes 1991, J Biomech Eng 113:263).
struct BandFibres {
  double slack_m = 0.03;
  double stiffness_n = 1000;  ///< newtons for a strain of 1
  double toe_strain = 0.03;
};

/// A ligament as it is felt: a string with round surface from bone to bone, whose mass does not
/// count: after every push it is where its tension leaves it.
struct SoftBand {
  std::string name;        ///< of the soft part
  std::uint32_t soft = 0;  ///< in Case::softs
  BoneId from, to;
  Vec3 from_B = Vec3::Zero(), to_B = Vec3::Zero();  ///< ends of what is free, each in its bone
  double over_m = 0;                                ///< of its length, what lies on `to` beyond
  double radius_m = 0.003;
  double surface_n_per_m = 800;    ///< how its surface yields, of the tissue table
  double failure_n = 1e9;          ///< tension at which it tears
  double left = 1;                 ///< share of its fibres that a finding has left
  Vec3 section_B = Vec3::UnitX();  ///< in the first bone: across it, where its strands begin
  std::vector<BandFibres> fibres;
};

/// Tension at a length of the whole path, N, and how much it grows with that length, N/m. `left`:
/// the share of its strands that no hand has cut or torn.
double tension_at(const SoftBand& band, double length_m, double left = 1);
double tension_slope_at(const SoftBand& band, double length_m, double left = 1);

/// A band between its ends in World.
struct BandSpan {
  Vec3 a_W = Vec3::Zero(), b_W = Vec3::Zero();
};

/// Two directions across a band, unit, that go with its first bone.
struct StrandAxes {
  Vec3 u_W = Vec3::UnitX(), v_W = Vec3::UnitY();
};

/// How a part of a tool presses a band.
struct BandPress {
  bool presses = false;
  double deep_m = 0;     ///< how far the part has come over the surface of the band at rest
  double bent_m = 0;     ///< of that, how far the string has given way
  double taken_m = 0;    ///< by so much the string's path is longer
  double tension_n = 0;  ///< of the whole band
  double force_n = 0;    ///< on the tool, along the push's normal
  Vec3 p_W = Vec3::Zero();
};

/// Where a part of a tool and a band can meet: what physics tells the 1 kHz tick.
struct BandContact {
  std::uint32_t band = 0;
  std::uint32_t part = 0;       ///< of tool_rods() of the instrument
  Vec3 nhat_W = Vec3::UnitZ();  ///< unit, from the band to the part: the side on which it came
  double others_taken_m = 0;    ///< length of the string's path that other contacts take
  /// By so much other hands have drawn its straight way aside here; and so deep lies the surface of
  /// what is left of one that was cut.
  Vec3 off_W = Vec3::Zero();
  double left = 1;  ///< share of its strands that are whole
  bool operator==(const BandContact&) const = default;
};

inline constexpr std::size_t kMaxBands = 12;
inline constexpr std::size_t kMaxBandContacts = 16;

/// Physics -> one hand: the bands, solids and patches of skin that its tool is near to. What the
/// tick feels follows from it and from where the tool and the bones are then.
struct BandContacts {
  std::uint32_t instrument = 0;  ///< that they are contacts of
  std::uint32_t epoch = 0;       ///< of the world
  std::uint32_t count = 0;
  std::array<BandContact, kMaxBandContacts> all{};
  std::uint32_t solid_count = 0;
  std::array<SolidContact, kMaxSolidContacts> solids{};
  SoftHold hold;  ///< what its jaws hold
  std::uint32_t skin_count = 0;
  std::array<SkinContact, kMaxSkins> skins{};
  MadePortals made{};  ///< in all patches, whatever the tool is near to
  bool operator==(const BandContacts&) const = default;
};

/// The string of two straight legs about the part, in balance: its surface yields by
/// surface x (deep - bent), the string by tension (bent / leg + bent / other leg), and both forces
/// are one. `surface_n_per_m`: the softer of the band's surface and the hand's coupling.
BandPress press_band(const SoftBand& band, const BandSpan& span, const RoundBox& part_W,
                     const BandContact& contact, double surface_n_per_m);

/// A band's straight way as a contact meets it.
inline BandSpan span_at(const BandSpan& span, const BandContact& contact) {
  return {span.a_W + contact.off_W, span.b_W + contact.off_W};
}

/// The string of two straight legs that is drawn from its straight way towards `to_W`, in balance
/// with a spring of `spring_n_per_m` between its surface and there. It is drawn by `deep_m`, of
/// which it gives way by `bent_m`; `p_W` is where its middle line is then, and `force_n` the force
/// on it. Presses nothing where its surface reaches `to_W`.
BandPress draw_band(const SoftBand& band, const BandSpan& span, const Vec3& to_W,
                    double others_taken_m, double spring_n_per_m, double left = 1);

/// Places of a band's middle line and of a part's core between which the part presses along
/// `nhat_W`: the nearest of both; of a box over the band its lowest place there, however far it has
/// come through the band's rest place.
AxisPoints pressed_between(const BandSpan& span, const RoundBox& part_W, const Vec3& nhat_W);

}  // namespace osteon
