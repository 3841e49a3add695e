#pragma once
#include <filesystem>
#include <memory>

#include "undine/app/picture/canvas.hpp"

namespace undine {

/// Pictures one after the other, all of one size.
class Movie {
 public:
  virtual ~Movie() = default;
  virtual void add(Canvas& picture) = 0;
  /// Ends the movie and returns its file, or the folder of its pictures. Throws Error.
  virtual std::filesystem::path finish() = 0;
};

/// H.264 by the program ffmpeg.
std::unique_ptr<Movie> encoded_movie(const std::filesystem::path& file, double frames_per_second);
/// FOLDER/000000.png, 000001.png, ...
std::unique_ptr<Movie> numbered_pictures(const std::filesystem::path& folder);

/// Whether ffmpeg is on the search path.
bool can_encode();

}  // namespace undine
