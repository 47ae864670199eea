#include "osteon/results/pdf.h"

#include <hpdf.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "osteon/base/file.h"
#include "short_text.h"

namespace osteon {
namespace {

constexpr float kMargin = 56;
constexpr float kPointsPerMm = 72 / 25.4f;

// The library calls it on the first thing that goes wrong; its code is asked for when saving.
void on_pdf_error(HPDF_STATUS, HPDF_STATUS, void*) {}

std::string latin_only(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 && byte < 0xc0) continue;  // the rest of a letter that is marked already
    out += byte >= 0x20 && byte < 0x7f ? c : '?';
  }
  return out;
}

std::string short_decimal_text(double value) {
  char digits[64];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 4).ptr;
  return std::string(digits, end);
}

struct CurveBox {
  double x0 = 0, x1 = 1, y0 = 0, y1 = 1;
};

CurveBox box_of(const PdfPages::Curve& curve) {
  CurveBox box{curve.x[0], curve.x[0], curve.from_zero ? std::min(0.0, curve.y[0]) : curve.y[0],
               curve.y[0]};
  const auto include = [](const std::vector<double>& values, double& lo, double& hi) {
    for (const double value : values) {
      lo = std::min(lo, value);
      hi = std::max(hi, value);
    }
  };
  include(curve.x, box.x0, box.x1);
  include(curve.beside_x, box.x0, box.x1);
  include(curve.y, box.y0, box.y1);
  include(curve.beside_y, box.y0, box.y1);
  if (!(box.x1 > box.x0)) box.x1 = box.x0 + 1;
  if (!(box.y1 > box.y0)) box.y1 = box.y0 + 1;
  return box;
}

}  // namespace

struct PdfPages::Impl {
  HPDF_Doc doc = HPDF_New(on_pdf_error, nullptr);
  HPDF_Font plain = HPDF_GetFont(doc, "Helvetica", nullptr);
  HPDF_Font bold = HPDF_GetFont(doc, "Helvetica-Bold", nullptr);
  HPDF_Page page = nullptr;
  float width = 0, y = 0;

  ~Impl() { HPDF_Free(doc); }
  void room_for(float height) {
    if (page && y - height >= kMargin) return;
    page = HPDF_AddPage(doc);
    HPDF_Page_SetSize(page, HPDF_PAGE_SIZE_A4, HPDF_PAGE_PORTRAIT);
    width = HPDF_Page_GetWidth(page);
    y = HPDF_Page_GetHeight(page) - kMargin;
  }
  void write(const std::string& text, float x, float at_y, HPDF_Font font, float size) {
    HPDF_Page_BeginText(page);
    HPDF_Page_SetFontAndSize(page, font, size);
    HPDF_Page_TextOut(page, x, at_y, latin_only(text).c_str());
    HPDF_Page_EndText(page);
  }
  void text_line(const std::string& text, HPDF_Font font, float size) {
    room_for(size * 1.5f);
    y -= size * 1.4f;
    write(text, kMargin, y, font, size);
  }
};

PdfPages::PdfPages() : impl_(std::make_unique<Impl>()) {
  HPDF_SetCompressionMode(impl_->doc, HPDF_COMP_IMAGE);
}
PdfPages::~PdfPages() = default;
PdfPages::PdfPages(PdfPages&&) noexcept = default;

void PdfPages::heading(const std::string& text) {
  impl_->room_for(60);
  impl_->y -= 8;
  impl_->text_line(text, impl_->bold, 14);
}

void PdfPages::line(const std::string& text) { impl_->text_line(text, impl_->plain, 9); }

void PdfPages::row(const std::vector<std::string>& cells, bool bold) {
  impl_->room_for(14);
  impl_->y -= 12.6f;
  const float step =
      (impl_->width - 2 * kMargin) / static_cast<float>(std::max<std::size_t>(1, cells.size()));
  const auto fits = static_cast<std::size_t>(step / 4.4f);
  for (std::size_t i = 0; i < cells.size(); ++i)
    impl_->write(cells[i].substr(0, fits), kMargin + step * static_cast<float>(i), impl_->y,
                 bold ? impl_->bold : impl_->plain, 8);
}

