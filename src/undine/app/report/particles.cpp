#include "undine/app/report/particles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/io/snapshot.hpp"

namespace undine {
namespace {

constexpr std::size_t fewest_particles = 20'000;  ///< of a sample, before times are left out too
constexpr std::size_t fewest_frames = 10;
constexpr double margin = 0.9;  ///< later snapshots shrink less than the one that was measured

/// Spreads ids evenly over 0 to 1 without order, so that a sample has no pattern (finaliser of MurmurHash3).
double place_of(std::int64_t id) {
  auto x = static_cast<std::uint64_t>(id) + 0x9e3779b97f4a7c15;
  x = (x ^ x >> 33) * 0xff51afd7ed558ccd;
  x = (x ^ x >> 33) * 0xc4ceb9fe1a85ec53;
  return static_cast<double>((x ^ x >> 33) >> 11) * 0x1p-53;
}

std::int64_t id_of(const OwnedIntColumn* ids, std::size_t particle) {
  return ids != nullptr ? ids->at(particle) : static_cast<std::int64_t>(particle);
}

/// The particles of one group that are in the sample, in order of id.
std::vector<std::size_t> sample(const OwnedFrame& frame, const std::vector<char>& walls, int group, double share) {
  const OwnedIntColumn* ids = frame.find_integers(identity_column);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < frame.particles; ++i)
    if (walls[i] == group && (share >= 1 || place_of(id_of(ids, i)) < share)) chosen.push_back(i);
  std::ranges::sort(chosen, {}, [&](std::size_t i) { return id_of(ids, i); });
  return chosen;
}

std::vector<double> gathered(const OwnedColumn& column, const std::vector<std::size_t>& chosen) {
  const auto width = static_cast<std::size_t>(column.components);
  std::vector<double> values;
  values.reserve(chosen.size() * width);
  for (const std::size_t i : chosen)
    values.insert(values.end(), &column.data[i * width], &column.data[i * width] + width);
  return values;
}

/// Of all fluid particles lowest, highest, and the same of the inner 98 %: the value, or the magnitude and then each
/// component.
Json ranges_of(const OwnedColumn& column, const std::vector<char>& walls) {
  Json all = Json::array();
  for (int part = 0; part <= (column.components == 1 ? 0 : column.components); ++part) {
    const FluidRange range = fluid_range(scalar_values(column, part), walls);
    all.push_back({range.low, range.high, range.inner_low, range.inner_high});
  }
  return all;
}

Json fields_json(const OwnedFrame& frame) {
  Json fields = Json::array();
  for (const OwnedColumn& column : frame.columns)
    if (column.name != frame.position)
      fields.push_back({{"name", column.name},
                        {"unit", column.unit},
                        {"components", column.components},
                        {"meaning", field_meaning(column.name)}});
  return fields;
}

/// Bytes that a particle takes at one of so many times, by the last two of them: what both share, such as walls at
/// rest, is on a page once.
double bytes_per_particle(const OwnedFrame& before, const OwnedFrame& last, std::size_t frames, bool rounded) {
  Blocks blocks;
  frame_json(before, 0, {.rounded = rounded}, blocks);
  const auto first = static_cast<double>(blocks.bytes());
  frame_json(last, 0, {.rounded = rounded}, blocks);
  const double more = static_cast<double>(blocks.bytes()) - first;
  const auto times = static_cast<double>(frames);
  return (first + (times - 1) * more) / times / static_cast<double>(std::max<std::size_t>(last.particles, 1));
}

class Bounds {
 public:
  explicit Bounds(int dimensions)
      : low_(static_cast<std::size_t>(dimensions), infinity), high_(low_.size(), -infinity) {}
  void add(const OwnedColumn& position) {
    for (std::size_t i = 0; i < position.data.size(); ++i) {
      const std::size_t k = i % low_.size();
      if (!std::isfinite(position.data[i])) continue;
      low_[k] = std::min(low_[k], position.data[i]);
      high_[k] = std::max(high_[k], position.data[i]);
    }
  }
  const std::vector<double>& low() const { return low_; }
  const std::vector<double>& high() const { return high_; }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> low_, high_;
};

/// Which of `all` times are shown where `kept` are: the first, the last, and others evenly between.
std::vector<std::size_t> evenly(std::size_t all, std::size_t kept) {
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < kept; ++k) chosen.push_back(kept == 1 ? all - 1 : k * (all - 1) / (kept - 1));
  return chosen;
}

}  // namespace

