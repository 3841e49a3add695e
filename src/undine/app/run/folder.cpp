#include "undine/app/run/folder.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/nearest.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view axes = "xyz";
constexpr std::size_t bins = 4096;  ///< to find values of a rank

/// What people say for the fields that they look at most.
const std::map<std::string, std::string, std::less<>> plain_names{
    {"pressure", "p"}, {"velocity", "v"}, {"speed", "v"}, {"density", "rho"}, {"mass", "m"}, {"acceleration", "acc"}};

std::string part_name(int components, int part) {
  const int k = part - 1;
  if (components <= 3) return std::string(1, axes[static_cast<std::size_t>(k)]);
  const int side = components == 9 ? 3 : components == 4 ? 2 : 0;
  if (side == 0) return std::to_string(part);
  return {axes[static_cast<std::size_t>(k / side)], axes[static_cast<std::size_t>(k % side)]};
}

std::vector<StoredTime> read_series(const fs::path& folder) {
  std::vector<StoredTime> frames;
  const fs::path list = folder / "particles.vtkhdf.series";
  if (!fs::exists(list)) return frames;
  const Json json = read_json(list);
  try {
    for (const Json& entry : json.at("files")) {
      const fs::path name = entry.at("name").get<std::string>();
      if (name.has_parent_path())
        throw InputError({.what = "a snapshot is named outside of its run's folder",
                          .where = {list.string()},
                          .why = name.string()});
      frames.push_back({folder / name, entry.at("time").get<double>()});
    }
  } catch (const Json::exception& error) {
    throw InputError({.what = "this is not a list of snapshots", .where = {list.string()}, .why = error.what()});
  }
  std::ranges::stable_sort(frames, {}, &StoredTime::time);
  return frames;
}

}  // namespace

RunFolder RunFolder::open(const fs::path& folder) {
  if (!fs::is_regular_file(folder / "run.json"))
    throw InputError({.what = fmt::format("'{}' does not hold a run", folder.string()),
                      .why = fs::is_directory(folder) ? "there is no run.json in it" : "there is no such folder",
                      .fix = "name the folder that `undine run` wrote its results to"});
  RunFolder run{.folder = folder, .record = read_json(folder / "run.json"), .frames = read_series(folder)};
  if (!run.record.is_object())
    throw InputError({.what = "this is not the record of a run", .where = {(folder / "run.json").string()}});
  return run;
}

std::optional<std::string> RunFolder::resolved(const std::string& key) const {
  const auto keys = record.find("resolved");
  if (keys == record.end() || !keys->is_object()) return {};
  const auto found = keys->find(key);
  if (found == keys->end() || !found->is_string()) return {};
  return found->get<std::string>();
}

std::string RunFolder::title() const {
  std::string text = resolved("title").value_or("");
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  if (!text.empty()) return text;
  const auto file = record.find("case");
  if (file != record.end() && file->is_string()) return fs::path(file->get<std::string>()).stem().string();
  return folder.filename().string();
}

double RunFolder::spacing(const OwnedFrame& frame) const {
  try {
    const double value = std::stod(resolved("spacing").value_or(""));
    if (value > 0 && std::isfinite(value)) return value;
  } catch (const std::exception&) {  // not a number; the particles themselves say it
  }
  const OwnedColumn *m = frame.find("m"), *rho = frame.find("rho"), *x = frame.find(frame.position);
  if (m != nullptr && rho != nullptr && frame.particles > 0 && rho->data[0] > 0)
    return std::pow(m->data[0] / rho->data[0], 1.0 / frame.dimensions);
  double extent = 0;
  for (const double value : x->data) extent = std::max(extent, std::abs(value));
  return extent / std::pow(static_cast<double>(std::max<std::size_t>(frame.particles, 1)), 1.0 / frame.dimensions);
}

int RunFolder::wall_layers() const {
  int most = 1;
  for (int k = 0;; ++k) {
    const auto layers = resolved(fmt::format("wall[{}].layers", k));
    if (!layers) return most;
    int value = 0;
    std::from_chars(layers->data(), layers->data() + layers->size(), value);
    most = std::max(most, value);
  }
}

