#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/scene/removal.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// What an instrument can do. Numbers of an instrument say how; what a function does is code.
enum class InstrumentFunction : std::uint8_t {
  kProbe,    ///< touches and feels
  kLook,     ///< shows what is before its lens
  kCut,      ///< parts soft tissue with an edge
  kRemove,   ///< takes bone or tissue away
  kBurn,     ///< seals or removes with heat
  kSuck,     ///< draws fluid and loose pieces
  kGrasp,    ///< holds between its jaws
  kRetract,  ///< keeps tissue aside
  kGuide,    ///< leads another instrument
  kDrive,    ///< turns or pushes what it holds into bone
  kPlace     ///< stays in the body
};
inline constexpr std::size_t kInstrumentFunctions = 11;
/// "probe", "look", "cut" ...
std::string_view to_text(InstrumentFunction function);
std::optional<InstrumentFunction> function_from_text(std::string_view text);
/// A length that may grow with the size in use: plus_m + per_size * size.
struct SizedLength {
  double plus_m = 0;
  double per_size = 0;
  double at(double size_m) const { return plus_m + per_size * size_m; }
};
struct SizedPoint {
  std::array<SizedLength, 3> axis;
  Vec3 at(double size_m) const {
    return {axis[0].at(size_m), axis[1].at(size_m), axis[2].at(size_m)};
  }
};

/// Which jaw a part belongs to and turns with.
enum class Jaw : std::uint8_t { kNone, kFirst, kSecond };

/// A ball (equal ends) or rod that is felt.
struct FeltRod {
  SizedPoint from, to;
  SizedLength radius;
  Jaw jaw = Jaw::kNone;
};
/// A box that is felt; `turn_deg` about x, then y, then z of Tool.
struct FeltBox {
  SizedPoint at, half;
  Vec3 turn_deg = Vec3::Zero();
  Jaw jaw = Jaw::kNone;
};
using FeltPart = std::variant<FeltRod, FeltBox>;

/// One part of what is seen: a closed surface made from a few numbers.
struct LookPart {
  enum class Kind : std::uint8_t {
    kTurned,  ///< about an axis along +z: `profile` of height over `at` and radius
    kTube,    ///< round bar through `points` with `radii` (one, or one a point)
    kBox,     ///< `at`, `half`, `turn_deg`
    kPlate,   ///< outline `points` in a plane, `thickness` across it
    kSpiral,  ///< flutes or threads: bar from `at` along +z over `length`, `radius`, `depth`
    kRing     ///< torus about `at`: `radius`, `thickness`, `turn_deg` of its axis from +z
  };
  Kind kind = Kind::kTurned;
  Jaw jaw = Jaw::kNone;
  SizedPoint at, half;
  Vec3 turn_deg = Vec3::Zero();
  std::vector<std::array<SizedLength, 2>> profile;
  std::vector<SizedPoint> points;
  std::vector<SizedLength> radii;
  SizedLength radius, length, thickness, depth;
  double pitch_m = 0;  ///< of a spiral: height of one turn
  int starts = 1;      ///< of a spiral: how many run beside each other
};

/// Two jaws on one hinge.
struct JawDef {
  SizedPoint hinge;
  Vec3 axis = Vec3::UnitX();         ///< unit
  std::array<double, 2> open_rad{};  ///< turn of the first and second jaw when wide open
  double holds_n = 0;  ///< a soft part that is pulled harder slips out; 0: they hold none
};

/// What drives it, and by which pedal.
struct PowerDef {
  std::string kind;   ///< "motor", "current", "suction", "light" or "vibration"
  double most = 0;    ///< at full power
  std::string unit;   ///< of `most`
  std::string pedal;  ///< "left", "right" or "none": by hand
};

/// What an endoscope sees.
struct OpticsDef {
  double angle_deg = 0;  ///< between the shaft and the middle of the view, towards +y of Tool
  double field_deg = 0;  ///< whole width of the view
};

/// How an instrument takes soft tissue away while it runs: where a rod of it presses, by so much a
/// second at full power. In Tool.
struct ClearsDef {
  SizedPoint from, to;  ///< of the rod that clears
  SizedLength radius;
  Vec3 face = Vec3::Zero();  ///< unit: it clears to this half of space; zero: all round
  double speed_m_per_s = 0;
};

/// The bore of an aimer's sleeve, in Tool.
struct AimsDef {
  Vec3 at_m = Vec3::Zero(), mouth_m = Vec3::UnitZ();  ///< what it aims at, and its outer end
  double bore_m = 0;
};

/// The straight part that passes through a portal.
struct ShaftDef {
  SizedPoint from, to;
  SizedLength radius;
};

/// A surgical instrument as its file describes it (assets/instruments/*.toml). Immutable.
struct Instrument {
  std::string name;                  ///< "hook_probe"
  std::string title;                 ///< "Hook probe"
  int code = 0;                      ///< 1 to 255: how a device names it
  std::vector<std::string> regions;  ///< where it is used: "wrist", "knee", "spine" ...
  std::vector<InstrumentFunction> functions;
  std::string size_of;          ///< what `sizes_m` measures: "diameter"
  std::vector<double> sizes_m;  ///< at least one, growing
  std::size_t usual_size = 0;   ///< index of the one that is taken first
  ShaftDef shaft;
  std::vector<FeltPart> felt;  ///< beside the shaft
  std::vector<LookPart> look;  ///< beside the shaft
  std::optional<JawDef> jaws;
  std::optional<PowerDef> power;
  std::optional<OpticsDef> optics;
  std::optional<RemovalDef> removal;  ///< none: it removes no bone
  std::optional<ClearsDef> clears;    ///< none: it takes no soft tissue away
  std::optional<AimsDef> aims;        ///< none: it fixes no line
  std::vector<std::string> sources;   ///< "[74] 4 mm, field 105 degrees": each begins with its mark

  bool can(InstrumentFunction function) const;
};

/// Whether the simulation acts on a function of an instrument yet. One without effect is only
/// declared, and what the instrument cannot do has none.
bool has_effect(const Instrument& instrument, InstrumentFunction function);

/// Reads one file. Strict: a key that is missing, unknown, of another type or out of range fails
/// with its line.
Result<Instrument> load_instrument(const std::filesystem::path& file);
Result<Instrument> parse_instrument(std::string_view text, const std::string& where);

/// All files of a folder by name. Fails on the first bad one, on a name or code that comes twice,
/// on a name that is not its file's, and on a folder without any.
Result<std::vector<Instrument>> load_instruments(const std::filesystem::path& folder);
/// Those that Osteon ships.
Result<std::vector<Instrument>> load_instruments();

/// Null: there is none.
const Instrument* find_instrument(std::span<const Instrument> instruments, std::string_view name);
/// Index of a size given in mm; none when it is not one of the instrument's.
std::optional<std::size_t> find_size(const Instrument& instrument, double size_mm);

/// What is felt and seen of it in one of its sizes with its jaws open by `opening` (0 closed, 1 as
/// wide as they go; without jaws it changes nothing). `size` is an index of sizes_m.
Tool make_tool(const Instrument& instrument, std::size_t size, double opening = 0);

/// The surface alone.
TriMesh instrument_mesh(const Instrument& instrument, std::size_t size, double opening = 0);

}  // namespace osteon