void PdfPages::curve(const Curve& curve, double height_mm) {
  if (curve.x.empty() || curve.x.size() != curve.y.size() ||
      curve.beside_x.size() != curve.beside_y.size())
    return;
  const float high = static_cast<float>(height_mm) * kPointsPerMm;
  impl_->room_for(high + 34);
  impl_->text_line(curve.title, impl_->bold, 9);
  CurveBox box = box_of(curve);
  const float left = kMargin, wide = impl_->width - 2 * kMargin;
  const float bottom = impl_->y - 6 - high;
  if (curve.equal_scales) {
    const double unit = std::max((box.x1 - box.x0) / wide, (box.y1 - box.y0) / high);
    box.x1 = box.x0 + unit * wide;
    box.y1 = box.y0 + unit * high;
  }
  const auto px = [&](double x) {
    return left + wide * static_cast<float>((x - box.x0) / (box.x1 - box.x0));
  };
  const auto py = [&](double y) {
    return bottom + high * static_cast<float>((y - box.y0) / (box.y1 - box.y0));
  };
  HPDF_Page_SetLineWidth(impl_->page, 0.5f);
  HPDF_Page_SetRGBStroke(impl_->page, 0.6f, 0.6f, 0.6f);
  HPDF_Page_Rectangle(impl_->page, left, bottom, wide, high);
  HPDF_Page_Stroke(impl_->page);
  HPDF_Page_SetRGBStroke(impl_->page, 0.8f, 0.2f, 0.1f);
  for (const double mark : curve.marks) {
    HPDF_Page_MoveTo(impl_->page, px(mark), bottom);
    HPDF_Page_LineTo(impl_->page, px(mark), bottom + high);
    HPDF_Page_Stroke(impl_->page);
  }
  const auto stroke = [&](const std::vector<double>& x, const std::vector<double>& y) {
    HPDF_Page_MoveTo(impl_->page, px(x[0]), py(y[0]));
    for (std::size_t i = 1; i < x.size(); ++i) HPDF_Page_LineTo(impl_->page, px(x[i]), py(y[i]));
    HPDF_Page_Stroke(impl_->page);
  };
  if (!curve.beside_x.empty()) {
    HPDF_Page_SetRGBStroke(impl_->page, 0.93f, 0.55f, 0.15f);
    stroke(curve.beside_x, curve.beside_y);
  }
  HPDF_Page_SetRGBStroke(impl_->page, 0.1f, 0.3f, 0.6f);
  stroke(curve.x, curve.y);
  impl_->write(short_decimal_text(box.y1) + " " + curve.y_unit, left + 2, bottom + high - 8,
               impl_->plain, 7);
  impl_->write(short_decimal_text(box.y0), left + 2, bottom + 2, impl_->plain, 7);
  impl_->write(
      short_decimal_text(box.x0) + " to " + short_decimal_text(box.x1) + " " + curve.x_unit, left,
      bottom - 9, impl_->plain, 7);
  impl_->y = bottom - 12;
}

void PdfPages::picture(const std::string& title, const std::vector<std::uint8_t>& rgb, int width,
                       int height, double wide_mm) {
  if (width <= 0 || height <= 0 ||
      rgb.size() != 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    return;
  const float wide = static_cast<float>(wide_mm) * kPointsPerMm;
  const float high = wide * static_cast<float>(height) / static_cast<float>(width);
  impl_->room_for(high + 30);
  impl_->text_line(title, impl_->bold, 9);
  impl_->y -= high + 6;
  const HPDF_Image image =
      HPDF_LoadRawImageFromMem(impl_->doc, rgb.data(), static_cast<HPDF_UINT>(width),
                               static_cast<HPDF_UINT>(height), HPDF_CS_DEVICE_RGB, 8);
  if (image) HPDF_Page_DrawImage(impl_->page, image, kMargin, impl_->y, wide, high);
}

void PdfPages::bars(const Bars& bars) {
  if (bars.bars.empty()) return;
  double least = std::min(0.0, bars.line), most = bars.line;
  for (const Bar& bar : bars.bars) {
    least = std::min({least, bar.value, bar.lo});
    most = std::max({most, bar.value, bar.hi});
  }
  const float left = kMargin + 120, wide = impl_->width - left - kMargin - 40;
  const auto px = [&](double x) {
    return left + wide * static_cast<float>((x - least) / std::max(1e-9, most - least));
  };
  const auto stroke = [&](float x0, float y0, float x1, float y1) {
    HPDF_Page_MoveTo(impl_->page, x0, y0);
    HPDF_Page_LineTo(impl_->page, x1, y1);
    HPDF_Page_Stroke(impl_->page);
  };
  impl_->room_for(40);
  impl_->text_line(bars.title, impl_->bold, 9);
  for (const Bar& bar : bars.bars) {
    impl_->room_for(14);
    impl_->y -= 13;
    const float middle = impl_->y + 3;
    impl_->write(short_text(bar.label, 26), kMargin, impl_->y, impl_->plain, 8);
    HPDF_Page_SetLineWidth(impl_->page, 7);
    HPDF_Page_SetRGBStroke(impl_->page, 0.62f, 0.72f, 0.85f);
    stroke(left, middle, px(bar.value), middle);
    HPDF_Page_SetLineWidth(impl_->page, 1.2f);
    HPDF_Page_SetRGBStroke(impl_->page, 0.1f, 0.3f, 0.6f);
    stroke(px(bar.lo), middle, px(bar.hi), middle);
    HPDF_Page_SetRGBStroke(impl_->page, 0.7f, 0.25f, 0.12f);
    stroke(px(bars.line), impl_->y - 3, px(bars.line), impl_->y + 9);
    impl_->write(short_decimal_text(bar.value), left + wide + 6, impl_->y, impl_->plain, 8);
  }
  impl_->y -= 6;
}

Result<void> PdfPages::save(const std::filesystem::path& file) {
  impl_->room_for(1);
  if (HPDF_SaveToStream(impl_->doc) != HPDF_OK || HPDF_GetError(impl_->doc) != HPDF_OK)
    return fail("the page cannot be made", file.string());
  HPDF_ResetStream(impl_->doc);
  std::string bytes(HPDF_GetStreamSize(impl_->doc), '\0');
  auto size = static_cast<HPDF_UINT32>(bytes.size());
  HPDF_ReadFromStream(impl_->doc, reinterpret_cast<HPDF_BYTE*>(bytes.data()), &size);
  bytes.resize(size);
  return write_file_atomic(file, bytes);
}

}  // namespace osteon
