#include "osteon/scene/path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "numbers.h"
#include "osteon/base/file.h"
#include "slerp.h"

namespace osteon {
namespace {

constexpr std::string_view kHeader = "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button";
constexpr std::string_view kMoreColumns = ",instrument,size,power,jaw";
constexpr std::size_t kColumns = 9;
constexpr double kLargestSize_mm = 1000;
constexpr double kFarthest_mm = 1e5;
constexpr double kLatest_s = 1e7;

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// Takes the text up to `separator` off the front.
std::string_view take(std::string_view& text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view front = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return front;
}

std::string column_name(std::size_t column) {
  std::string_view header = kHeader;
  std::string_view name;
  for (std::size_t i = 0; i <= column; ++i) name = take(header, ',');
  return std::string(name);
}

using Row = std::array<double, kColumns>;

Result<Row> parse_numbers(std::string_view line, const std::string& where) {
  const auto columns = 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
  if (columns != kColumns)
    return fail("has " + std::to_string(columns) + " values instead of " + std::to_string(kColumns),
                where, "Write " + std::string(kHeader));
  Row row{};
  for (std::size_t i = 0; i < kColumns; ++i) {
    const auto value = parse_number(trimmed(take(line, ',')));
    if (!value) return fail("the value of " + column_name(i) + " is not a finite number", where);
    row[i] = *value;
  }
  return row;
}

Result<PathSample> parse_sample(std::string_view line, const std::string& where) {
  const auto row = parse_numbers(line, where);
  if (!row) return tl::unexpected(row.error());
  const auto& [time, x, y, z, qw, qx, qy, qz, button] = *row;
  if (std::abs(time) > kLatest_s)
    return fail("the time is more than 1e7 s away", where, "Times are in seconds");
  const Vec3 p_mm(x, y, z);
  if (p_mm.cwiseAbs().maxCoeff() > kFarthest_mm)
    return fail("the position is more than 100 m away", where, "Positions are in mm");
  const auto q = as_unit(Quat(qw, qx, qy, qz));
  if (!q) return fail("qw, qx, qy, qz are not a unit quaternion", where, "Scale them to length 1");
  if (button != 0 && button != 1) return fail("button must be 0 or 1", where);
  PathSample sample;
  sample.time_s = time;
  sample.X_WD = {p_mm / 1000, *q};
  sample.button = button == 1;
  return sample;
}

bool is_instrument_name(std::string_view name) {
  return std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

// "hook_probe,1.5,0,0": what follows the first nine values.
Result<void> parse_instrument_columns(std::string_view text, const std::string& where,
                                      PathSample& sample) {
  if (std::count(text.begin(), text.end(), ',') != 3)
    return fail("lacks the values instrument,size,power,jaw at its end", where,
                "Write " + std::string(kHeader) + std::string(kMoreColumns));
  const std::string_view name = trimmed(take(text, ','));
  if (!is_instrument_name(name))
    return fail("instrument must be of a-z, 0-9 and _, or empty", where,
                "See `osteon instruments`");
  sample.instrument = std::string(name);
  struct Column {
    const char* name;
    double* value;
    double most;
  };
  for (const Column& column : {Column{"size", &sample.size_mm, kLargestSize_mm},
                               Column{"power", &sample.power, 1}, Column{"jaw", &sample.jaw, 1}}) {
    const auto value = parse_number(trimmed(take(text, ',')));
    if (!value || *value < 0 || *value > column.most)
      return fail(
          std::string(column.name) + " must be a number from 0 to " + format_number(column.most),
          where);
    *column.value = *value;
  }
  return {};
}

Result<PathSample> parse_line(std::string_view line, bool with_instruments,
                              const std::string& where) {
  if (!with_instruments) return parse_sample(line, where);
  std::size_t end = 0;
  for (std::size_t i = 0; i < kColumns && end != std::string_view::npos; ++i)
    end = line.find(',', i == 0 ? 0 : end + 1);
  if (end == std::string_view::npos)
    return fail("has too few values", where,
                "Write " + std::string(kHeader) + std::string(kMoreColumns));
  auto sample = parse_sample(line.substr(0, end), where);
  if (!sample) return sample;
  if (auto done = parse_instrument_columns(line.substr(end + 1), where, *sample); !done)
    return tl::unexpected(done.error());
  return sample;
}

// Millimetres that parse back to the same metres, where there are such.
double as_mm(double metres) {
  const double mm = metres * 1000;
  for (const double near : {mm, std::nextafter(mm, -1e300), std::nextafter(mm, 1e300)})
    if (near / 1000 == metres) return near;
  return mm;
}

}  // namespace

double ProbePath::duration_s() const {
  return samples.empty() ? 0 : samples.back().time_s - samples.front().time_s;
}

PathSample ProbePath::at(double time_s) const {
  if (samples.empty()) return {};
  const auto after =
      std::upper_bound(samples.begin(), samples.end(), time_s,
                       [](double t, const PathSample& sample) { return t < sample.time_s; });
  PathSample result = after == samples.begin() ? *after : *(after - 1);
  if (after != samples.begin() && after != samples.end()) {
    const PathSample& before = *(after - 1);
    const double t = (time_s - before.time_s) / (after->time_s - before.time_s);
    result.X_WD.p = (1 - t) * before.X_WD.p + t * after->X_WD.p;
    result.X_WD.q = slerp(before.X_WD.q, after->X_WD.q, t);
  }
  result.time_s = time_s;
  return result;
}

Result<ProbePath> parse_path(std::string_view text, const std::string& where) {
  std::size_t line_number = 1;
  const std::string_view header = trimmed(take(text, '\n'));
  ProbePath path;
  path.with_instruments = header == std::string(kHeader) + std::string(kMoreColumns);
  if (!path.with_instruments && header != kHeader)
    return fail("the first line must be " + std::string(kHeader), where + ":1",
                "It may continue with " + std::string(kMoreColumns));
  while (!text.empty()) {
    const std::string_view line = trimmed(take(text, '\n'));
    const std::string here = where + ":" + std::to_string(++line_number);
    if (line.empty() && trimmed(text).empty()) break;  // blank end of the file
    if (path.samples.size() == kMaxPathSamples)
      return fail("has more than " + std::to_string(kMaxPathSamples) + " samples", here,
                  "Split the path");
    auto sample = parse_line(line, path.with_instruments, here);
    if (!sample) return tl::unexpected(sample.error());
    if (!path.samples.empty() && !(sample->time_s > path.samples.back().time_s))
      return fail("the time does not increase", here, "Sort the samples and drop repeated ones");
    path.samples.push_back(*sample);
  }
  if (path.samples.empty()) return fail("holds no samples", where, "Write at least one line");
  return path;
}

Result<ProbePath> load_path(const std::filesystem::path& file) {
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  return parse_path(*text, file.string());
}

Result<void> save_path(const ProbePath& path, const std::filesystem::path& file) {
  std::string text(kHeader);
  if (path.with_instruments) text += kMoreColumns;
  text += '\n';
  for (const PathSample& s : path.samples) {
    const Vec3& p = s.X_WD.p;
    const Quat& q = s.X_WD.q;
    for (const double value :
         {s.time_s, as_mm(p.x()), as_mm(p.y()), as_mm(p.z()), q.w(), q.x(), q.y(), q.z()})
      text.append(format_number(value)).append(",");
    text += s.button ? "1" : "0";
    if (path.with_instruments)
      text += "," + s.instrument + "," + format_number(s.size_mm) + "," + format_number(s.power) +
              "," + format_number(s.jaw);
    text += '\n';
  }
  return write_file_atomic(file, text);
}

}  // namespace osteon
