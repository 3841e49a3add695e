#include "undine/app/picture/picture.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "undine/app/picture/camera.hpp"
#include "undine/app/picture/colour_map.hpp"
#include "undine/app/picture/legend.hpp"
#include "undine/app/picture/raster.hpp"
#include "undine/core/error.hpp"

namespace undine {
namespace {

constexpr Colour white{1, 1, 1}, red{1, 0, 0}, blue{0, 0, 1};

Colour pixel(const Image& image, int x, int y) {
  return image
      .pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)];
}

TEST(ColourMap, ends_of_viridis_are_its_published_ones) {
  const ColourMap map = ColourMap::find("viridis");
  EXPECT_NEAR(map.at(0).red * 255, 0x44, 0.5);  // #440154
  EXPECT_NEAR(map.at(0).green * 255, 0x01, 0.5);
  EXPECT_NEAR(map.at(0).blue * 255, 0x54, 0.5);
  EXPECT_NEAR(map.at(1).red * 255, 0xfd, 0.5);  // #fde725
  EXPECT_NEAR(map.at(1).green * 255, 0xe7, 0.5);
  EXPECT_NEAR(map.at(1).blue * 255, 0x25, 0.5);
}

TEST(ColourMap, brightness_rises_in_the_sequential_ones) {
  for (const char* name : {"viridis", "cividis", "inferno"}) {
    const ColourMap map = ColourMap::find(name);
    double before = -1;
    for (int k = 0; k <= 20; ++k) {
      const Colour c = map.at(k / 20.0);
      const double brightness = 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
      EXPECT_GT(brightness, before) << name << " at " << k;
      before = brightness;
    }
  }
}

TEST(ColourMap, unknown_name_is_answered_with_the_known_ones) {
  EXPECT_THROW(ColourMap::find("viridi"), InputError);
  EXPECT_TRUE(ColourMap::find("blue_red").is_signed());
}

TEST(Camera, flat_box_fills_the_area_and_y_points_up) {
  const Box3 box{{{0, 0, 0}}, {{2, 1, 0}}};
  const Camera camera = Camera::flat(box, {10, 20, 400, 300}, 1);
  const Seen low = camera.see({{0, 0, 0}}), high = camera.see({{2, 1, 0}});
  EXPECT_NEAR(low.x, 10, 1e-9);
  EXPECT_NEAR(high.x, 410, 1e-9);
  EXPECT_NEAR(low.scale, 200, 1e-9);
  EXPECT_NEAR(low.y - high.y, 200, 1e-9);
  EXPECT_NEAR((low.y + high.y) / 2, 170, 1e-9);
}

TEST(Camera, box_in_space_stays_in_the_area_and_touches_it) {
  const Box3 box{{{0, 0, 0}}, {{3, 1, 1}}};
  const Area area{50, 40, 600, 400};
  for (const bool perspective : {false, true}) {
    const Camera camera = Camera::around(box, area, {{0, 0, 1}}, {.perspective = perspective});
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (int k = 0; k < 8; ++k) {
      const Seen seen = camera.see({{k & 1 ? 3.0 : 0.0, k & 2 ? 1.0 : 0.0, k & 4 ? 1.0 : 0.0}});
      EXPECT_TRUE(seen.ahead);
      left = std::min(left, seen.x), right = std::max(right, seen.x);
      top = std::min(top, seen.y), bottom = std::max(bottom, seen.y);
    }
    EXPECT_NEAR(std::max((right - left) / area.width, (bottom - top) / area.height), 1, 1e-9);
    EXPECT_NEAR((left + right) / 2, 350, 1e-6);
  }
}

TEST(Camera, looks_from_the_front_with_x_to_the_right_and_z_up) {
  const Box3 box{{{0, 0, 0}}, {{3, 1, 1}}};
  const Camera camera =
      Camera::around(box, {0, 0, 600, 400}, {{0, 0, 1}}, {.azimuth = 0, .elevation = 0, .perspective = false});
  EXPECT_GT(camera.see({{3, 0, 0}}).x, camera.see({{0, 0, 0}}).x);
  EXPECT_LT(camera.see({{0, 0, 1}}).y, camera.see({{0, 0, 0}}).y);
  EXPECT_GT(camera.see({{0, 0, 0}}).depth, camera.see({{0, 1, 0}}).depth);
}

TEST(DrawDiscs, the_nearer_disc_hides_the_farther_whatever_their_order) {
  const Disc near{20, 20, 8, 1, 0, red}, far{24, 20, 8, 0, 0, blue};
  for (const auto& discs : {std::vector{near, far}, std::vector{far, near}}) {
    Image image(40, 40, white);
    draw_discs(image, discs, 0, white);
    EXPECT_EQ(pixel(image, 22, 20).red, 1);
    EXPECT_EQ(pixel(image, 22, 20).blue, 0);
    EXPECT_EQ(pixel(image, 30, 20).blue, 1);
    EXPECT_EQ(pixel(image, 30, 20).red, 0);
    EXPECT_EQ(pixel(image, 2, 2).green, 1);
  }
}

TEST(DrawDiscs, area_is_that_of_the_disc) {
  Image image(200, 200, white);
  draw_discs(image, std::vector{Disc{100, 99.3, 60, 0, 0, red}}, 0, white);
  double covered = 0;
  for (const Colour& c : image.pixels) covered += 1 - c.green;
  EXPECT_NEAR(covered, std::acos(-1.0) * 60 * 60, 20);
}

TEST(DrawPicture, particle_has_the_colour_of_its_value) {
  OwnedFrame frame{.dimensions = 2, .particles = 2};
  frame.columns = {{"x", "m", 2, {0, 0, 1, 0}}, {"p", "Pa", 1, {0, 100}}};
  PictureStyle style{.colour = "pressure", .title = "two"};
  style.spacing = 1;
  const Canvas canvas = draw_picture(frame, 0, style);
  std::set<std::tuple<int, int, int>> colours;
  for (std::size_t i = 0; i < canvas.bytes().size(); i += 4)
    colours.insert({canvas.bytes()[i + 2], canvas.bytes()[i + 1], canvas.bytes()[i]});
  // Brightest where the ball faces the light: the map's colour itself, for both ends of the range.
  const auto has = [&](int r, int g, int b) {
    return std::ranges::any_of(colours, [&](const auto& c) {
      const auto [x, y, z] = c;
      return std::abs(x - r) <= 9 && std::abs(y - g) <= 9 && std::abs(z - b) <= 9;
    });
  };
  EXPECT_TRUE(has(0x44, 0x01, 0x54));
  EXPECT_TRUE(has(0xfd, 0xe7, 0x25));
  EXPECT_THROW(draw_picture(frame, 0, {.colour = "presure"}), InputError);
}

TEST(ShortNumber, keeps_four_digits_and_says_powers) {
  EXPECT_EQ(short_number(0.5), "0.5");
  EXPECT_EQ(short_number(1234.56), "1235");
  EXPECT_EQ(short_number(-2.5), "−2.5");
  EXPECT_EQ(short_number(1.5e-7), "1.5·10⁻⁷");
  EXPECT_EQ(short_number(2e9), "2·10⁹");
  EXPECT_EQ(printed_unit("kg/m^3"), "kg/m³");
}

}  // namespace
}  // namespace undine
