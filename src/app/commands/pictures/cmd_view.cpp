#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>
#include "commands/support/parser.h"

#include "cases/scoped_case.h"
#include "cases/standard_views.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/render_options.h"
#include "osteon/base/file.h"
#include "osteon/render/anatomical_view.h"
#include "osteon/render/scope_sight.h"
#include "water/water_drift.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

struct ViewCommand {
  std::string case_spec, scope = "knee_30", size = "720x720", out, standard, only, views,
                         white_balance = "auto";
  std::vector<double> at_mm, toward_mm, up;
  double light_k = kScopeLamp_k;
  double post_deg = 0, pressure_mmhg = 60, bleeding_ml_min = 0;
  std::optional<double> flexion_deg;
  bool list = false;
  WaterOrder water;
  std::size_t bubbles = 0, flakes = 0;

  bool is_single() const { return !at_mm.empty() && !toward_mm.empty() && (list || !out.empty()); }
  bool is_standard() const { return !standard.empty() || (list && at_mm.empty()); }
};

Result<ScopePose> pose_of(const ViewCommand& command, const Case& the_case) {
  const auto place = [](const std::vector<double>& v) { return Vec3(v[0], v[1], v[2]); };
  ScopePose pose;
  pose.at_W = 0.001 * place(command.at_mm);
  pose.toward_W = 0.001 * place(command.toward_mm);
  pose.up_W = command.up.empty() ? anatomical_frame(the_case).distal_W : place(command.up);
  pose.post_rad = command.post_deg * std::numbers::pi / 180;
  for (const Vec3& v : {pose.at_W, pose.toward_W, pose.up_W})
    if (!is_finite(v)) return fail("is not finite", "a position of the scope");
  if (!std::isfinite(pose.post_rad)) return fail("is not finite", "--post");
  if ((pose.toward_W - pose.at_W).norm() < 1e-6)
    return fail("--at and --toward are the same point", "the scope",
                "--toward is the point that its shaft points to");
  return pose;
}

Result<WaterNow> water_of(const ViewCommand& command, const Case& the_case) {
  WaterOrder order = command.water;
  order.drive.pump_pa = command.pressure_mmhg * kPa_per_mmHg;
  order.drive.bleeding_m3_s = command.bleeding_ml_min * kM3_s_per_ml_min;
  return water_after(order, fluid_of(the_case));
}

/// A camera that is balanced on something white shows that light as white.
Result<WhiteBalance> white_of(const ViewCommand& command) {
  const std::string& text = command.white_balance;
  if (text == "auto") return WhiteBalance{command.light_k, command.light_k};
  double balance_k = 0;
  const char* const end = text.data() + text.size();
  const bool read = std::from_chars(text.data(), end, balance_k) == std::from_chars_result{end, {}};
  if (read && balance_k >= kLeastLamp_k && balance_k <= kMostLamp_k)
    return WhiteBalance{command.light_k, balance_k};
  return fail("\"" + text + "\" is neither auto nor a number from 2000 to 10000",
              "--white-balance");
}

/// About a place 15 mm before the lens.
void strew(const ViewCommand& command, ScopedCase& scoped) {
  constexpr double kBefore_m = 0.015;
  if (command.bubbles + command.flakes == 0) return;
  scoped.strew(
      [bubbles = command.bubbles, flakes = command.flakes,
       bones = rest_snapshot(scoped.the_case())](const ScopeCamera& camera, const JointRoof& roof) {
        const auto above = [&](const Vec3& p_W, double most_m) {
          return roof.distance(bones, p_W, Vec3::UnitZ(), most_m);
        };
        return strewn_bits(bubbles, flakes, camera.X_WC() * Vec3(0, 0, -kBefore_m), above);
      });
}

void print_water(const ViewCommand& command, const WaterNow& water) {
  if (water.turbidity <= 0 && water.seen.fog <= 0) return;
  std::printf(
      "water after %g s: %.0f mmHg, %.0f ml/min in, %.1f ml/min bleed, blood %.2f %%, "
      "turbidity %.2f, nothing seen for %.0f s\n",
      command.water.after_s, water.state.pressure_pa / kPa_per_mmHg,
      water.flows.in / kM3_s_per_ml_min, water.flows.bled / kM3_s_per_ml_min,
      100 * water.state.blood, water.turbidity, water.state.obscured_s);
}

