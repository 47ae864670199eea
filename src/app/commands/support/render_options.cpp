#include "commands/support/render_options.h"

#include <charconv>

namespace osteon {
namespace {

/// Reads a side from the front of the text; leaves what follows it.
bool take_side(std::string_view& text, int& side) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side);
  if (error != std::errc() || side < 1 || side > kMaxImageSide) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

std::string names_of_bones(const Case& the_case) {
  std::string names;
  for (const Bone& bone : the_case.bones) names += (names.empty() ? "" : ", ") + bone.name;
  return names;
}

}  // namespace

Result<PictureSize> parse_picture_size(const std::string& text) {
  PictureSize size;
  std::string_view rest = text;
  bool good = take_side(rest, size.width) && rest.starts_with('x');
  if (good) rest.remove_prefix(1);
  good = good && take_side(rest, size.height) && rest.empty();
  if (good) return size;
  return fail("\"" + text + "\" is not the size of a picture", "--size",
              "Give width x height in pixels, such as 1280x720, each at most " +
                  std::to_string(kMaxImageSide));
}

Result<ViewPreset> parse_view_preset(const std::string& text) {
  const std::pair<const char*, ViewPreset> presets[] = {
      {"dorsal", ViewPreset::kDorsal}, {"palmar", ViewPreset::kPalmar},
      {"radial", ViewPreset::kRadial}, {"ulnar", ViewPreset::kUlnar},
      {"ap", ViewPreset::kAp},         {"lateral", ViewPreset::kLateral},
      {"front", ViewPreset::kDorsal},  {"back", ViewPreset::kPalmar},
      {"outer", ViewPreset::kRadial},  {"inner", ViewPreset::kUlnar}};
  for (const auto& [name, preset] : presets)
    if (text == name) return preset;
  return fail("\"" + text + "\" is not a view", "--view",
              "Choose dorsal, palmar, radial, ulnar, ap or lateral; for a knee front, back, outer "
              "or inner");
}

Result<void> hide_bones(const Case& the_case, const std::vector<std::string>& names,
                        ViewState& view) {
  view.bones.resize(the_case.bones.size());
  for (const std::string& name : names) {
    const BoneId id = the_case.find(name);
    if (!id.valid())
      return fail("the case has no bone \"" + name + "\"", "--hide",
                  "It has " + names_of_bones(the_case));
    view.bones[id.index].visible = false;
  }
  return {};
}

Result<void> show_softs(const Case& the_case, const std::vector<std::string>& names,
                        ViewState& view) {
  view.softs.resize(the_case.softs.size());
  for (BoneAppearance& look : view.softs) look.visible = false;
  for (const std::string& name : names) {
    bool found = name == "all" || name == "none";
    for (std::size_t i = 0; i < the_case.softs.size(); ++i) {
      const SoftPart& soft = the_case.softs[i];
      if (name != "all" && name != soft.name && name != soft.kind) continue;
      view.softs[i].visible = true;
      found = true;
    }
    if (!found)
      return fail("the case has no soft part, and no kind of soft part, named \"" + name + "\"",
                  "--soft", "`osteon case info` lists them");
  }
  return {};
}

}  // namespace osteon