Json frame_json(const OwnedFrame& frame, double time, const Thinning& thin, Blocks& blocks) {
  const std::vector<char> walls = walls_of(frame);
  const BlockType type = thin.rounded ? BlockType::rounded16 : BlockType::real32;
  Json parts = Json::array(), ranges = Json::object();
  for (const int group : {0, 1}) {
    const auto chosen = sample(frame, walls, group, thin.share);
    if (chosen.empty()) continue;
    std::vector<std::int64_t> ids;
    for (const std::size_t i : chosen) ids.push_back(id_of(frame.find_integers(identity_column), i));
    Json fields = Json::object();
    for (const OwnedColumn& column : frame.columns)
      if (column.name != frame.position)
        fields[column.name] = blocks.add(gathered(column, chosen), column.components, type);
    parts.push_back({{"group", group},
                     {"count", chosen.size()},
                     {"ids", blocks.add_whole(ids)},
                     {"x", blocks.add(gathered(*frame.find(frame.position), chosen), frame.dimensions, type)},
                     {"fields", std::move(fields)}});
  }
  for (const OwnedColumn& column : frame.columns)
    if (column.name != frame.position) ranges[column.name] = ranges_of(column, walls);
  return {{"time", time}, {"step", frame.step}, {"parts", std::move(parts)}, {"ranges", std::move(ranges)}};
}

Thinning fit(std::size_t room, std::size_t frames, std::size_t particles, double exact, double small) {
  const double space = margin * static_cast<double>(room);
  const auto all = static_cast<double>(frames) * static_cast<double>(particles);
  if (all * exact <= space) return {false, 1, frames};
  if (all * small <= space) return {true, 1, frames};
  const double floor = std::min(1.0, static_cast<double>(fewest_particles) / static_cast<double>(particles));
  Thinning thin{true, std::max(space / (all * small), floor), frames};
  const double of_one = thin.share * static_cast<double>(particles) * small;
  const auto fitting = static_cast<std::size_t>(space / of_one);
  thin.frames = std::clamp(fitting, std::min(fewest_frames, frames), frames);
  thin.share = std::min(thin.share, space / (static_cast<double>(thin.frames * particles) * small));
  return thin;
}

Json particles_header(const RunFolder& run, const OwnedFrame& first) {
  Bounds bounds(first.dimensions);
  bounds.add(*first.find(first.position));
  if (run.frames.size() > 1) {
    const OwnedFrame last = read_positions(run.frames.back().file);
    bounds.add(*last.find(last.position));
  }
  return {{"dimensions", first.dimensions},
          {"spacing", run.spacing(first)},
          {"low", bounds.low()},
          {"high", bounds.high()},
          {"stored", first.particles},
          {"shown", first.particles},
          {"rounded", false},
          {"fields", fields_json(first)}};
}

Json particles_of(const RunFolder& run, std::size_t room, Blocks& blocks, std::vector<std::string>& notes) {
  if (run.frames.empty()) return nullptr;
  const OwnedFrame last = read_snapshot(run.frames.back().file);
  const std::size_t times = run.frames.size();
  const OwnedFrame before = read_snapshot(run.frames[times - std::min<std::size_t>(2, times)].file);
  const double exact = bytes_per_particle(before, last, times, false);
  const double small = bytes_per_particle(before, last, times, true);
  const Thinning thin = fit(room, run.frames.size(), last.particles, exact, small);

  Json frames = Json::array();
  Bounds bounds(last.dimensions);
  std::size_t shown = 0;
  for (const std::size_t k : evenly(run.frames.size(), thin.frames)) {
    const OwnedFrame frame = read_snapshot(run.frames[k].file);
    if (frame.dimensions != last.dimensions)
      throw InputError(
          {.what = "the snapshots of this run differ in their dimensions", .where = {run.frames[k].file.string()}});
    bounds.add(*frame.find(frame.position));
    frames.push_back(frame_json(frame, run.frames[k].time, thin, blocks));
  }
  for (const Json& part : frames.back()["parts"]) shown += part["count"].get<std::size_t>();

  if (shown < last.particles)
    notes.push_back(fmt::format("{} of {} particles are on this page, the same at all times; ranges are those of all.",
                                shown, last.particles));
  if (thin.frames < run.frames.size())
    notes.push_back(fmt::format("{} of {} snapshots are on this page.", thin.frames, run.frames.size()));
  if (thin.rounded)
    notes.push_back("To save room, numbers of particles are rounded to 1/65534 of their range at each time.");
  return {{"dimensions", last.dimensions},
          {"spacing", run.spacing(last)},
          {"low", bounds.low()},
          {"high", bounds.high()},
          {"stored", last.particles},
          {"shown", shown},
          {"frames_stored", run.frames.size()},
          {"rounded", thin.rounded},
          {"fields", fields_json(last)},
          {"frames", std::move(frames)}};
}

}  // namespace undine
