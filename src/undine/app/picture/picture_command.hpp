#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "undine/app/picture/camera.hpp"

namespace undine {

/// What `undine picture` is told.
struct PictureOptions {
  std::filesystem::path folder, out, movie;
  double time = -1;  ///< s; below 0: the last snapshot
  double rate = 12;  ///< pictures per second of a movie
  std::string colour = "v", map = "viridis", walls = "behind", cut, size = "1280x720", title;
  std::vector<double> range;  ///< two numbers, or none
  CameraOptions camera;
  bool orthographic = false, inner = false;
};

void add_picture_options(CLI::App& command, PictureOptions& options);

/// Draws a picture, a movie, or both, and says what was written. Throws InputError, Error.
int picture_command(const PictureOptions& options);

}  // namespace undine
