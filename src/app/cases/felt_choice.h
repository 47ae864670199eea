#pragma once

#include <map>
#include <string>

#include "osteon/base/result.h"
#include "osteon/scene/build_case.h"

namespace osteon {

/// What of the bones is felt, and how far joints are bent, chosen otherwise than the case says:
/// part of how a user names a case, so that a recording knows it too.
/// "wrist_folder#lunate=hull,capitate=field", or "#field" for all; "knee_folder#flexion=70";
/// "builtin:knee#near=80"; "builtin:knee#beside=graft_bench"; and where portals are:
/// "builtin:knee#flexion=120,begin_flexion=80" lies bent to 120 degrees and is bent to 80 as a
/// session begins; "builtin:knee#portal_al=31.5/-20/4/0.6/0.8/0", a place in mm, World, and a
/// direction into the body.
struct FeltChoice {
  std::string source;                         ///< the case without the choice
  std::map<std::string, Felt> of_bone;        ///< by name; "" stands for all others
  std::map<std::string, double> bent = {};    ///< degrees, by the joint's name
  std::map<std::string, double> begins = {};  ///< likewise, as a session begins
  double near_mm = 0;  ///< femur and tibia of a knee end so far from the joint; 0: they are whole
  struct Place {
    Vec3 p_W = Vec3::Zero(), inwards_W = Vec3::UnitX();
  };
  std::map<std::string, Place> portals = {};  ///< by landmark: where they are instead
  std::string beside = {};  ///< a built-in anatomy that lies beside it (beside_case.h)
};

/// Splits at the last '#', unless a file of the whole name is there. Fails when what follows it is
/// no choice.
Result<FeltChoice> parse_felt_choice(const std::string& spec);
/// The name of the case with the choice.
std::string to_text(const FeltChoice& choice);
/// The same case with a joint bent: "knee_folder" becomes "knee_folder#flexion=70".
Result<std::string> bent_spec(const std::string& spec, const std::string& joint, double degrees);
/// The case alone, whatever follows it.
std::string source_without_choice(const std::string& spec);
/// Puts what is felt and where portals are into the case; fails when it names a bone or a portal
/// that is not there.
Result<void> apply(const FeltChoice& choice, CaseDef& def);

}  // namespace osteon
