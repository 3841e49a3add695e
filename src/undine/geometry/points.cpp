#include "undine/geometry/points.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

#include "undine/core/error.hpp"

namespace undine {
namespace {

std::string_view trimmed(std::string_view s) {
  const auto blank = " \t\r\n";
  const auto begin = s.find_first_not_of(blank);
  return begin == std::string_view::npos ? std::string_view{} : s.substr(begin, s.find_last_not_of(blank) - begin + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const auto comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

class CsvReader {
 public:
  CsvReader(const std::string& path, int dimensions) : path_(path), dimensions_(dimensions) {}

  PointTable read() {
    std::ifstream file(path_);
    if (!file) {
      throw InputError({.what = "cannot read the particle file",
                        .where = {.file = path_},
                        .fix = "check the path; it is relative to where the program runs"});
    }
    for (std::string line; std::getline(file, line);) {
      if (++line_ == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
      const auto text = trimmed(line);
      if (text.empty() || text.front() == '#') continue;
      if (target_.empty()) {
        header(fields_of(text));
      } else {
        row(fields_of(text));
      }
    }
    if (target_.empty())
      fail("the particle file is empty", 0, "it has no header line", "start it with a line like x,y,z");
    if (table_.points.empty()) fail("the particle file has no particles", 0, "there is nothing below its header", "");
    return std::move(table_);
  }

 private:
  void header(const std::vector<std::string_view>& fields) {
    std::array<bool, 3> seen{};
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const std::string name(fields[k]);
      const int column = static_cast<int>(k) + 1;
      const bool letters = !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
                           std::all_of(name.begin(), name.end(),
                                       [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; });
      if (!letters) {
        fail("the header is not a list of names", column, fmt::format("'{}' is not a name", name),
             "the first line must name the columns, such as x,y,z,vx,vy,vz,rho");
      }
      const bool coordinate = name == "x" || name == "y" || name == "z";
      const int axis = coordinate ? name[0] - 'x' : 0;
      const auto known = std::find(table_.names.begin(), table_.names.end(), name);
      if (coordinate ? seen[axis] : known != table_.names.end()) {
        fail(fmt::format("column '{}' is named twice", name), column, "", "give each column a name of its own");
      }
      if (coordinate) {
        seen[axis] = true;
        target_.push_back(axis - 3);
      } else {
        target_.push_back(static_cast<int>(table_.names.size()));
        table_.names.push_back(name);
      }
    }
    table_.columns.resize(table_.names.size());
    for (int k = 0; k < dimensions_; ++k) {
      if (seen[k]) continue;
      fail(fmt::format("column '{}' is missing", "xyz"[k]), 0, fmt::format("the case has {} dimensions", dimensions_),
           "");
    }
  }

  void row(const std::vector<std::string_view>& fields) {
    if (fields.size() != target_.size()) {
      fail(fmt::format("the line has {} fields", fields.size()), 0,
           fmt::format("the header names {} columns", target_.size()), "");
    }
    Vec3 p{};
    for (std::size_t k = 0; k < fields.size(); ++k) {
      auto text = fields[k];
      if (text.starts_with('+')) text.remove_prefix(1);
      double x = 0;
      const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), x);
      const int column = static_cast<int>(k) + 1;
      if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(x)) {
        fail(fmt::format("'{}' is not a finite number", fields[k]), column, "", "write numbers like 0.25 or 2.5e-1");
      }
      if (target_[k] >= 0) {
        table_.columns[target_[k]].push_back(x);
      } else {
        const int axis = target_[k] + 3;
        if (axis >= dimensions_ && x != 0) {
          fail(fmt::format("{} is {}", "xyz"[axis], x), column, fmt::format("the case has {} dimensions", dimensions_),
               "leave the column out, or make it 0");
        }
        p[axis] = x;
      }
    }
    table_.points.push_back(p);
  }

  [[noreturn]] void fail(const std::string& what, int column, const std::string& why, const std::string& fix) const {
    throw InputError({.what = what, .where = {path_, line_, column}, .why = why, .fix = fix});
  }

  const std::string& path_;
  int dimensions_;
  int line_ = 0;
  std::vector<int> target_;  ///< by column: axis - 3 for a coordinate, else the index of its name
  PointTable table_;
};

/// Points sorted into hashed cells; points of other cells in one bucket do no harm, as distances decide.
class CellHash {
 public:
  CellHash(const std::vector<Vec3>& points, double cell) : cell_(cell) {
    while (buckets_ < 2 * points.size()) buckets_ *= 2;
    start_.assign(buckets_ + 1, 0);
    for (const Vec3& p : points) ++start_[bucket(home(p)) + 1];
    for (std::size_t k = 0; k < buckets_; ++k) start_[k + 1] += start_[k];
    auto next = start_;
    index_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) index_[next[bucket(home(points[i]))]++] = i;
  }

  template <class Visit>
  void near(const Vec3& p, Visit visit) const {
    const auto h = home(p);
    for (int n = 0; n < 27; ++n) {
      const std::size_t k = bucket({h[0] + n % 3 - 1, h[1] + n / 3 % 3 - 1, h[2] + n / 9 - 1});
      for (std::size_t i = start_[k]; i < start_[k + 1]; ++i) visit(index_[i]);
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell home(const Vec3& p) const {
    Cell c;
    for (int k = 0; k < 3; ++k) {
      const double x = std::floor(p[k] / cell_);
      c[k] = std::abs(x) < 4e18 ? static_cast<std::int64_t>(x) : 0;
    }
    return c;
  }
  std::size_t bucket(const Cell& c) const {
    std::uint64_t h = 0;
    for (const auto x : c) h = (h ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ull, h ^= h >> 32;
    return h & (buckets_ - 1);
  }

  double cell_;
  std::size_t buckets_ = 1;
  std::vector<std::size_t> start_, index_;
};

std::optional<Overlap> closest(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double reach, bool same) {
  if (!(reach > 0) || a.empty() || b.empty()) return std::nullopt;
  const CellHash cells(a, reach);
  Overlap best;
  double best_sq = sq(reach);
  bool found = false;
  for (std::size_t j = 0; j < b.size(); ++j) {
    cells.near(b[j], [&](std::size_t i) {
      if (same && i >= j) return;
      const double d = norm_sq(a[i] - b[j]);
      const bool earlier = found && d == best_sq && i < best.a && j == best.b;
      if (!(d < best_sq) && !earlier) return;
      best_sq = d;
      best = {i, j, std::sqrt(d)};
      found = true;
    });
  }
  return found ? std::optional(best) : std::nullopt;
}

}  // namespace

const std::vector<double>* PointTable::find(const std::string& name) const {
  const auto it = std::find(names.begin(), names.end(), name);
  return it == names.end() ? nullptr : &columns[static_cast<std::size_t>(it - names.begin())];
}

PointTable load_points_csv(const std::string& path, int dimensions) { return CsvReader(path, dimensions).read(); }

std::optional<Overlap> check_overlap(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double min_distance) {
  return closest(a, b, min_distance, false);
}

std::optional<Overlap> check_overlap(const std::vector<Vec3>& points, double min_distance) {
  return closest(points, points, min_distance, true);
}

}  // namespace undine
