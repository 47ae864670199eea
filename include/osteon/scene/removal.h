#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace osteon {

/// How an instrument takes bone away.
enum class RemovalWay : std::uint8_t {
  kDrill,   ///< turned by its motor; forward along its axis, by as much as its thrust removes
  kTwist,   ///< the same, turned to and fro by the hand: an awl
  kBurr,    ///< turned by its motor; removes where it is pressed
  kScrape,  ///< removes where it is pressed and drawn along: a curette
  kStrike,  ///< a blade that is pushed and struck forward along its axis
  kBite     ///< a punch: removes once, when its jaw shuts
};
inline constexpr std::size_t kRemovalWays = 6;
/// "drill", "twist", "burr", "scrape", "strike", "bite".
std::string_view to_text(RemovalWay way);
std::optional<RemovalWay> removal_way_from_text(std::string_view text);

/// What an instrument removes bone with, as its file says.
struct RemovalDef {
  RemovalWay way = RemovalWay::kDrill;
  std::string cutter;  ///< its shape, as `osteon carve --tool` names it
  double pilot_m = 0;  ///< diameter of its cannula, which cuts nothing
  double grip = 0.3;   ///< of a burr or a scraper: cutting force by pressing force
  double back_plus_m = 0, back_per_size = 0;  ///< the cutter lies so far behind the tip
};

}  // namespace osteon
