// Where a point falls in the pictures of two eyes, against the closed form and as it is drawn.
#include "osteon/render/stereo.h"

#include <cmath>
#include <limits>

#include "../gl_fixture.h"

namespace osteon {
namespace {

constexpr Viewport kScreen{0, 0, 400, 300};

Camera camera_before_origin() {
  Camera camera;
  camera.distance_m = 0.3;
  return camera;
}

/// By similar triangles: how far apart the lines from both eyes through a point at the depth z meet
/// the screen, in pixels; positive: farther to the right for the left eye.
double disparity_px(const Camera& camera, const StereoEyes& eyes, double z_m) {
  const double screen_height_m = 2 * eyes.screen_depth_m * std::tan(camera.vertical_fov_rad / 2);
  const double on_screen_m = eyes.distance_m * (eyes.screen_depth_m / z_m - 1);
  return on_screen_m / screen_height_m * kScreen.height;
}

TEST(Stereo, DisparityIsThatOfSimilarTriangles) {
  Camera camera = camera_before_origin();
  camera.q_WC = Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  for (const double screen_m : {0.15, 0.3, 0.5})
    for (const double eyes_m : {0.0, 0.006, 0.065})
      for (const Vec3& p_C : {Vec3(0, 0, -0.1), Vec3(0.03, -0.02, -0.3), Vec3(-0.05, 0.04, -0.7)}) {
        const StereoEyes eyes{eyes_m, screen_m};
        const Vec3 p_W = camera.X_WC() * p_C;
        const auto left = project(left_eye(camera, eyes), kScreen, p_W);
        const auto right = project(right_eye(camera, eyes), kScreen, p_W);
        ASSERT_TRUE(left && right);
        EXPECT_NEAR(left->x - right->x, disparity_px(camera, eyes, -p_C.z()), 1e-9);
        EXPECT_NEAR(left->y, right->y, 1e-9);
        // The middle eye sees it halfway between.
        EXPECT_NEAR(0.5 * (left->x + right->x), project(camera, kScreen, p_W)->x, 1e-9);
      }
}

TEST(Stereo, ARayThroughAPixelMeetsWhatIsProjectedThere) {
  const Camera eye = left_eye(camera_before_origin(), {0.02, 0.2});
  const Ray ray = ray_through(eye, kScreen, 123.5, 77.25);
  EXPECT_NEAR((ray.origin_W - eye.eye_W()).norm(), 0, 1e-12);
  const auto back = project(eye, kScreen, ray.origin_W + 0.37 * ray.dir_W);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->x, 123.5, 1e-9);
  EXPECT_NEAR(back->y, 77.25, 1e-9);
}

TEST(Stereo, EyesAndLayoutsThatAreNoneAreRefused) {
  const Camera camera = camera_before_origin();
  EXPECT_TRUE(check({0.006, 0.1}, camera));
  EXPECT_FALSE(check({-0.001, 0.1}, camera));
  EXPECT_FALSE(check({0.006, 0}, camera));
  EXPECT_FALSE(check({std::nan(""), 0.1}, camera));
  EXPECT_FALSE(check({0.006, std::numeric_limits<double>::infinity()}, camera));
  Camera parallel = camera;
  parallel.orthographic = true;
  EXPECT_FALSE(check({0.006, 0.1}, parallel));
  EXPECT_FALSE(parse_stereo_layout("sideways"));
  EXPECT_FALSE(parse_stereo_layout(""));
}

Image of_one_color(int width, int height, std::array<std::uint8_t, 3> rgb) {
  Image image{width, height, {}};
  for (int k = 0; k < width * height; ++k)
    image.rgb.insert(image.rgb.end(), rgb.begin(), rgb.end());
  return image;
}

TEST(Stereo, EachEyeHasItsPlaceInThePicture) {
  const Image left = of_one_color(6, 4, {200, 10, 20}), right = of_one_color(6, 4, {30, 40, 50});
  using Rgb = std::array<int, 3>;
  const Rgb l{200, 10, 20}, r{30, 40, 50};
  const Image side = join(left, right, *parse_stereo_layout("side-by-side"));
  EXPECT_EQ(pixel(side, 2, 3), l);
  EXPECT_EQ(pixel(side, 3, 0), r);
  const Image over = join(left, right, *parse_stereo_layout("over-under"));
  EXPECT_EQ(pixel(over, 5, 1), l);
  EXPECT_EQ(pixel(over, 0, 2), r);
  const Image rows = join(left, right, *parse_stereo_layout("interlaced"));
  EXPECT_EQ(pixel(rows, 1, 0), l);
  EXPECT_EQ(pixel(rows, 1, 1), r);
  EXPECT_EQ(pixel(rows, 1, 2), l);
  EXPECT_EQ(pixel(join(left, right, *parse_stereo_layout("anaglyph")), 1, 1), (Rgb{200, 40, 50}));
  EXPECT_TRUE(join(left, of_one_color(5, 4, {0, 0, 0}), StereoLayout::kAnaglyph).rgb.empty());
}

TEST(Stereo, HalvesAreMeansOfTwoPixels) {
  Image left = of_one_color(4, 2, {0, 0, 0});
  left.rgb[0] = 100;  // the first of a pair
  const Image side = join(left, left, StereoLayout::kSideBySide);
  EXPECT_EQ(pixel(side, 0, 0)[0], 50);
  EXPECT_EQ(pixel(side, 2, 0)[0], 50);
  EXPECT_EQ(pixel(side, 1, 0)[0], 0);
}

class StereoPictures : public GlTest {};

/// Middle of what differs between two pictures, across.
double middle_of_change(const Image& a, const Image& b) {
  double sum = 0, count = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      if (std::abs(brightness(a, x, y) - brightness(b, x, y)) > 40) {
        sum += x + 0.5;
        count += 1;
      }
  return count > 0 ? sum / count : std::nan("");
}

TEST_F(StereoPictures, ADrawnBallShiftsAsTheClosedFormSays) {
  const StereoEyes eyes{0.02, 0.3};
  const Camera middle = camera_before_origin();
  for (const double z_m : {0.2, 0.3, 0.45}) {
    Case the_case;
    the_case.bones.push_back(
        make_bone("ball", sphere_mesh(0.004), middle.X_WC() * Vec3(0, 0, -z_m)));
    Renderer renderer = make_renderer(the_case);
    ViewState view = front_view(RenderQuality::kFine), empty = view;
    empty.bones.assign(1, {.visible = false});
    double x[2];
    for (const int eye : {0, 1}) {
      view.camera = empty.camera = eye == 0 ? left_eye(middle, eyes) : right_eye(middle, eyes);
      const Image with = renderer.draw_image(at_rest(the_case), view, 400, 300);
      x[eye] = middle_of_change(with, renderer.draw_image(at_rest(the_case), empty, 400, 300));
    }
    EXPECT_NEAR(x[0] - x[1], disparity_px(middle, eyes, z_m), 0.3) << z_m;
  }
}

TEST_F(StereoPictures, AMarkIsSeenThroughAndGoesAway) {
  Case the_case;
  the_case.bones.push_back(make_bone("ball", sphere_mesh(0.01), Vec3::Zero()));
  Renderer renderer = make_renderer(the_case);
  const ViewState view = front_view();
  const Image without = renderer.draw_image(at_rest(the_case), view, 200, 200);
  TriMesh big = sphere_mesh(0.02);
  renderer.set_marks(std::vector<SolidMark>{{big, {1.0f, 0.85f, 0.1f, 0.3f}}});
  const Image with = renderer.draw_image(at_rest(the_case), view, 200, 200);
  EXPECT_GT(count_different(without, with, 20), 1000);
  // Yellow over the ground beside the ball: blue falls behind red and green.
  const auto [r, g, b] = pixel(with, 100 + 20, 100);
  const auto [r0, g0, b0] = pixel(without, 100 + 20, 100);
  EXPECT_GT(r - b, r0 - b0 + 10);
  EXPECT_GT(g - b, g0 - b0 + 5);
  renderer.set_marks({});
  EXPECT_EQ(renderer.draw_image(at_rest(the_case), view, 200, 200).rgb, without.rgb);
}

}  // namespace
}  // namespace osteon
