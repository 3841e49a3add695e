#include "undine/approximation/consistency.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "undine/approximation/catalogue.hpp"

namespace undine::approximation {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Random numbers that are the same everywhere (splitmix64; Steele, Lea & Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// Uniform in [0, 1).
  double next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ z >> 31) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

template <int N>
Points<N> lattice(int n, double jitter, Random& random) {
  const double spacing = 1.0 / n;
  const int count = N == 1 ? n : N == 2 ? n * n : n * n * n;
  Points<N> points;
  for (int i = 0; i < count; ++i) {
    Vec<N> x;
    for (int k = 0, rest = i; k < N; ++k, rest /= n)
      x[k] = (rest % n + 0.5 + jitter * (2 * random.next() - 1)) * spacing;
    points.x.push_back(x);
    points.volume.push_back(std::pow(spacing, N));
  }
  return points;
}

/// Half of the queries are points of the set, half are anywhere; `margin` is kept inside.
template <int N>
std::vector<Vec<N>> queries_at(Place place, const Points<N>& points, double margin, int count, Random& random) {
  const auto nearest_point = [&](const Vec<N>& x, double least) {
    const auto distance = [&](const Vec<N>& p) {
      double depth = 1;  // below the surface of the domain
      for (int k = 0; k < N; ++k) depth = std::min({depth, p[k], 1 - p[k]});
      return depth > least ? norm_sq(p - x) : 1e9;
    };
    return *std::ranges::min_element(points.x, {}, distance);
  };
  std::vector<Vec<N>> queries;
  for (int q = 0; q < count; ++q) {
    Vec<N> x;
    const double least = place == Place::inside ? margin : 0;
    for (int k = 0; k < N; ++k) x[k] = least + (1 - 2 * least) * random.next();
    if (place == Place::boundary)  // on a face, an edge, a corner in turn
      for (int k = 0; k <= q / 2 % N; ++k) x[(q + k) % N] = random.next() < 0.5 ? 0 : 1;
    queries.push_back(q % 2 == 0 ? x : nearest_point(x, least));
  }
  return queries;
}

/// A function with its derivatives.
template <int N>
struct Function {
  int degree;  ///< of a monomial; -1: the smooth function
  Vec<N> power{};

  double value(const Vec<N>& x) const { return derivative(x, -1, -1); }
  /// With respect to the axes a and b, where they are not -1.
  double derivative(const Vec<N>& x, int a, int b) const { return degree < 0 ? waves(x, a, b) : monomial(x, a, b); }

 private:
  double monomial(const Vec<N>& x, int a, int b) const {
    double product = 1;
    for (int k = 0; k < N; ++k) {
      double p = power[k];
      for (const int axis : {a, b})
        if (axis == k) product *= p--;
      product *= product == 0 ? 0 : std::pow(x[k], p);
    }
    return product;
  }
  /// sin(k.x + 0.3) + cos(l.x - 0.2)
  static double waves(const Vec<N>& x, int a, int b) {
    constexpr double k_all[]{2, 1.5, 1}, l_all[]{-1, 2, 1.5};
    constexpr double quarter = 1.57079632679489661923;
    double k_x = 0.3, l_x = -0.2 + quarter, k_factor = 1, l_factor = 1, shift = 0;  // cos t = sin(t + pi/2)
    for (int i = 0; i < N; ++i) k_x += k_all[i] * x[i], l_x += l_all[i] * x[i];
    for (const int axis : {a, b})
      if (axis >= 0) k_factor *= k_all[axis], l_factor *= l_all[axis], shift += quarter;
    return k_factor * std::sin(k_x + shift) + l_factor * std::sin(l_x + shift);
  }
};

template <int N>
std::vector<Function<N>> all_functions() {
  std::vector<Function<N>> all{{-1, {}}, {0, {}}};
  for (int a = 0; a < N; ++a) {
    Function<N> linear{1, {}};
    linear.power[a] = 1;
    all.push_back(linear);
    for (int b = a; b < N; ++b) {
      Function<N> quadratic{2, linear.power};
      quadratic.power[b] += 1;
      all.push_back(quadratic);
    }
  }
  return all;
}

/// Errors in value, gradient, Hessian and Laplacian of one function at one query.
struct Errors {
  double value = 0, gradient = 0, hessian = 0, laplacian = 0;
};

constexpr double Errors::*all_errors[]{&Errors::value, &Errors::gradient, &Errors::hessian, &Errors::laplacian};

template <int N>
Errors errors_of(const Estimate<N>& estimate, const Function<N>& f, const Vec<N>& x) {
  Errors e{.value = std::abs(estimate.value - f.value(x))};
  double trace = 0;
  for (int a = 0; a < N; ++a) {
    e.gradient = std::hypot(e.gradient, estimate.gradient[a] - f.derivative(x, a, -1));
    for (int b = 0; b < N; ++b) e.hessian = std::hypot(e.hessian, estimate.hessian[a][b] - f.derivative(x, a, b));
    trace += f.derivative(x, a, a);
  }
  e.laplacian = std::abs(estimate.laplacian() - trace);
  return e;
}

/// The points of one arrangement at one spacing, and where they are asked.
template <int N>
struct Setting {
  Points<N> points;
  double support;
  std::map<Place, std::vector<Vec<N>>> queries;

