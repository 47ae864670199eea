#include "cases/scoped_case.h"

#include <cmath>
#include <utility>

#include "osteon/base/file.h"

namespace osteon {

Result<ScopedCase> ScopedCase::create(Case the_case) {
  const auto data_dir = find_data_dir();
  if (!data_dir) return tl::unexpected(data_dir.error());
  auto renderer = ScopeRenderer::create(the_case, *data_dir, prepare_case(the_case));
  if (!renderer) return tl::unexpected(renderer.error());
  return ScopedCase(std::move(the_case), std::move(*renderer));
}

Result<void> ScopedCase::draw(const ScopeDef& scope, const ScopePose& pose, int width, int height,
                              const std::filesystem::path& out) {
  const auto wall = room_.wall(rest_snapshot(case_), pose.at_W);
  if (!wall) return tl::unexpected(wall.error());
  renderer_.set_wall(*wall);
  const ScopeCamera camera(scope, pose);
  if (strewn_) renderer_.set_water_bits(strewn_(camera, JointRoof(case_).with_wall(*wall)));
  const Image image = renderer_.draw_image(camera, width, height);
  if (image.rgb.empty())
    return fail("the graphics driver has no memory for the picture", out.string(),
                "Choose a smaller --size");
  return save_png(image, out);
}

Result<WaterNow> water_after(const WaterOrder& order, const FluidJoint& joint) {
  constexpr double kStep_s = 0.02, kMost_s = 3600, kThereAndBack_m = 0.020;
  if (auto ok = check_fluid(order.drive); !ok) return tl::unexpected(ok.error());
  if (!(order.after_s >= 0 && order.after_s <= kMost_s))
    return fail("is not 0 to 3600 s", "the time since the pump began");
  if (!(order.turbidity >= 0 && order.turbidity <= 1)) return fail("is not 0 to 1", "--turbidity");
  if (!(order.fog >= 0 && order.fog <= 1)) return fail("is not 0 to 1", "--fog");
  if (!(order.flushed_s >= 0 && order.flushed_s <= kMost_s))
    return fail("is not 0 to 3600 s", "--flush");
  WaterNow water;
  for (auto k = std::llround(order.after_s / kStep_s); k > 0; --k)
    water.state = step_fluid(joint, order.drive, water.state, kStep_s);
  water.flows = fluid_flows(joint, order.drive, water.state.pressure_pa);
  const double bled = light_taken_per_m(joint, water.state);
  const double pale = -std::log1p(-std::min(order.turbidity, 0.9999)) / kThereAndBack_m;
  const double all = bled + pale;
  water.seen = {all, all > 0 ? bled / all : 0, step_fog(order.fog, true, order.flushed_s)};
  water.turbidity = -std::expm1(-kThereAndBack_m * all);
  return water;
}

FluidJoint fluid_of(const Case& the_case) {
  return the_case.find("radius").valid() ? wrist_fluid() : knee_fluid();
}

}  // namespace osteon
