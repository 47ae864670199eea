#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "instrument/instrument_reader.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

constexpr std::uint64_t kLargestFile = 1u << 20;
// A tool's parts have a fixed place in the tick.
constexpr std::size_t kMostFelt = 15;
constexpr std::size_t kMostLooks = 64;

bool is_instrument_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

// "[74] text", "K text" or "D text".
bool has_mark(const std::string& source) {
  const std::size_t space = source.find(' ');
  if (space == std::string::npos || space + 1 == source.size()) return false;
  const std::string mark = source.substr(0, space);
  if (mark == "K" || mark == "D") return true;
  return mark.size() > 2 && mark.front() == '[' && mark.back() == ']' &&
         std::all_of(mark.begin() + 1, mark.end() - 1, [](char c) { return c >= '0' && c <= '9'; });
}

void read_head(InstrumentReader& in, Instrument& out) {
  in.allow_only({"name", "title", "code", "regions", "functions", "source", "size", "shaft", "felt",
                 "look", "jaws", "power", "optics", "removes", "clears", "aims"});
  out.name = in.text("name");
  if (!is_instrument_name(out.name)) in.set_error("'name' must be of a-z, 0-9 and _", "name");
  out.title = in.text("title");
  if (out.title.empty()) in.set_error("'title' must not be empty", "title");
  out.code = static_cast<int>(in.number("code", {1, 255}));
  if (out.code != in.integer_or("code", {1, 255}, 0))
    in.set_error("'code' is not a whole number", "code");
  out.regions = in.texts_or_empty("regions");
  if (out.regions.empty()) in.set_error("'regions' must name one or more", "regions");
  out.sources = in.texts_or_empty("source");
  if (out.sources.empty()) in.set_error("'source' must name one or more", "source");
  for (const std::string& source : out.sources)
    if (!has_mark(source))
      in.set_error("each 'source' begins with its mark ([number], K or D) and says what it is for",
                   "source");
}

void read_functions(InstrumentReader& in, Instrument& out) {
  for (const std::string& name : in.texts_or_empty("functions")) {
    const auto function = function_from_text(name);
    if (!function) {
      in.set_error("there is no function '" + name + "'", "functions",
                   "Choose from probe, look, cut, remove, burn, suck, grasp, retract, guide, drive "
                   "and place");
      return;
    }
    if (out.can(*function)) in.set_error("function '" + name + "' is given twice", "functions");
    out.functions.push_back(*function);
  }
  if (out.functions.empty()) in.set_error("'functions' must name one or more", "functions");
}

class InstrumentFile {
 public:
  InstrumentFile(const toml::table& root, const std::string& where)
      : in_(root, where, ""), where_(where) {}

  Result<Instrument> read() {
    read_head(in_, out_);
    read_functions(in_, out_);
    part("size", true, &InstrumentFile::read_size);
    part("shaft", true, &InstrumentFile::read_shaft);
    part("jaws", false, &InstrumentFile::read_jaws);
    part("power", false, &InstrumentFile::read_power);
    part("optics", false, &InstrumentFile::read_optics);
    part("removes", false, &InstrumentFile::read_removal);
    part("clears", false, &InstrumentFile::read_clears);
    part("aims", false, &InstrumentFile::read_aims);
    each("felt", kMostFelt, [this](InstrumentReader& t) { out_.felt.push_back(read_felt(t)); });
    each("look", kMostLooks, [this](InstrumentReader& t) { out_.look.push_back(read_look(t)); });
    check_jaws();
    check_removal();
    if (in_.error()) return tl::unexpected(*in_.error());
    return std::move(out_);
  }

 private:
  void part(const char* name, bool required, void (InstrumentFile::*take)(InstrumentReader&)) {
    const toml::table* table = in_.table_or_null(name);
    if (!table) {
      if (required && !in_.has(name))
        in_.set_error("the table [" + std::string(name) + "] is missing", name);
      return;
    }
    InstrumentReader reader(*table, where_, name);
    (this->*take)(reader);
    in_.adopt_error(reader);
  }

  template <class Take>
  void each(const char* name, std::size_t most, const Take& take) {
    const auto tables = in_.tables_or_empty(name);
    if (tables.size() > most)
      in_.set_error("has more than " + std::to_string(most) + " [[" + name + "]]", name);
    for (std::size_t i = 0; i < tables.size() && !in_.error(); ++i) {
      InstrumentReader reader(*tables[i], where_, name + (" " + std::to_string(i + 1)));
      take(reader);
      in_.adopt_error(reader);
    }
  }