  Setting(int n, Arrangement arrangement, const StudyOptions& options, int realisation) {
    Random random(options.seed * 1000003 + static_cast<std::uint64_t>(1000 * realisation + n));
    points = lattice<N>(n, arrangement == Arrangement::regular ? 0 : options.jitter, random);
    support = options.support / n;
    for (const Place place : {Place::inside, Place::boundary})
      queries[place] = queries_at(place, points, support, options.queries, random);
  }
};

template <int N>
struct Study {
  const StudyOptions& options;
  Arrangement arrangement;
  std::vector<Setting<N>> coarse, fine;  ///< several sets of points, as one end of a row is a small sample
  std::vector<Function<N>> functions = all_functions<N>();

  Study(int n, Arrangement how, const StudyOptions& o) : options(o), arrangement(how) {
    const int realisations = how == Arrangement::regular ? 1 : N == 1 ? 20 : N == 2 ? 5 : 3;
    for (int k = 0; k < realisations; ++k) {
      coarse.emplace_back(n, how, o, k);
      fine.emplace_back(2 * n, how, o, k);
    }
  }

  struct Measured {
    Errors largest[3];  ///< by degree
    Errors rms;         ///< of the smooth function
    double condition = 0;
    int refused = 0;

    void add(int degree, const Errors& e) {
      for (const auto part : all_errors) {
        if (degree < 0)
          rms.*part += sq(e.*part);
        else if (double& most = largest[degree].*part; e.*part > most || std::isnan(e.*part))
          most = e.*part;  // what is not given is NaN, and stays so
      }
    }
  };

  Approximation<N> approximation(const std::string& method, int order, const Setting<N>& at) const {
    return {
        at.points,
        {.method = method, .order = order, .kernel = options.kernel, .support = at.support, .condition_limit = 1e12}};
  }

  Measured measure(const std::string& method, int order, Place place, const std::vector<Setting<N>>& settings) const {
    Measured m;
    int used = 0;
    for (const Setting<N>& at : settings) {
      std::vector<std::vector<double>> values;
      for (const auto& f : functions) {
        values.emplace_back();
        for (const auto& x : at.points.x) values.back().push_back(f.value(x));
      }
      const auto& queries = at.queries.at(place);
      const auto all = approximation(method, order, at).evaluate(queries, {values.begin(), values.end()});
      for (std::size_t q = 0; q < queries.size(); ++q) {
        if (all.status[q] != Status::ok) {
          ++m.refused;
          continue;
        }
        ++used;
        m.condition = std::max(m.condition, all.condition[q]);
        for (std::size_t f = 0; f < functions.size(); ++f)
          m.add(functions[f].degree, errors_of(all.fields[f][q], functions[f], queries[q]));
      }
    }
    for (const auto part : all_errors) m.rms.*part = used > 0 ? std::sqrt(m.rms.*part / used) : nan;
    return m;
  }

