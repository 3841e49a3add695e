#include "undine/app/bench/states.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace undine {
namespace {

constexpr double dp = 0.01;  // m
constexpr double rest_density = 1000, gravity = 9.81;

/// Numbers in [-1, 1) that are the same on every machine.
class Random {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11) * 0x1p-52 - 1.0;
  }
  Vec<3> vector() {
    const double a = (*this)(), b = (*this)();
    return {{a, b, (*this)()}};
  }

 private:
  std::uint64_t state_ = 1;
};

Vec<3> turned(const Vec<3>& p) {
  const double c1 = std::cos(0.5), s1 = std::sin(0.5), c2 = std::cos(0.7), s2 = std::sin(0.7);
  const Vec<3> q{{c1 * p[0] - s1 * p[1], s1 * p[0] + c1 * p[1], p[2]}};
  return {{q[0], c2 * q[1] - s2 * q[2], s2 * q[1] + c2 * q[2]}};
}

/// A few waves of random direction and no divergence, |v| of order 1: it neither turns nor carries the whole.
class SmoothFlow {
 public:
  SmoothFlow(double wavelength, Random& random) {
    for (Wave& wave : waves_) {
      wave.k = random.vector();
      wave.k = (2 * std::numbers::pi / wavelength / norm(wave.k)) * (1.5 + 0.5 * random()) * wave.k;
      wave.amplitude = cross(wave.k, random.vector());
      wave.amplitude = (1 / norm(wave.amplitude)) * wave.amplitude;
      wave.phase = std::numbers::pi * random();
    }
  }
  Vec<3> operator()(const Vec<3>& x) const {
    Vec<3> v;
    for (const Wave& wave : waves_) v += std::sin(dot(wave.k, x) + wave.phase) * wave.amplitude;
    return v;
  }

 private:
  struct Wave {
    Vec<3> k, amplitude;
    double phase;
  };
  Wave waves_[6];
};

struct Points {
  std::vector<Vec<3>> x, v;  ///< in spacings, and in any unit
  std::vector<double> depth;
};

/// A cube on a lattice that is jittered by 10 % and turned out of the axes: an aligned lattice flatters every blocked
/// scheme.
Points make_block(int particles, Random& random) {
  const int side = std::max(2, static_cast<int>(std::lround(std::cbrt(particles))));
  const SmoothFlow flow(side, random);
  Points points;
  for (int a = 0; a < side; ++a)
    for (int b = 0; b < side; ++b)
      for (int c = 0; c < side; ++c) {
        points.x.push_back(turned(Vec<3>{{1.0 * a, 1.0 * b, 1.0 * c}} + 0.1 * random.vector()));
        points.v.push_back(flow(points.x.back()));
        points.depth.push_back(0);
      }
  Vec<3> mean;
  for (const auto& v : points.v) mean += v;
  mean = (1.0 / static_cast<double>(points.v.size())) * mean;
  for (auto& v : points.v) v -= mean;
  return points;
}

/// The shape of a broken dam, in spacings: scale s, tank 6 s long and 1.5 s wide. A body leans on one end (from 2 s
/// down to 0.5 s high), its tongue of three layers has run along the floor, and a sheet of two layers stands up at the
/// far end.
struct Dam {
  double s;

  static Dam of(double water) {
    Dam dam{1};
    while (dam.volume() < water) dam.s *= 1.001;
    return dam;
  }
  double volume() const { return 5.625 * cube(s) + 18 * sq(s); }
  Vec<3> size() const { return {{6 * s, 1.5 * s, 2 * s}}; }
  double surface(double x) const {
    if (x < 3 * s) return 2 * s - 0.5 * x;
    return x > 6 * s - 2 ? 1.5 * s : 3;
  }
  bool holds(const Vec<3>& p) const {
    return p[0] >= 0 && p[0] < 6 * s && p[1] >= 0 && p[1] < 1.5 * s && p[2] >= 0 && p[2] < surface(p[0]);
  }
  /// The body sinks and spreads, the tongue runs, the sheet rises.
  Vec<3> velocity(const Vec<3>& p) const {
    if (p[0] < 3 * s) return {{p[0] / (3 * s), 0, -p[2] / (3 * s)}};
    return p[0] > 6 * s - 2 ? Vec<3>{{0, 0, 0.8}} : Vec<3>{{1, 0, 0}};
  }
};

/// Balls of 1, 7, 19 and 33 particles, half of them single ones, each in a cell of its own: most have no neighbour
/// outside their ball.
void add_spray(const Dam& dam, std::size_t total, Random& random, Points& points) {
  constexpr double cell = 5;
  std::vector<Vec<3>> places;
  for (double x = cell / 2; x < 6 * dam.s; x += cell)
    for (double y = cell / 2; y < 1.5 * dam.s; y += cell)
      for (double z = std::max(dam.surface(x), dam.surface(x + cell / 2)) + cell; z < 8 * dam.s; z += cell)
        places.push_back({{x, y, z}});
  const double radii_sq[] = {0, 0, 0, 1, 2.25, 4};
  for (std::size_t left = places.size(); left > 0 && points.x.size() < total; --left) {
    const auto pick = [&](std::size_t n) {
      return std::min(n - 1, static_cast<std::size_t>(0.5 * (random() + 1) * static_cast<double>(n)));
    };
    std::swap(places[pick(left)], places[left - 1]);
    const Vec<3> centre = places[left - 1] + 0.4 * random.vector();
    const Vec<3> velocity = (1 / std::sqrt(3.0)) * random.vector();
    const double radius_sq = radii_sq[pick(std::size(radii_sq))];
    for (int a = -2; a <= 2; ++a)
      for (int b = -2; b <= 2; ++b)
        for (int c = -2; c <= 2; ++c) {
          if (a * a + b * b + c * c > radius_sq || points.x.size() == total) continue;
          points.x.push_back(centre + turned({{1.0 * a, 1.0 * b, 1.0 * c}}) + 0.1 * random.vector());
          points.v.push_back(velocity);
          points.depth.push_back(0);
        }
  }
}