Result<void> draw_view(const ViewCommand& command) {
  const auto size = parse_picture_size(command.size);
  if (!size) return tl::unexpected(size.error());
  const auto scope = load_scope(command.scope);
  if (!scope) return tl::unexpected(scope.error());
  auto opened = open_scoped_case(command.case_spec, command.flexion_deg);
  if (!opened) return tl::unexpected(opened.error());
  const auto pose = pose_of(command, *opened);
  if (!pose) return tl::unexpected(pose.error());
  const auto water = water_of(command, *opened);
  if (!water) return tl::unexpected(water.error());
  const auto white = white_of(command);
  if (!white) return tl::unexpected(white.error());
  const auto context = OffscreenContext::create();
  if (!context) return tl::unexpected(context.error());
  auto scoped = ScopedCase::create(std::move(*opened));
  if (!scoped) return tl::unexpected(scoped.error());
  scoped->set_water(water->seen);
  scoped->set_white_balance(*white);
  strew(command, *scoped);
  if (auto ok = scoped->draw(*scope, *pose, size->width, size->height, command.out); !ok) return ok;
  print_water(command, *water);
  return {};
}

/// Tells of a view what a student would see; false: not all of what belongs there.
bool print_sight(const StandardView& view, const ScopeSight& sight) {
  constexpr double kSeen = 0.01;
  std::printf("%-24s tip %.1f mm off the %s%s\n  ", view.name.c_str(), 1000 * sight.clearance_m,
              sight.nearest.c_str(),
              sight.within.empty() ? "" : (", within the " + sight.within).c_str());
  double wall = 1;
  for (const SeenPart& part : sight.parts) {
    wall -= part.share;
    if (part.share >= kSeen)
      std::printf("%s %.0f %% at %.0f mm, ", part.name.c_str(), 100 * part.share,
                  1000 * part.nearest_m);
  }
  std::printf("wall %.0f %%\n", 100 * wall);
  bool all = sight.clearance_m > 0 && sight.within.empty();
  for (const std::string& part : view.shows)
    if (sight.share_of(part) < kSeen) {
      std::printf("  not seen: %s\n", part.c_str());
      all = false;
    }
  return all;
}

/// Goes through the views of a case; it is grown again only where the next is of another setting.
class StandardTour {
 public:
  explicit StandardTour(const ViewCommand& command) : command_(command) {}

  Result<void> run() {
    const auto def = open_case_def(command_.case_spec, {}, CaseParts::kFelt);
    if (!def) return tl::unexpected(def.error());
    const auto views = views_of(*def);
    if (!views) return tl::unexpected(views.error());
    bool any = false;
    for (const StandardView& view : *views) {
      if (!command_.only.empty() && view.name != command_.only) continue;
      any = true;
      if (auto ok = show(view, def->joints.empty()); !ok)
        return fail(ok.error().what, "view " + view.name + ": " + ok.error().where,
                    ok.error().todo);
    }
    if (!any) return fail("there is no view of this name", command_.only, "--list names them");
    return {};
  }
  bool whole() const { return whole_; }