std::size_t RunFolder::nearest(double time) const {
  if (frames.empty())
    throw InputError({.what = fmt::format("the run in '{}' has no snapshots", folder.string()),
                      .fix = "set output.snapshots in its case and run it again"});
  const auto distance = [&](const StoredTime& frame) { return std::abs(frame.time - time); };
  return static_cast<std::size_t>(std::ranges::min_element(frames, {}, distance) - frames.begin());
}

ScalarChoice find_scalar(const OwnedFrame& frame, const std::string& name) {
  const auto known = plain_names.find(name);
  const std::string field = known == plain_names.end() ? name : known->second;
  std::vector<std::string> names;
  for (const OwnedColumn& column : frame.columns) {
    if (column.name == field) return {field, 0};
    names.push_back(column.name);
    if (column.components == 1) continue;
    for (int part = 1; part <= column.components; ++part) {
      names.push_back(fmt::format("{}_{}", column.name, part_name(column.components, part)));
      if (names.back() == field) return {column.name, part};
    }
  }
  const std::string why = "they hold " + listed(names);
  for (const auto& [word, meant] : plain_names)
    if (frame.find(meant) != nullptr) names.push_back(word);
  throw InputError({.what = fmt::format("the snapshots have no field '{}'", shortened(name, 40)),
                    .why = why,
                    .fix = did_you_mean(name, names)});
}

std::string scalar_label(const ScalarChoice& choice, int components) {
  if (components == 1) return choice.field;
  if (choice.part == 0) return "|" + choice.field + "|";
  return fmt::format("{}_{}", choice.field, part_name(components, choice.part));
}

std::vector<double> scalar_values(const OwnedColumn& column, int part) {
  if (column.components == 1) return column.data;
  const auto width = static_cast<std::size_t>(column.components);
  std::vector<double> values(column.data.size() / width);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double* row = &column.data[i * width];
    double sum = 0;
    for (std::size_t k = 0; k < width; ++k) sum += row[k] * row[k];
    values[i] = part > 0 ? row[part - 1] : std::sqrt(sum);
  }
  return values;
}

FluidRange fluid_range(const std::vector<double>& values, const std::vector<char>& walls) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto counts = [&](std::size_t i) { return !walls[i] && std::isfinite(values[i]); };
  double low = infinity, high = -infinity;
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!counts(i)) continue;
    low = std::min(low, values[i]);
    high = std::max(high, values[i]);
    ++count;
  }
  if (!(low < high)) return {low, high, low, high};

  // The values of a rank, of millions: counted by bins first, then looked for in one bin.
  const double scale = bins / (high - low);
  const auto bin_of = [&](double value) {
    const double place = (value - low) * scale;
    return place < bins ? static_cast<std::size_t>(place) : bins - 1;
  };
  std::vector<std::size_t> sizes(bins, 0);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (counts(i)) ++sizes[bin_of(values[i])];
  const auto ranked = [&](std::size_t rank) {
    std::size_t bin = 0;
    for (; rank >= sizes[bin]; ++bin) rank -= sizes[bin];
    std::vector<double> inside;
    inside.reserve(sizes[bin]);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (counts(i) && bin_of(values[i]) == bin) inside.push_back(values[i]);
    std::ranges::nth_element(inside, inside.begin() + static_cast<std::ptrdiff_t>(rank));
    return inside[rank];
  };
  const std::size_t last = count - 1, lower = last / 100;
  return {low, high, ranked(lower), ranked(last - lower)};
}

std::vector<char> walls_of(const OwnedFrame& frame) {
  std::vector<char> walls(frame.particles, 0);
  if (const OwnedIntColumn* groups = frame.find_integers("group"))
    for (std::size_t i = 0; i < frame.particles; ++i) walls[i] = groups->at(i) == 1;
  return walls;
}

std::string field_meaning(const std::string& name) {
  for (const FieldInfo& field : all_fields)
    if (field.name == name) return std::string(field.meaning);
  return {};
}

}  // namespace undine