/// What a dam break looks like to the loops at about t (g/h)^(1/2) = 2, when it is slowest: most particles in a body
/// with a full neighbourhood, a tenth in sheets of two or three layers with half of one, and one in twelve in drops or
/// alone, with few or no neighbours, scattered over a volume a dozen times that of the water, so that most cells of a
/// grid are empty. Made rather than computed: it costs a second, and is the same on every machine.
Points make_splash(int particles, Random& random) {
  const Dam dam = Dam::of(0.92 * particles);
  const SmoothFlow flow(2 * dam.s, random);
  const Vec<3> middle = 0.5 * dam.size();
  const int reach = static_cast<int>(norm(middle)) + 1;
  Points points;
  for (int a = -reach; a <= reach; ++a)
    for (int b = -reach; b <= reach; ++b)
      for (int c = -reach; c <= reach; ++c) {
        const Vec<3> p = middle + turned({{1.0 * a, 1.0 * b, 1.0 * c}});
        if (!dam.holds(p)) continue;
        points.x.push_back(p + 0.1 * random.vector());
        points.v.push_back(dam.velocity(p) + 0.1 * flow(p));
        points.depth.push_back(dam.surface(p[0]) - p[2]);
      }
  add_spray(dam, static_cast<std::size_t>(particles), random, points);
  return points;
}

/// Floor and end walls, as many layers as the support reaches, the first half a spacing from where the fluid begins.
std::vector<Vec<3>> make_walls(const Dam& dam, int layers) {
  std::vector<Vec<3>> walls;
  const int length = static_cast<int>(std::ceil(6 * dam.s)), width = static_cast<int>(std::ceil(1.5 * dam.s)),
            height = static_cast<int>(std::ceil(2.5 * dam.s));
  for (int a = -layers; a < length + layers; ++a)
    for (int b = 0; b < width; ++b)
      for (int c = -layers; c < height; ++c)
        if (c < 0 || a < 0 || a >= length) walls.push_back({{a + 0.5, b + 0.5, c + 0.5}});
  return walls;
}

/// Writes particles into a group: mass, support and constants are the same for all.
void append(Store<3>& store, Group group, const std::vector<Vec<3>>& x, double H) {
  using namespace field;
  const std::size_t at = store.append(group, x.size(), 0);
  for (std::size_t k = 0; k < x.size(); ++k) {
    store.get<field::x>()[at + k] = dp * x[k];
    store.get<rho>()[at + k] = rest_density;
    store.get<h>()[at + k] = H;
    store.get<m>()[at + k] = rest_density * cube(dp);
    store.get<rho_0>()[at + k] = rest_density;
    store.get<mu>()[at + k] = 1e-3;
  }
}

}  // namespace

double support_for(int neighbours) {
  return std::round(100 * std::cbrt(neighbours * 3 / (4 * std::numbers::pi))) / 100;
}

BenchState make_bench_state(const BenchStateOptions& bench) {
  using namespace field;
  const double H = bench.support_over_spacing * dp;
  const double c_0 = materials::TaitSoundSpeed{}.c_0;
  Random random;
  const bool splash = bench.kind == BenchStateKind::splash;
  const Points points = splash ? make_splash(bench.particles, random) : make_block(bench.particles, random);

  BenchState state;
  state.dt = 0.4 * (H / 2) / (1.1 * c_0);
  Store<3>& store = state.store;
  store.allocate(Fields<x, v, rho, h, m, rho_0, rho_wall, mu, x_list>::set());
  append(store, Group::fluid, points.x, H);
  double fastest = 0;
  for (const auto& u : points.v) fastest = std::max(fastest, norm(u));
  // A little more than a fifth of the way in each step, so that rounding does not decide when lists are built.
  const double scale = 1.06 * 0.05 * H / (5 * state.dt) / fastest;
  for (std::size_t i = 0; i < points.v.size(); ++i) {
    store.get<v>()[i] = scale * points.v[i];
    store.get<rho>()[i] = rest_density * (1 + gravity * dp * points.depth[i] / sq(c_0)) + random();
  }
  if (splash)
    append(store, Group::wall,
           make_walls(Dam::of(0.92 * bench.particles), static_cast<int>(std::ceil(bench.support_over_spacing))), H);

  auto& options = state.options;
  options.support = {.uniform = H};
  options.artificial = terms::ViscosityMonaghan{};
  options.diffusion = OneOf<terms::DiffusionForms>{};
  options.xsph = terms::Xsph{};
  options.materials = {materials::Material{}};
  options.gravity = {{0, 0, -gravity}};
  options.wall_density = splash ? walls::WallDensity::extrapolated : walls::WallDensity::none;
  options.backend.precision = bench.precision;
  return state;
}

}  // namespace undine