  void read_size(InstrumentReader& in) {
    in.allow_only({"of", "list_mm", "usual_mm"});
    out_.size_of = in.text("of");
    for (const SizedLength& size : in.lengths("list_mm")) out_.sizes_m.push_back(size.plus_m);
    const bool grows =
        std::is_sorted(out_.sizes_m.begin(), out_.sizes_m.end(), std::less_equal<>());
    if (out_.sizes_m.empty() || !grows)
      in.set_error("'list_mm' must hold increasing lengths", "list_mm");
    if (out_.sizes_m.size() > 64) in.set_error("'list_mm' holds more than 64", "list_mm");
    const double usual = in.number("usual_mm", {0, 1000});
    const auto found = find_size(out_, usual);
    if (!found) in.set_error("'usual_mm' is not in 'list_mm'", "usual_mm");
    out_.usual_size = found.value_or(0);
  }

  void read_shaft(InstrumentReader& in) {
    in.allow_only({"from_mm", "to_mm", "radius_mm"});
    out_.shaft = {in.point("from_mm"), in.point("to_mm"), in.length("radius_mm", true)};
  }

  void read_jaws(InstrumentReader& in) {
    in.allow_only({"hinge_mm", "axis", "open_deg", "holds_n"});
    JawDef jaws;
    jaws.hinge = in.point("hinge_mm");
    const std::vector<double> axis = in.numbers("axis", 3, {-1, 1});
    jaws.axis = Vec3(axis[0], axis[1], axis[2]);
    const double length = jaws.axis.norm();
    if (!(length > 1e-6)) in.set_error("'axis' must not be zero", "axis");
    jaws.axis = length > 1e-6 ? Vec3(jaws.axis / length) : Vec3(Vec3::UnitX());
    const std::vector<double> deg = in.numbers("open_deg", 2, {-170, 170});
    for (std::size_t i = 0; i < 2; ++i) jaws.open_rad[i] = deg[i] * std::numbers::pi / 180;
    if (in.has("holds_n")) jaws.holds_n = in.number("holds_n", {0, 500});
    out_.jaws = jaws;
  }

  void read_power(InstrumentReader& in) {
    in.allow_only({"kind", "most", "unit", "pedal"});
    const PowerDef power{in.text("kind"), in.number("most", {0, 1e6}), in.text("unit"),
                         in.text("pedal")};
    const auto one_of = [](const std::string& text, std::initializer_list<const char*> list) {
      return std::find(list.begin(), list.end(), text) != list.end();
    };
    if (!one_of(power.kind, {"motor", "current", "suction", "light", "vibration"}))
      in.set_error("'kind' must be motor, current, suction, light or vibration", "kind");
    if (!one_of(power.pedal, {"left", "right", "none"}))
      in.set_error("'pedal' must be left, right or none", "pedal");
    out_.power = power;
  }

  void read_optics(InstrumentReader& in) {
    in.allow_only({"angle_deg", "field_deg"});
    out_.optics = {in.number("angle_deg", {0, 120}), in.number("field_deg", {1, 170})};
  }

  void read_removal(InstrumentReader& in) {
    in.allow_only({"way", "cutter", "pilot_mm", "grip", "back_mm"});
    RemovalDef removal;
    const std::string word = in.text("way");
    const auto way = removal_way_from_text(word);
    if (!way)
      in.set_error("there is no way '" + word + "' to remove bone", "way",
                   "Choose from drill, twist, burr, scrape, strike and bite");
    removal.way = way.value_or(RemovalWay::kDrill);
    removal.cutter = in.text("cutter");
    removal.pilot_m = kMmPerFile * in.number_or("pilot_mm", {0, 40}, 0);
    removal.grip = in.number_or("grip", {0, 1}, removal.grip);
    if (in.has("back_mm")) {
      const SizedLength back = in.length("back_mm", false);
      removal.back_plus_m = back.plus_m;
      removal.back_per_size = back.per_size;
    }
    if (!out_.can(InstrumentFunction::kRemove))
      in.set_error("'functions' must name remove where there is a table [removes]", "way");
    out_.removal = std::move(removal);
  }

  void read_clears(InstrumentReader& in) {
    in.allow_only({"from_mm", "to_mm", "radius_mm", "face", "mm_per_s"});
    ClearsDef clears{in.point("from_mm"), in.point("to_mm"), in.length("radius_mm", true),
                     Vec3::Zero(), kMmPerFile * in.number("mm_per_s", {0.1, 1000})};
    if (in.has("face")) {
      const std::vector<double> face = in.numbers("face", 3, {-1, 1});
      clears.face = Vec3(face[0], face[1], face[2]);
      const double length = clears.face.norm();
      if (!(length > 1e-6)) in.set_error("'face' must not be zero", "face");
      if (length > 1e-6) clears.face /= length;
    }
    if (!out_.can(InstrumentFunction::kRemove) && !out_.can(InstrumentFunction::kBurn))
      in.set_error("'functions' must name remove or burn where there is a table [clears]",
                   "mm_per_s");
    out_.clears = clears;
  }

