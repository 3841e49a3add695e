#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "undine/app/report/blocks.hpp"
#include "undine/app/run/folder.hpp"

namespace undine {

/// The particles of a run for a page, in about so many bytes: all snapshots with the numbers as stored if they fit,
/// else rounded to 16 bits, then a sample of the particles (the same at all times), then fewer times. Null if there are
/// no snapshots. What was left out is said in `notes`.
Json particles_of(const RunFolder& run, std::size_t room, Blocks& blocks, std::vector<std::string>& notes);

/// What there is of particles: as above, without times. `first` is the first snapshot.
Json particles_header(const RunFolder& run, const OwnedFrame& first);

/// How many of its particles and times a page shows, and how.
struct Thinning {
  bool rounded = false;
  double share = 1;        ///< of the particles
  std::size_t frames = 0;  ///< of the times
};

/// One snapshot for a page, its numbers in blocks.
Json frame_json(const OwnedFrame& frame, double time, const Thinning& thin, Blocks& blocks);

/// What fits: a particle at one time takes `exact` bytes, or `small` where rounded.
Thinning fit(std::size_t room, std::size_t frames, std::size_t particles, double exact, double small);

}  // namespace undine
