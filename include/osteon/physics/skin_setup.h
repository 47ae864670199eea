#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/scene/case.h"
#include "osteon/scene/portal.h"
#include "osteon/scene/tool.h"
#include "osteon/tissue/sheet_push.h"
#include "osteon/tissue/sheet_work.h"

namespace osteon {

/// A smooth map over a sheet's plane: how the skin at rest rises over it, so that its normal has no
/// steps, or how thick what yields is under the skin.
class SkinRelief {
 public:
  struct Place {
    double height_m = 0;
    SheetPoint slope = SheetPoint::Zero();
  };
  SkinRelief() = default;
  /// Heights on a grid of `nx` columns, rows one after another, centred on the sheet's middle.
  SkinRelief(double cell_m, std::size_t nx, std::vector<double> heights_m);
  /// Off the grid it goes on as at its border.
  Place at(const SheetPoint& p) const;
  double lowest_m() const { return lowest_m_; }
  double highest_m() const { return highest_m_; }
  std::span<const double> heights_m() const { return heights_m_; }
  double cell_m() const { return cell_m_; }
  long nx() const { return nx_; }
  long ny() const { return ny_; }

 private:
  double node(long i, long j) const;

  double cell_m_ = 1;
  long nx_ = 0, ny_ = 0;
  double lowest_m_ = 0, highest_m_ = 0;
  std::vector<double> heights_m_;
};

/// A patch of skin on its fat that is felt, cut and pierced: a sheet laid on the case's skin.
struct SkinPatch {
  std::string name;        ///< "skin:portal_al"
  std::uint32_t soft = 0;  ///< the skin, in Case::softs
  BoneId bone;             ///< that it goes with
  Pose X_BS;               ///< of the sheet's frame at rest: z out of the skin
  double width_m = 0, height_m = 0;
  std::shared_ptr<const SkinSheet> sheet;
  SkinRelief relief;
  SkinRelief cover;  ///< its heights: how far it is down to bone or tendon, at most the sheet's fat
  FatShare share;
  std::shared_ptr<const SheetYield> whole;  ///< before any cut
  double edge_n = 1;                        ///< push at which an edge goes in
};
std::uint64_t hash_of(std::span<const SkinPatch> patches);
/// Whether it is there for a portal to be made in it.
bool is_for_portal(const SkinPatch& patch);

/// What an instrument of the tray does to skin.
struct SkinTool {
  std::uint64_t edge = 0;      ///< which of tool_rods() is an edge, bit by bit
  Vec3 flat_T = Vec3::Zero();  ///< across the blade
  double through_m = 0;        ///< radius of the shaft that goes through a hole; 0: none
  bool pierces = false;        ///< it makes the hole itself
  bool retracts = false;       ///< it holds the lips of a cut apart
  bool makes_portal = true;  ///< else its hole is too small for a portal: the patch alone holds it
};
/// `pierces`: it is a trocar or a needle.
SkinTool skin_tool(const Tool& tool, bool pierces);
/// Of each name of a tray. Fails where the instruments cannot be read.
Result<std::vector<SkinTool>> make_skin_tools(std::span<const std::string> tray);

/// How skin answers, of the tissue table.
struct SkinNumbers {
  double stiffness_n_per_m = 400;  ///< to a tip of 5 mm
  double cutting_n = 25;           ///< on a trocar of 5 mm
};

/// Whether a name of --soft means skin: "skin", or "skin:PLACE".
bool names_skin(std::string_view name);

/// The portals that can be made in such patches (see make_skin_patches), shut, in the order of the
/// patches. None for names that mean no skin, or that the case does not have.
std::vector<Portal> portals_to_make(const Case& the_case, std::span<const std::string> names,
                                    const PortalSkin& skin);

/// What y of a patch's frame is along, as far as that lies across the way out of the skin.
struct SkinUps {
  Vec3 up_W = Vec3::UnitY();  ///< along the limb as a whole
  bool along_bones = true;    ///< along a long bone under a place that is no portal's, if it can be
};

/// The frame of such a patch, over bones at rest: z out of the skin, y as `ups` say. `name`:
/// "skin:PLACE". Fails as make_skin_patches.
Result<Pose> patch_frame(const Case& the_case, const std::string& name, const SkinUps& ups);

/// Lays patches on the case's skin. `names`: "skin:PLACE" for the landmark or attachment PLACE;
/// "skin": at portal_al, portal_am and pes_anserinus, as far as the case has them. Fails, and says
/// what there is, where the case has no such place, or where the skin there is too bent for a
/// patch, or patches overlap.
Result<std::vector<SkinPatch>> make_skin_patches(const Case& the_case,
                                                 std::span<const std::string> names,
                                                 const SkinUps& ups, const SkinNumbers& numbers);

}  // namespace osteon