 private:
  Result<std::vector<StandardView>> views_of(const CaseDef& def) const {
    if (command_.views.empty()) return standard_views(def);
    const auto text = read_file(command_.views);
    if (!text) return tl::unexpected(text.error());
    return parse_standard_views(*text, command_.views);
  }
  Result<void> enter(const StandardView& view, bool stiff) {
    if (setting_ && setting_->same_setting(view)) return {};
    setting_ = view;
    scoped_.reset();
    rays_.reset();
    const auto bent = stiff ? std::nullopt : std::optional<double>(view.flexion_deg);
    auto opened = open_scoped_case(command_.case_spec, bent, view.finding);
    if (!opened) return tl::unexpected(opened.error());
    if (command_.list) rays_.emplace(*opened);
    if (command_.standard.empty()) return {};
    const auto water = water_of(command_, *opened);
    if (!water) return tl::unexpected(water.error());
    const auto white = white_of(command_);
    if (!white) return tl::unexpected(white.error());
    auto scoped = ScopedCase::create(std::move(*opened));
    if (!scoped) return tl::unexpected(scoped.error());
    scoped_.emplace(std::move(*scoped));
    scoped_->set_water(water->seen);
    scoped_->set_white_balance(*white);
    strew(command_, *scoped_);
    print_water(command_, *water);
    return {};
  }
  Result<void> show(const StandardView& view, bool stiff) {
    const auto size = parse_picture_size(command_.size);
    if (!size) return tl::unexpected(size.error());
    const auto scope = load_scope(view.scope);
    if (!scope) return tl::unexpected(scope.error());
    if (!command_.standard.empty() && !context_) {
      auto context = OffscreenContext::create();
      if (!context) return tl::unexpected(context.error());
      context_.emplace(std::move(*context));
    }
    if (auto ok = enter(view, stiff); !ok) return ok;
    if (rays_) whole_ = print_sight(view, rays_->look(ScopeCamera(*scope, view.pose))) && whole_;
    if (!scoped_) return {};
    const fs::path file = fs::path(command_.standard) / (view.name + ".png");
    if (auto ok = scoped_->draw(*scope, view.pose, size->width, size->height, file); !ok) return ok;
    std::printf("%s: %s\n", file.string().c_str(), view.title.c_str());
    std::fflush(stdout);
    return {};
  }

  const ViewCommand& command_;
  std::optional<StandardView> setting_;
  // The context comes before what was made in it, so that it goes last.
  std::optional<OffscreenContext> context_;
  std::optional<ScopedCase> scoped_;
  std::optional<ScopeRays> rays_;
  bool whole_ = true;
};

int run_standard(const ViewCommand& command) {
  std::error_code made;
  if (!command.standard.empty()) fs::create_directories(command.standard, made);
  if (made)
    return report_error(
        {"the folder cannot be made (" + made.message() + ")", command.standard, {}});
  StandardTour tour(command);
  if (const auto done = tour.run(); !done) return report_error(done.error());
  return tour.whole() ? kExitDone : kExitNo;
}

/// The same of a single view, without a picture.
Result<bool> list_view(const ViewCommand& command) {
  const auto scope = load_scope(command.scope);
  if (!scope) return tl::unexpected(scope.error());
  const auto opened = open_scoped_case(command.case_spec, command.flexion_deg);
  if (!opened) return tl::unexpected(opened.error());
  const auto pose = pose_of(command, *opened);
  if (!pose) return tl::unexpected(pose.error());
  StandardView view;
  view.name = command.scope;
  return print_sight(view, ScopeRays(*opened).look(ScopeCamera(*scope, *pose)));
}

int run_list(const ViewCommand& command) {
  const auto whole = list_view(command);
  if (!whole) return report_error(whole.error());
  return *whole ? kExitDone : kExitNo;
}

int run_view(const ViewCommand& command) {
  if (command.is_standard()) return run_standard(command);
  if (command.list) return run_list(command);
  if (const auto done = draw_view(command); !done) return report_error(done.error());
  std::printf("%s in %s, %s pixels -> %s\n", command.scope.c_str(), command.case_spec.c_str(),
              command.size.c_str(), command.out.c_str());
  return kExitDone;
}

void add_camera_options(cli::App& sub, ViewCommand& command) {
  sub.add_option("--light-kelvin", command.light_k,
                 "colour temperature of the light source, 2000 to 10000 K: halogen has 3200, xenon "
                 "6000")
      ->check(cli::Range(kLeastLamp_k, kMostLamp_k))
      ->capture_default_str();
  sub.add_option("--white-balance", command.white_balance,
                 "colour temperature that the camera takes for white, 2000 to 10000 K; auto: it "
                 "was balanced on something white in this light")
      ->capture_default_str();
}