  void read_aims(InstrumentReader& in) {
    in.allow_only({"at_mm", "mouth_mm", "bore_mm"});
    const auto place = [&](const char* key) {
      const std::vector<double> mm = in.numbers(key, 3, {-1000, 1000});
      return Vec3(kMmPerFile * Vec3(mm[0], mm[1], mm[2]));
    };
    const AimsDef aims{place("at_mm"), place("mouth_mm"),
                       kMmPerFile * in.number("bore_mm", {0.5, 20})};
    if (!((aims.mouth_m - aims.at_m).norm() > 0.01))
      in.set_error("'mouth_mm' must be at least 10 mm from 'at_mm'", "mouth_mm");
    if (!out_.can(InstrumentFunction::kGuide))
      in.set_error("'functions' must name guide where there is a table [aims]", "at_mm");
    out_.aims = aims;
  }

  // Who turns or strikes needs power; who bites needs jaws.
  void check_removal() {
    if (out_.clears && !out_.power)
      in_.set_error("an instrument that clears soft tissue needs a table [power]", "clears");
    if (!out_.removal) return;
    const RemovalWay way = out_.removal->way;
    const bool turned = way == RemovalWay::kDrill || way == RemovalWay::kBurr;
    if (turned && !(out_.power && out_.power->unit == "rpm"))
      in_.set_error("an instrument that drills or burrs needs a table [power] with the unit rpm",
                    "removes");
    if (way == RemovalWay::kStrike && out_.power && out_.power->unit != "W")
      in_.set_error("the power of blows is given in W", "removes");
    if (way == RemovalWay::kBite && !out_.jaws)
      in_.set_error("an instrument that bites needs a table [jaws]", "removes");
  }

  void check_jaws() {
    bool turns = false;
    for (const FeltPart& part : out_.felt)
      turns = turns || std::visit([](const auto& p) { return p.jaw != Jaw::kNone; }, part);
    for (const LookPart& part : out_.look) turns = turns || part.jaw != Jaw::kNone;
    if (turns && !out_.jaws)
      in_.set_error("a part turns with a jaw, but there is no table [jaws]", "jaws");
    if (out_.jaws && !turns) in_.set_error("no part turns with the jaws", "jaws");
    if (out_.jaws && out_.jaws->holds_n > 0 && !out_.can(InstrumentFunction::kGrasp))
      in_.set_error("jaws that hold ('holds_n') need the function \"grasp\"", "jaws");
  }

  InstrumentReader in_;
  std::string where_;
  Instrument out_;
};

}  // namespace

Result<Instrument> parse_instrument(std::string_view text, const std::string& where) {
  try {
    const toml::table root = toml::parse(text);
    auto read = InstrumentFile(root, where).read();
    if (!read) return read;
    if (auto ok = check_instrument(*read); !ok)
      return fail(ok.error().what, where, ok.error().todo);
    return read;
  } catch (const toml::parse_error& e) {
    return fail("is not TOML: " + std::string(e.description()), case_toml_place(where, e.source()),
                "Correct the line");
  }
}

Result<Instrument> load_instrument(const std::filesystem::path& file) {
  const auto text = read_file(file, kLargestFile);
  if (!text) return tl::unexpected(text.error());
  return parse_instrument(*text, file.string());
}

Result<std::vector<Instrument>> load_instruments(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code ec;
  for (std::filesystem::directory_iterator it(folder, ec), end; !ec && it != end; it.increment(ec))
    if (it->path().extension() == ".toml") files.push_back(it->path());
  if (ec) return fail("the folder cannot be read: " + ec.message(), folder.string());
  std::sort(files.begin(), files.end());
  std::vector<Instrument> out;
  std::set<int> codes;
  for (const auto& file : files) {
    auto one = load_instrument(file);
    if (!one) return tl::unexpected(one.error());
    if (one->name != file.stem().string())
      return fail("the instrument is named '" + one->name + "'", file.string(),
                  "Give it and its file the same name");
    if (!codes.insert(one->code).second)
      return fail("another instrument has code " + std::to_string(one->code), file.string(),
                  "Choose a code that is free");
    out.push_back(std::move(*one));
  }
  if (out.empty()) return fail("holds no instrument", folder.string(), "Add a .toml file");
  return out;
}

Result<std::vector<Instrument>> load_instruments() {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  return load_instruments(*data / "assets" / "instruments");
}

}  // namespace osteon
