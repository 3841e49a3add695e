#include "undine/app/picture/colour_map.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "undine/app/report/report.hpp"
#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/io/run_record.hpp"

namespace undine {
namespace {

const Json& table() {
  static const Json maps = Json::parse(colour_maps_json()).at("maps");
  return maps;
}

double channel(const std::string& colours, std::size_t at) {
  return std::stoi(colours.substr(at, 2), nullptr, 16) / 255.0;
}

}  // namespace

std::vector<std::string> ColourMap::names() {
  std::vector<std::string> all;
  for (const Json& map : table()) all.push_back(map.at("name"));
  return all;
}

ColourMap ColourMap::find(const std::string& name) {
  for (const Json& map : table()) {
    if (map.at("name") != name) continue;
    ColourMap found;
    found.signed_ = map.contains("signed");
    const std::string colours = map.at("colours");
    for (std::size_t k = 0; k + 6 <= colours.size(); k += 6)
      found.nodes_.push_back({channel(colours, k), channel(colours, k + 2), channel(colours, k + 4)});
    return found;
  }
  throw InputError({.what = fmt::format("there is no colour map '{}'", shortened(name, 40)),
                    .why = "colour maps are " + listed(names()),
                    .fix = did_you_mean(name, names())});
}

Colour ColourMap::at(double share) const {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(nodes_.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), nodes_.size() - 2);
  const double part = place - static_cast<double>(k);
  const auto between = [&](double a, double b) { return a + (b - a) * part; };
  const Colour &a = nodes_[k], &b = nodes_[k + 1];
  return {between(a.red, b.red), between(a.green, b.green), between(a.blue, b.blue)};
}

}  // namespace undine
