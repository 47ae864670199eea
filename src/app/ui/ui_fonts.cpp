#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "ui/ui_theme.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

// Latin with accents, general punctuation, arrows and the few signs that the panels use.
constexpr ImWchar kGlyphs[] = {0x20,   0xff,   0x100,  0x17f,  0x2010, 0x2027,
                               0x2030, 0x203a, 0x2190, 0x2193, 0x2212, 0x2212,
                               0x2248, 0x2248, 0x2264, 0x2265, 0};

std::string find_font(const char* file_name) {
  for (const char* folder : {"/usr/share/fonts/opentype/inter", "/usr/share/fonts/truetype/inter",
                             "/usr/share/fonts/inter", "/usr/local/share/fonts"}) {
    std::error_code ec;
    const fs::path path = fs::path(folder) / file_name;
    if (fs::is_regular_file(path, ec)) return path.string();
  }
  return {};
}

ImFont* add_font(const char* file_name, float size_px) {
  ImFontAtlas* atlas = ImGui::GetIO().Fonts;
  const std::string path = find_font(file_name);
  ImFontConfig config;
  config.SizePixels = size_px;
  // Every glyph on whole pixels: text is as sharp as it gets, and no texel needs to be mixed.
  config.OversampleH = config.OversampleV = 1;
  config.PixelSnapH = true;
  if (!path.empty())
    if (ImFont* font = atlas->AddFontFromFileTTF(path.c_str(), size_px, &config, kGlyphs))
      return font;
  return atlas->AddFontDefault(&config);
}

// Inter's tabular figures are an OpenType feature that ImGui cannot switch on: give every digit the
// widest one's advance instead, each centred in it, so that a changing number does not dance.
void make_digits_tabular(ImFont& font) {
  float widest = 0;
  for (ImWchar c = '0'; c <= '9'; ++c) widest = std::max(widest, font.FindGlyph(c)->AdvanceX);
  for (ImWchar c = '0'; c <= '9'; ++c) {
    ImFontGlyph& glyph = *const_cast<ImFontGlyph*>(font.FindGlyph(c));
    const float shift = std::floor(0.5f * (widest - glyph.AdvanceX) + 0.5f);
    glyph.X0 += shift;
    glyph.X1 += shift;
    glyph.AdvanceX = widest;
    font.IndexAdvanceX[c] = widest;
  }
}

}  // namespace

UiFonts load_fonts(float scale) {
  ImFontAtlas* atlas = ImGui::GetIO().Fonts;
  atlas->Clear();
  const auto px = [scale](float size) { return std::round(size * scale); };
  UiFonts fonts;
  fonts.body = add_font("Inter-Regular.otf", px(14));
  fonts.small = add_font("Inter-Regular.otf", px(12));
  fonts.strong = add_font("Inter-SemiBold.otf", px(14));
  fonts.large = add_font("InterDisplay-Medium.otf", px(28));
  atlas->Build();
  for (ImFont* font : {fonts.body, fonts.small, fonts.strong, fonts.large})
    make_digits_tabular(*font);
  return fonts;
}

}  // namespace osteon
