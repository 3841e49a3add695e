#include "undine/app/gauges/error.hpp"

#include <algorithm>
#include <variant>

#include <fmt/format.h>

#include "undine/analysis/norms.hpp"
#include "undine/app/case_shapes.hpp"
#include "undine/app/parameters.hpp"
#include "undine/engine/update.hpp"
#include "undine/geometry/embed.hpp"

namespace undine {
namespace {

using exact::Frame;
using exact::Point;

/// Which of the solution's fields has that name, or -1.
template <class Solution>
constexpr int field_index(std::string_view name) {
  for (std::size_t k = 0; k < Solution::fields.size(); ++k)
    if (Solution::fields[k].name == name) return static_cast<int>(k);
  return -1;
}

/// The value of the field of that name; 0 where the solution has none (and so nothing that is compared).
template <class Solution>
double value_of(std::string_view name, const auto& values) {
  const int k = field_index<Solution>(name);
  return k < 0 ? 0 : values[static_cast<std::size_t>(k)];
}

/// What the fluid should be at a place.
template <int N>
struct State {
  double rho, p, e;
  Vec<N> v;
};

/// d: from the solution's origin; `axes`: its x and y.
template <class Solution, int N>
State<N> state_at(const auto& solution_at_t, const Vec<N>& d, const std::array<Vec<N>, 2>& axes) {
  constexpr Frame frame = Solution::frame;
  Point point;
  if constexpr (frame == Frame::line) point[0] = dot(d, axes[0]);
  if constexpr (frame == Frame::radius) point[0] = norm(d);
  if constexpr (frame == Frame::shear) point[0] = dot(d, axes[1]);
  if constexpr (frame == Frame::plane) point = {{dot(d, axes[0]), dot(d, axes[1])}};
  const auto values = solution_at_t(point);
  State<N> state{value_of<Solution>("density", values),
                 value_of<Solution>("pressure", values),
                 value_of<Solution>("energy", values),
                 {}};
  const double v = value_of<Solution>("velocity", values);
  if constexpr (frame == Frame::line || frame == Frame::shear) state.v = v * axes[0];
  if constexpr (frame == Frame::radius) state.v = point[0] > 0 ? v / point[0] * d : Vec<N>{};
  if constexpr (frame == Frame::plane)
    state.v = value_of<Solution>("velocity_x", values) * axes[0] + value_of<Solution>("velocity_y", values) * axes[1];
  return state;
}

/// Norms of several fields, gathered together.
template <std::size_t n>
struct ManySums {
  std::array<NormSums, n> each;
  ManySums& operator+=(const ManySums& o) {
    for (std::size_t k = 0; k < n; ++k) each[k] += o.each[k];
    return *this;
  }
};

struct WeightedSum {
  double sum = 0, weight = 0;
  WeightedSum& operator+=(const WeightedSum& o) {
    sum += o.sum;
    weight += o.weight;
    return *this;
  }
};

constexpr std::string_view axis_words[]{"x", "y", "z"};

}  // namespace

template <int N>
ErrorGauge<N>::ErrorGauge(const Table& table, const GaugeContext<N>& context) {
  read_solution(table);
  const Vec3 point = table.has("origin") ? read_point(table, "origin", N) : Vec3{};
  for (int k = 0; k < N; ++k) origin_[k] = point[k];
  read_axes(table, context);
  read_fields(table);
  if (table.has("region")) region_ = read_shape(table.table("region"), N);
  time_shift_ = table.non_negative("time_shift", unit::time, 0.0);
  const bool pressure = std::ranges::any_of(fields_, [](const Field& f) { return f.name == "pressure"; });
  if (pressure) without_mean_pressure_ = table.flag("without_mean_pressure", false);
}

template <int N>
void ErrorGauge<N>::read_solution(const Table& table) {
  std::vector<std::string> usable;
  exact::ExactSolutions::for_each([&]<class S>(S) {
    if (S::frame != Frame::time && (N > 1 || S::frame == Frame::line || S::frame == Frame::radius))
      usable.emplace_back(S::info.name);
  });
  solution_ = exact::make_solution(exact::ExactSolutions::index_of(table.choice("exact", usable)));
  std::visit(
      [&]<class S>(S& solution) {
        if constexpr (requires { solution.dimensions; }) solution.dimensions = N;
        const Table parameters = table.table("parameters");
        read_parameters(parameters, solution);
        if constexpr (requires { solution.dimensions; })
          if (solution.dimensions != N)
            parameters.fail("dimensions",
                            fmt::format("the solution has {} dimensions, the case {}", solution.dimensions, N), {},
                            "leave 'dimensions' out: it is that of the case");
        try {
          solution.at(0);
        } catch (const InputError& error) {
          table.fail("exact", error.parts().what, error.parts().why, error.parts().fix);
        }
      },
      solution_);
}

/// The axes of the case that the solution's x and y lie along. If the case does not say: x and y; for a column at rest,
/// upwards.
template <int N>
void ErrorGauge<N>::read_axes(const Table& table, const GaugeContext<N>& context) {
  const auto [frame, along_gravity] = std::visit(
      []<class S>(const S&) { return std::pair(S::frame, S::frame == Frame::line && S::coordinates[0] == "y"); },
      solution_);
  if (frame == Frame::radius) return;
  const std::size_t count = frame == Frame::line ? 1 : 2;
  std::vector<std::string> valid, usual;
  for (int k = 0; k < N; ++k) valid.emplace_back(axis_words[k]);
  for (int k = 0; k < N; ++k) valid.push_back(fmt::format("-{}", axis_words[k]));
  if (along_gravity) {
    int axis = 0;
    for (int k = 1; k < N; ++k)
      if (std::abs(context.gravity[k]) >= std::abs(context.gravity[axis])) axis = k;
    usual = {valid[static_cast<std::size_t>(context.gravity[axis] > 0 ? N + axis : axis)]};
  } else {
    usual.assign(valid.begin(), valid.begin() + static_cast<std::ptrdiff_t>(count));
  }
  const std::vector<std::string> words = table.choices("axes", valid, usual);
  if (words.size() != count)
    table.fail("axes", fmt::format("this solution has {} of 'axes', not {}", count, words.size()), {},
               fmt::format("such as [\"{}\"]", fmt::join(usual, "\", \"")));
  for (std::size_t k = 0; k < count; ++k) axes_[k][words[k].back() - 'x'] = words[k][0] == '-' ? -1 : 1;
  if (count == 2 && dot(axes_[0], axes_[1]) != 0)
    table.fail("axes", "both 'axes' lie along the same line", {}, "give two different ones");
}

template <int N>
void ErrorGauge<N>::read_fields(const Table& table) {
  std::vector<Field> all;
  std::vector<std::string> usual;
  std::visit(
      [&]<class S>(const S&) {
        if (field_index<S>("velocity") >= 0 || field_index<S>("velocity_x") >= 0) {
          usual.emplace_back("velocity");
          all.push_back({"velocity", "v", "m/s"});
          for (int k = 0; k < N; ++k)
            all.push_back({fmt::format("velocity_{}", axis_words[k]), fmt::format("v{}", axis_words[k]), "m/s", k});
        }
        if (field_index<S>("pressure") >= 0) all.push_back({usual.emplace_back("pressure"), "p", "Pa"});
        if (field_index<S>("density") >= 0) all.push_back({usual.emplace_back("density"), "rho", "kg/m^3"});
        // Liquids have none, so it is not usual.
        if (field_index<S>("energy") >= 0) all.push_back({"energy", "e", "J/kg"});
      },
      solution_);
  std::vector<std::string> valid;
  for (const Field& field : all) valid.push_back(field.name);
  const std::vector<std::string> words = table.choices("fields", valid, usual);
  if (words.empty()) table.fail("fields", "'fields' is empty", {}, "name at least one of " + listed(valid));
  for (const std::string& word : words) fields_.push_back(*std::ranges::find(all, word, &Field::name));
}

template <int N>
std::vector<SeriesColumn> ErrorGauge<N>::columns() const {
  std::vector<SeriesColumn> all;
  for (const Field& field : fields_) {
    for (const char* norm_name : {"L1", "L2", "Linf"})
      all.push_back({fmt::format("{}_{}", field.column, norm_name), field.unit});
    all.push_back({fmt::format("{}_L2_relative", field.column)});
  }
  return all;
}

template <int N>
std::vector<double> ErrorGauge<N>::read(const Flow<N>& flow) const {
  const Store<N>& store = flow.store();
  const auto x = store.template get<field::x>();
  const auto v = store.template get<field::v>();
  const auto m = store.template get<field::m>();
  const auto rho = store.template get<field::rho>();
  const auto p = store.template get<field::p>();
  const auto e = store.template get<field::e>();
  const auto counts = [&](std::size_t i) { return !region_ || region_->inside(widen(flow.domain().wrapped(x[i]))); };
  return std::visit(
      [&]<class S>(const S& solution) -> std::vector<double> {
        if constexpr (S::frame == Frame::time) return {};
        const auto solution_at_t = solution.at(flow.time() + time_shift_);
        const auto exact_at = [&](std::size_t i) {
          const Vec<N> d = S::frame == Frame::radius ? flow.domain().nearest_image(x[i] - origin_)
                                                     : flow.domain().wrapped(x[i]) - origin_;
          return state_at<S>(solution_at_t, d, axes_);
        };
        double shift = 0;  // of all pressures
        if (without_mean_pressure_) {
          const WeightedSum mean = total_over(store, Group::fluid, [&](std::size_t i) {
            if (!counts(i)) return WeightedSum{};
            const double volume = m[i] / rho[i];
            return WeightedSum{volume * (p[i] - exact_at(i).p), volume};
          });
          shift = mean.weight > 0 ? mean.sum / mean.weight : 0;
        }
        using Sums = ManySums<most_fields>;
        const Sums sums = total_over(store, Group::fluid, [&](std::size_t i) {
          Sums own;
          if (!counts(i)) return own;
          const State<N> wanted = exact_at(i);
          const double volume = m[i] / rho[i];
          for (std::size_t k = 0; k < fields_.size(); ++k) {
            const Field& f = fields_[k];
            NormSums& sum = own.each[k];
            if (f.name == "pressure") {
              sum.add(volume, p[i] - shift - wanted.p, wanted.p);
            } else if (f.name == "density") {
              sum.add(volume, rho[i] - wanted.rho, wanted.rho);
            } else if (f.name == "energy") {
              sum.add(volume, e.empty() ? std::nan("") : e[i] - wanted.e, wanted.e);
            } else if (f.component < 0) {
              sum.add(volume, norm(v[i] - wanted.v), norm(wanted.v));
            } else {
              sum.add(volume, v[i][f.component] - wanted.v[f.component], wanted.v[f.component]);
            }
          }
          return own;
        });
        std::vector<double> row;
        for (std::size_t k = 0; k < fields_.size(); ++k) {
          const Norms norms = sums.each[k].norms();
          row.insert(row.end(), {norms.l1, norms.l2, norms.linf, norms.relative});
        }
        return row;
      },
      solution_);
}

template class ErrorGauge<1>;
template class ErrorGauge<2>;
template class ErrorGauge<3>;

}  // namespace undine