void add_water_options(cli::App& sub, ViewCommand& command) {
  sub.add_option("--turbidity", command.water.turbidity,
                 "share of the light that pale debris absorbs between the scope and tissue 10 mm "
                 "away, there and back, 0 to 1")
      ->capture_default_str();
  sub.add_option("--bubbles", command.bubbles,
                 "bubbles of air that have risen to the roof near by, 0 to 60")
      ->check(cli::Range(std::size_t{0}, std::size_t{60}))
      ->capture_default_str();
  sub.add_option("--flakes", command.flakes, "flakes of loose tissue in the water, 0 to 60")
      ->check(cli::Range(std::size_t{0}, std::size_t{60}))
      ->capture_default_str();
  sub.add_option("--fog", command.water.fog, "share of the lens that is fogged, 0 to 1")
      ->capture_default_str();
  sub.add_option("--flush", command.water.flushed_s,
                 "time for which water then flushes the fog off the lens, s")
      ->capture_default_str();
  sub.add_option("--bleeding", command.bleeding_ml_min,
                 "blood that flows into the joint while the water has no pressure, ml/min")
      ->capture_default_str();
  sub.add_option("--pressure", command.pressure_mmhg, "pressure of the pump, mmHg")
      ->capture_default_str();
  sub.add_option("--outlet", command.water.drive.outlet_open, "how far the outlet is open, 0 to 1")
      ->capture_default_str();
  sub.add_option("--suction", command.water.drive.suction,
                 "suction of a shaver or a suction cannula, 0 to 1")
      ->capture_default_str();
  sub.add_option("--after", command.water.after_s, "time since pump and bleeding began, s")
      ->capture_default_str();
}

}  // namespace

void add_view_command(cli::App& app, int& exit_code) {
  auto command = std::make_shared<ViewCommand>();
  cli::App* sub = app.add_subcommand("view", "Save the picture that an arthroscope shows");
  sub->add_option("case", command->case_spec, "a case folder, builtin:wrist or builtin:knee")
      ->required();
  sub->add_option("--scope", command->scope, "knee_0, knee_30, knee_70, wrist_30 or wrist_30_small")
      ->capture_default_str();
  sub->add_option("--at", command->at_mm, "position of the tip: x,y,z in World, mm")
      ->delimiter(',')
      ->expected(3);
  sub->add_option("--toward", command->toward_mm,
                  "point that the shaft points to: x,y,z in World, mm")
      ->delimiter(',')
      ->expected(3);
  sub->add_option(
         "--post", command->post_deg,
         "rotation of the light post, degrees: at 0 the scope looks up in the picture, at 90 "
         "to the right")
      ->capture_default_str();
  sub->add_option(
         "--up", command->up,
         "direction that is up in the picture: x,y,z in World; default: towards the hip, or "
         "the fingers")
      ->delimiter(',')
      ->expected(3);
  sub->add_option("--flexion", command->flexion_deg, "flexion of a generated knee, degrees");
  add_water_options(*sub, *command);
  add_camera_options(*sub, *command);
  sub->add_option("--size", command->size, "width x height in pixels")->capture_default_str();
  sub->add_option("--out", command->out, "PNG file to write");
  sub->add_option("--standard", command->standard,
                  "folder for the standard views of a knee or a wrist, one picture each; takes the "
                  "place of --at, --toward and --out");
  sub->add_flag("--list", command->list,
                "list what each standard view shows, or only that of --only; exits 1 when a view "
                "lacks something");
  sub->add_option(
      "--views", command->views,
      "table of views to use instead of the standard ones (like assets/views/knee.csv)");
  sub->add_option("--only", command->only, "one standard view, by its name");
  sub->callback([command, &exit_code] {
    if (!command->is_standard() && !command->is_single())
      cli::refuse("--at, --toward and --out", "are needed; or --standard with a folder, or --list");
    if (command->list && !command->out.empty())
      cli::refuse("--list", "leave out --out: no picture is drawn");
    const bool placed = !(command->at_mm.empty() && command->toward_mm.empty());
    if (!command->standard.empty() && (placed || !command->out.empty()))
      cli::refuse("--standard", "leave out --at, --toward and --out");
    if (!command->is_standard() && !(command->only.empty() && command->views.empty()))
      cli::refuse("--only and --views", "go with --standard or --list");
    exit_code = run_view(*command);
  });
}

}  // namespace osteon