  StudyRow row(const std::string& method, int order, Place place) const {
    const Measured a = measure(method, order, place, coarse), b = measure(method, order, place, fine);
    const auto rate = [&](double Errors::*part) { return std::log2(a.rms.*part / b.rms.*part); };
    StudyRow row{.dimensions = N,
                 .method = method,
                 .order = order,
                 .arrangement = arrangement,
                 .place = place,
                 .promised = approximation(method, order, coarse.front()).degrees(),
                 .value = {},
                 .gradient = {},
                 .hessian = {},
                 .value_order = rate(&Errors::value),
                 .gradient_order = rate(&Errors::gradient),
                 .laplacian_order = rate(&Errors::laplacian),
                 .condition = std::max(a.condition, b.condition),
                 .refused = a.refused + b.refused};
    for (std::size_t d = 0; d < 3; ++d) {
      row.value[d] = a.largest[d].value;
      row.gradient[d] = a.largest[d].gradient;
      row.hessian[d] = a.largest[d].hessian;
    }
    return row;
  }
};

}  // namespace

template <int N>
std::vector<StudyRow> consistency_study(const StudyOptions& options, const std::string& method, int order) {
  constexpr int n = N == 1 ? 32 : N == 2 ? 20 : 12;  // spacings along the side
  static_assert(study_points<N> == (N == 1 ? n : N == 2 ? n * n : n * n * n));
  std::vector<StudyRow> rows;
  for (const Arrangement arrangement : {Arrangement::regular, Arrangement::disordered}) {
    const Study<N> study(n, arrangement, options);
    for (const Place place : {Place::inside, Place::boundary}) rows.push_back(study.row(method, order, place));
  }
  return rows;
}

template <int N>
std::vector<StudyRow> consistency_study(const StudyOptions& options) {
  std::vector<StudyRow> rows;
  Methods::for_each([&]<class M>(M) {
    for (int order = M::lowest_order; order <= M::highest_order; ++order)
      std::ranges::copy(consistency_study<N>(options, std::string(M::info.name), order), std::back_inserter(rows));
  });
  return rows;
}

std::vector<EndRow> end_of_support(const StudyOptions& options, const std::string& method, int order) {
  constexpr int n = 64;
  Random random(options.seed);
  const Points<1> points = lattice<1>(n, 0, random);
  const double H = options.support / n;
  const std::vector<double> one(points.x.size(), 1.0);
  std::vector<double> x;
  for (const auto& p : points.x) x.push_back(p[0]);
  std::vector<Vec<1>> queries;
  for (int k = 0; k <= 10; ++k) queries.push_back({{0.1 * k * H}});

  std::vector<EndRow> rows;
  const Approximation<1> by(points, {.method = method, .order = order, .kernel = options.kernel, .support = H});
  const auto all = by.evaluate(queries, {one, x});
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const auto &of_one = all.fields[0][q], &of_x = all.fields[1][q];
    rows.push_back({.distance = 0.1 * static_cast<double>(q),
                    .one = of_one.value,
                    .gradient_of_one = of_one.gradient[0] * H,
                    .x_error = (of_x.value - queries[q][0]) / H,
                    .gradient_of_x = of_x.gradient[0]});
  }
  return rows;
}

template std::vector<StudyRow> consistency_study<1>(const StudyOptions&);
template std::vector<StudyRow> consistency_study<1>(const StudyOptions&, const std::string&, int);
template std::vector<StudyRow> consistency_study<2>(const StudyOptions&);
template std::vector<StudyRow> consistency_study<2>(const StudyOptions&, const std::string&, int);
template std::vector<StudyRow> consistency_study<3>(const StudyOptions&);
template std::vector<StudyRow> consistency_study<3>(const StudyOptions&, const std::string&, int);

}  // namespace undine::approximation
