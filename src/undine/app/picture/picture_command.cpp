#include "undine/app/picture/picture_command.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "undine/app/picture/colour_map.hpp"
#include "undine/app/picture/movie.hpp"
#include "undine/app/picture/picture.hpp"
#include "undine/core/error.hpp"
#include "undine/io/snapshot.hpp"

namespace undine {
namespace {

constexpr int largest_side = 8192;
const std::map<std::string, WallStyle> wall_styles{{"behind", WallStyle::behind},
                                                   {"grey", WallStyle::grey},
                                                   {"coloured", WallStyle::coloured},
                                                   {"hidden", WallStyle::hidden}};

[[noreturn]] void refuse(const std::string& option, const std::string& given, std::string fix) {
  throw InputError({.what = fmt::format("'{}' is no {}", given, option), .fix = std::move(fix)});
}

template <class T>
bool parse(std::string_view text, T& value) {
  const auto [end, reason] = std::from_chars(text.data(), text.data() + text.size(), value);
  return reason == std::errc() && end == text.data() + text.size();
}

void read_size(const std::string& text, PictureStyle& style) {
  const std::size_t x = text.find('x');
  const std::string_view view(text);
  const bool good = x != text.npos && parse(view.substr(0, x), style.width) &&
                    parse(view.substr(x + 1), style.height) && std::min(style.width, style.height) >= 64 &&
                    std::max(style.width, style.height) <= largest_side && style.width % 2 == 0 &&
                    style.height % 2 == 0;
  if (!good) refuse("size", text, fmt::format("write it as 1280x720: two even numbers from 64 to {}", largest_side));
}

std::optional<CutAway> read_cut(const std::string& text) {
  if (text.empty()) return {};
  CutAway cut;
  const bool good = text.size() > 2 && text[0] >= 'x' && text[0] <= 'z' && (text[1] == '>' || text[1] == '<') &&
                    parse(std::string_view(text).substr(2), cut.at) && std::isfinite(cut.at);
  if (!good) refuse("cut", text, "write what is cut away, such as 'y>0.5' or 'x<1', in m");
  cut.axis = text[0] - 'x';
  cut.above = text[1] == '>';
  return cut;
}

/// Against gravity; z, or y in a plane, where there is none.
Vec<3> upward(const RunFolder& run) {
  Vec<3> gravity{};
  std::string text = run.resolved("gravity").value_or("");
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
  std::istringstream words(text);
  for (int k = 0; k < 3 && words >> gravity[k]; ++k) {
  }
  int largest = 2;
  for (int k = 0; k < 3; ++k)
    if (std::abs(gravity[k]) > std::abs(gravity[largest])) largest = k;
  Vec<3> up{};
  up[largest] = gravity[largest] > 0 ? -1 : 1;
  return up;
}

PictureStyle style_of(const PictureOptions& options, const RunFolder& run) {
  PictureStyle style{.colour = options.colour, .map = options.map, .title = options.title, .camera = options.camera};
  read_size(options.size, style);
  style.cut = read_cut(options.cut);
  style.camera.perspective = !options.orthographic;
  style.walls = wall_styles.at(options.walls);
  style.up = upward(run);
  style.inner = options.inner;
  style.wall_layers = run.wall_layers();
  if (style.title.empty()) style.title = run.title();
  if (options.range.size() == 2) style.range = {options.range[0], options.range[1]};
  if (style.range && !(style.range->first < style.range->second))
    refuse("range", fmt::format("{:g} {:g}", options.range[0], options.range[1]), "give the lower number first");
  return style;
}

/// Bounds and range over all times, so that a movie's view and colours stand still.
void steady(const RunFolder& run, PictureStyle& style) {
  std::optional<Box3> box;
  std::optional<std::pair<double, double>> range;
  for (const StoredTime& stored : run.frames) {
    const OwnedFrame frame = read_snapshot(stored.file);
    const Box3 more = bounds_of(frame, style);
    const auto [low, high] = range_of(frame, style);
    range = range ? std::pair(std::min(range->first, low), std::max(range->second, high)) : std::pair(low, high);
    if (!box) box = more;
    for (int k = 0; k < 3; ++k) {
      box->low[k] = std::min(box->low[k], more.low[k]);
      box->high[k] = std::max(box->high[k], more.high[k]);
    }
  }
  style.box = box;
  if (style.range || !range) return;
  if (ColourMap::find(style.map).is_signed() && range->first < 0 && range->second > 0) {
    const double most = std::max(-range->first, range->second);
    range = {-most, most};
  }
  style.range = range;
}

std::filesystem::path make_movie(const RunFolder& run, const PictureOptions& options, PictureStyle style) {
  steady(run, style);
  std::filesystem::path folder = options.movie;
  const bool encode = folder.has_extension() && can_encode();
  if (folder.has_extension() && !encode) {
    folder.replace_extension();
    fmt::print("there is no ffmpeg on this machine; the pictures go to {}\n", folder.string());
  }
  const auto movie = encode ? encoded_movie(options.movie, options.rate) : numbered_pictures(folder);
  for (const StoredTime& stored : run.frames) {
    Canvas picture = draw_picture(read_snapshot(stored.file), stored.time, style);
    movie->add(picture);
  }
  return movie->finish();
}

}  // namespace

void add_picture_options(CLI::App& command, PictureOptions& options) {
  command.add_option("folder", options.folder, "of a run")->required();
  command.add_option("-o,--out", options.out, "picture, as PNG");
  command.add_option("--movie", options.movie,
                     "movie of all snapshots, by ffmpeg; a name without ending: numbered PNGs");
  command.add_option("--time", options.time, "s; the nearest snapshot is drawn, the last unless said");
  command.add_option("--colour,--color", options.colour, "field: pressure, speed, density, v_x, ... (speed)");
  command.add_option("--map", options.map, "colour map: viridis, cividis, inferno, blue_red (viridis)");
  command.add_option("--range", options.range, "lowest and highest value of the colours")->expected(2);
  command.add_flag("--inner", options.inner,
                   "range of the colours without the lowest and highest hundredth of the fluid");
  command
      .add_option("--walls", options.walls,
                  "wall particles: behind (grey, but not in front of the fluid), grey, coloured, hidden (behind)")
      ->check(CLI::IsMember({"behind", "grey", "coloured", "hidden"}));
  command.add_option("--cut", options.cut, "what is cut away: 'y>0.5' or 'x<1', in m");
  command.add_option("--size", options.size, "pixels (1280x720)");
  command.add_option("--title", options.title, "the case's title unless said");
  command.add_option("--azimuth", options.camera.azimuth, "degrees to the right, in 3-D (19)");
  command.add_option("--elevation", options.camera.elevation, "degrees upwards, in 3-D (21)")
      ->check(CLI::Range(-89.0, 89.0));
  command.add_option("--zoom", options.camera.zoom, "1: everything just fits")->check(CLI::Range(0.01, 1000.0));
  command.add_flag("--orthographic", options.orthographic, "parallel rays, in 3-D");
  command.add_option("--rate", options.rate, "pictures per second of a movie (12)")->check(CLI::Range(0.1, 240.0));
}

int picture_command(const PictureOptions& options) {
  if (options.out.empty() && options.movie.empty())
    throw InputError({.what = "no file was named for the picture", .fix = "add -o picture.png or --movie movie.mp4"});
  const RunFolder run = RunFolder::open(options.folder);
  PictureStyle style = style_of(options, run);
  const StoredTime& chosen =
      run.frames[options.time < 0 && !run.frames.empty() ? run.frames.size() - 1 : run.nearest(options.time)];
  const OwnedFrame frame = read_snapshot(chosen.file);
  style.spacing = run.spacing(frame);
  if (!options.out.empty()) {
    draw_picture(frame, chosen.time, style).write_png(options.out);
    fmt::print("{}: t = {:.6g} s\n", options.out.string(), chosen.time);
  }
  if (!options.movie.empty())
    fmt::print("{}: {} pictures\n", make_movie(run, options, style).string(), run.frames.size());
  return 0;
}

}  // namespace undine
