#include "undine/app/gauges.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "undine/engine/interpolate.hpp"
#include "undine/io/case/document.hpp"
#include "undine/schemes/weakly_compressible.hpp"
#include "unit/io/io_test.hpp"

namespace undine {
namespace {

using namespace field;
using test::error_of;
using test::read_bytes;
using test::TemporaryFolder;
using test::write_bytes;
using ::testing::HasSubstr;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double gravity = 9.81;

/// Particles at the centres of the cells of a lattice, in the cells low <= k < high of each axis that `wanted` accepts.
template <int N>
std::vector<Vec<N>> lattice(double spacing, Vec<N, int> low, Vec<N, int> high, auto&& wanted) {
  std::vector<Vec<N>> points;
  for (Vec<N, int> cell = low;;) {
    Vec<N> x;
    for (int k = 0; k < N; ++k) x[k] = spacing * (cell[k] + 0.5);
    if (wanted(x)) points.push_back(x);
    int axis = 0;
    for (; axis < N && ++cell[axis] == high[axis]; ++axis) cell[axis] = low[axis];
    if (axis == N) return points;
  }
}

template <int N>
void add(Store<N>& store, Group group, const std::vector<Vec<N>>& points, double spacing, double support) {
  store.allocate(Fields<x, v, m, rho, h, rho_0, mu, p, x_list>::set());
  const std::size_t first = store.append(group, points.size(), 0);
  for (std::size_t k = 0; k < points.size(); ++k) {
    store.template get<x>()[first + k] = points[k];
    store.template get<m>()[first + k] = 1000 * std::pow(spacing, N);
    store.template get<rho>()[first + k] = store.template get<rho_0>()[first + k] = 1000;
    store.template get<h>()[first + k] = support;
  }
}

enum class Tank { without_walls, with_walls };

/// Still water of a depth (m) in a tank [0, 1]^(N-1) that is open above, gravity along -axis N-1, spacing 0.05 m.
template <int N>
struct Still {
  static constexpr double spacing = 0.05, H = 2.6 * spacing;
  GaugeContext<N> context{.spacing = spacing, .interval = 0.1};
  std::unique_ptr<WeaklyCompressible<N>> flow;

  explicit Still(double depth, Tank tank = Tank::with_walls) {
    Vec<N, int> low, high;
    for (int k = 0; k < N; ++k) {
      low[k] = -3;
      high[k] = 23;
      context.domain.low[k] = -3 * spacing;
      context.domain.high[k] = 1 + 3 * spacing;
    }
    context.gravity[N - 1] = -gravity;
    const auto inside = [](const Vec<N>& point) {
      for (int k = 0; k < N; ++k)
        if (point[k] < 0 || (k < N - 1 && point[k] > 1)) return false;
      return true;
    };
    Store<N> store;
    add(store, Group::fluid,
        lattice<N>(spacing, low, high, [&](const auto& point) { return inside(point) && point[N - 1] < depth; }),
        spacing, H);
    if (tank == Tank::with_walls)
      add(store, Group::wall, lattice<N>(spacing, low, high, [&](const auto& point) { return !inside(point); }),
          spacing, H);
    for (std::size_t i = 0; i < store.range(Group::fluid).end;
         ++i)  // p = rho g (depth - z) of the linear equation of state
      store.template get<rho>()[i] = 1000 + 1000 * gravity * (depth - store.template get<x>()[i][N - 1]) / 900;

    WeaklyCompressibleOptions<N> options;
    options.support = {.uniform = H, .kappa = 2};
    options.wall_density = tank == Tank::with_walls ? walls::WallDensity::evolved : walls::WallDensity::none;
    options.materials = {{.eos = materials::Linear{.rho_0 = 1000, .c_0 = 30}}};
    options.gravity = context.gravity;
    options.backend.precision = PairPrecision::double_precision;
    flow = std::make_unique<WeaklyCompressible<N>>(std::move(store), context.domain, options);
  }

  GaugeSet<N> gauges(const std::string& text, const std::filesystem::path& folder = "test") const {
    const Document document = Document::parse(text, folder / "case.toml");
    GaugeSet<N> set(document.root(), context);
    document.finish();
    return set;
  }

  /// The row that one gauge writes.
  std::vector<double> read(const std::string& text) const {
    const TemporaryFolder folder;
    GaugeSet<N> set = gauges("[[gauge]]\nname = \"g\"\n" + text);
    set.create(folder.path());
    set.sample(*flow);
    std::vector<double> row;
    for (const CsvColumn& column : read_csv(folder / "gauges/g.csv").columns) row.push_back(column.values.at(0));
    return {row.begin() + 1, row.end()};
  }
};

TEST(Interpolate, GivesLinearFieldsOnALattice) {
  constexpr double spacing = 0.1, H = 0.26;
  auto domain = Domain<2>::unbounded();
  domain.low[0] = 0;
  domain.high[0] = 2;
  domain.periodic[0] = true;
  Store<2> store;
  add<2>(store, Group::fluid, lattice<2>(spacing, {{0, 0}}, {{20, 20}}, [](const auto&) { return true; }), spacing, H);
  Neighbours<2> neighbours(domain, {});
  neighbours.build(store, H);
  for (std::size_t i = 0; i < store.size(); ++i) {
    const Vec<2> at = store.get<x>()[i];
    store.get<p>()[i] = 5 + 3 * at[1];
    store.get<v>()[i] = {{7, -at[1]}};
  }
  for (const bool per_particle : {false, true}) {
    const InterpolationSource<2> source{
        store, neighbours, domain, KernelChoice::of<WendlandC2>(), {H, 2, per_particle}};
    for (const Vec<2> at : {Vec<2>{{1.0, 1.0}}, {{0.01, 0.93}}, {{1.99, 1.07}}, {{3.2, 0.77}}}) {
      const auto here = interpolate(source, at);
      // A full neighbourhood, also across the periodic seam: the Shepard sum is 1 within 2 %.
      EXPECT_NEAR(here.weight, 1, 0.02);
      EXPECT_DOUBLE_EQ(here.weight, fluid_share(source, at));
      // Shepard sums reproduce constants to rounding.
      EXPECT_NEAR(here.v[0], 7, 1e-13);
      EXPECT_NEAR(here.rho, 1000, 1e-10);
      // A slope is met within 3 % of slope times H.
      EXPECT_NEAR(here.p, 5 + 3 * at[1], 0.03 * 3 * H);
      EXPECT_NEAR(here.v[1], -at[1], 0.03 * H);
    }
    // On a symmetric point (a particle, the middle of four) a linear field is exact to rounding.
    EXPECT_NEAR(interpolate(source, Vec<2>{{1.05, 1.05}}).p, 5 + 3 * 1.05, 1e-13);
    EXPECT_NEAR(interpolate(source, Vec<2>{{1.0, 1.0}}).p, 8, 1e-13);
    // At the flat surface, midway between rows, the fluid fills half of the kernel within 2 %.
    EXPECT_NEAR(interpolate(source, Vec<2>{{1.0, 2.0}}).weight, 0.5, 0.02);
    // Beyond the support of the last row (y = 1.95) there is nothing: exactly zero.
    EXPECT_EQ(interpolate(source, Vec<2>{{1.0, 1.95 + H}}).weight, 0);
  }
}

template <int N>
void expect_heights(double depth, Tank tank, const std::vector<std::string>& columns, double tolerance) {
  const Still<N> still(depth, tank);
  for (const std::string& at : columns)
    for (const std::string mode : {"wetted", "surface"})
      EXPECT_NEAR(still.read("type = \"height\"\nfrom = 0\nat = " + at + "\nmode = \"" + mode + "\"\n")[0], depth,
                  tolerance * Still<N>::spacing)
          << N << "-D at " << at << ", " << mode;
}

TEST(HeightGauge, FindsTheDepthOfStillWater) {
  // The depth within half a spacing, whether the column stands free, touches a wall or runs along it.
  for (const double depth : {0.05, 0.1, 0.35, 0.8})
    expect_heights<2>(depth, Tank::with_walls, {"[0.5, 0]", "[0.52, 9]", "[0.02, 0]", "[0, 0]", "[1, 0]"}, 0.5);
  for (const double depth : {0.1, 0.35})
    expect_heights<3>(depth, Tank::with_walls, {"[0.5, 0.51, 0]", "[0, 0.5, 0]", "[0.03, 0, 0]"}, 0.5);
  // In the edge between two walls and a floor, which leave 1/8 of the kernel free, within 0.75 spacings.
  expect_heights<3>(0.35, Tank::with_walls, {"[0, 1, 0]"}, 0.75);
  // Without wall particles the same, a support radius away from the sides.
  for (const double depth : {0.05, 0.35}) expect_heights<2>(depth, Tank::without_walls, {"[0.5, 0]", "[0.3, 0]"}, 0.5);
}

TEST(HeightGauge, TakesItsColumnFromTheDomainAndTheDirectionFromGravity) {
  const Still<2> still(0.35);
  // From below the floor: wetted water is still the depth within 0.6 spacings; the surface counts from the domain's
  // bottom.
  EXPECT_NEAR(still.read("type = \"height\"\nat = [0.5, 0]\n")[0], 0.35, 0.6 * 0.05);
  EXPECT_NEAR(still.read("type = \"height\"\nat = [0.5, 0]\nmode = \"surface\"\n")[0], 0.35 + 0.15, 0.5 * 0.05);
  // Along x the water fills the tank's width of 1 m, within half a spacing at each end; above the water there is none.
  EXPECT_NEAR(still.read("type = \"height\"\naxis = \"x\"\nfrom = 0\nto = 1\nat = [0, 0.2]\n")[0], 1, 0.05);
  EXPECT_EQ(still.read("type = \"height\"\naxis = \"x\"\nfrom = 0\nto = 1\nat = [0, 0.6]\n")[0], 0);
  // Upside down: from 1 m down to the surface and on to the floor, the wetted length is the depth, its end 1 m away.
  EXPECT_NEAR(still.read("type = \"height\"\nfrom = 1\nto = 0\nat = [0.5, 0]\n")[0], 0.35, 0.5 * 0.05);
  EXPECT_NEAR(still.read("type = \"height\"\nfrom = 1\nto = 0\nat = [0.5, 0]\nmode = \"surface\"\n")[0], 1, 1e-12);
}

TEST(ProbeGauge, ReadsTheFluidAndNothingInTheAir) {
  const Still<2> still(0.8);
  const std::string fields = "fields = [\"velocity\", \"density\", \"pressure\"]\n";
  const auto row = still.read("type = \"probe\"\nat = [0.5, 0.4]\n" + fields);
  ASSERT_EQ(row.size(), 4u);
  // Still water at half its depth: pressure rho g z within 2 %, density from the same, no velocity.
  EXPECT_EQ(row[0], 0);
  EXPECT_EQ(row[1], 0);
  EXPECT_NEAR(row[2], 1000 + row[3] / 900, 1e-9);
  EXPECT_NEAR(row[3], 1000 * gravity * 0.4, 0.02 * 1000 * gravity * 0.4);
  // Bare sums at the side wall see half of the kernel (within 5 %), Shepard sums do not.
  const double wall = still.read("type = \"probe\"\nat = [0, 0.4]\n")[0];
  EXPECT_NEAR(wall, row[3], 0.02 * row[3]);
  EXPECT_NEAR(still.read("type = \"probe\"\nat = [0, 0.4]\nshepard = false\n")[0], wall / 2, 0.05 * wall);
  // Dry: exactly zero, and so is a probe at the surface (weight 1/2) if it asks for more.
  EXPECT_EQ(still.read("type = \"probe\"\nat = [0.5, 0.9]\n")[0], 0);
  EXPECT_NE(still.read("type = \"probe\"\nat = [0.5, 0.8]\n")[0], 0);
  EXPECT_EQ(still.read("type = \"probe\"\nat = [0.5, 0.8]\nwet = 0.7\n")[0], 0);
}

TEST(FrontGauge, GivesTheForemostParticle) {
  Still<2> still(0.1);
  // The rows of particles are at 0.025 and 0.975 m, two particles high: exact coordinates.
  EXPECT_NEAR(still.read("type = \"front\"\n")[0], 0.975, 1e-15);
  EXPECT_NEAR(still.read("type = \"front\"\nsign = \"-\"\nignore = 1\n")[0], 0.025, 1e-15);
  EXPECT_NEAR(still.read("type = \"front\"\nignore = 2\n")[0], 0.925, 1e-15);
  EXPECT_NEAR(still.read("type = \"front\"\naxis = \"y\"\n")[0], 0.075, 1e-15);
  EXPECT_TRUE(std::isnan(still.read("type = \"front\"\nignore = 1000\n")[0]));
}

TEST(ExtremesGauge, FindsEachOne) {
  Still<1> still(0.5);
  still.flow->store().get<v>()[3] = {{-4}};
  const auto row = still.read("type = \"extremes\"\n");
  ASSERT_EQ(row.size(), 5u);
  // Ten particles at depths 0.025 ... 0.475: exact to rounding.
  EXPECT_EQ(row[0], 4);
  EXPECT_NEAR(row[1], 1000 + 1000 * gravity * 0.025 / 900, 1e-9);
  EXPECT_NEAR(row[2], 1000 + 1000 * gravity * 0.475 / 900, 1e-9);
  EXPECT_NEAR(row[3], 1000 * gravity * 0.025, 1e-6);
  EXPECT_NEAR(row[4], 1000 * gravity * 0.475, 1e-6);
}

TEST(WallForceGauge, IsTheReactionToTheForceOnTheFluid) {
  Still<2> still(0.35);
  const Store<2>& store = still.flow->store();
  Vec<2> fluid{}, left{};
  for (std::size_t i = 0; i < store.range(Group::fluid).end; ++i)
    fluid += store.get<m>()[i] * (store.get<acc>()[i] - still.context.gravity);
  const auto total = still.read("type = \"wall_force\"\n");
  ASSERT_EQ(total.size(), 3u);
  // Newton's third law, to the rounding of sums of about 3000 N/m.
  EXPECT_NEAR(total[0], -fluid[0], 1e-6);
  EXPECT_NEAR(total[1], -fluid[1], 1e-6);
  EXPECT_LT(total[1], 0);
  // Symmetric about x = 0.5: no moment there (to rounding), and about the origin that of the force at x = 0.5.
  EXPECT_NEAR(still.read("type = \"wall_force\"\nabout = [0.5, 0]\n")[2], 0, 1e-6);
  EXPECT_NEAR(total[2], 0.5 * total[1], 1e-6);

  // A wall of its own takes its part alone: that of its particles, in the same sum.
  still.context.bodies = {{"left", 1}};
  still.context.body_of_id.assign(store.size(), 0);
  for (std::size_t i = store.range(Group::wall).begin; i < store.size(); ++i) {
    if (store.get<x>()[i][0] > 0) continue;
    still.context.body_of_id[static_cast<std::size_t>(store.ids()[i])] = 1;
    left += store.get<m>()[i] * store.get<acc>()[i];
  }
  const auto part = still.read("type = \"wall_force\"\nwall = \"left\"\n");
  EXPECT_NEAR(part[0], left[0], 1e-9);
  EXPECT_LT(part[0], 0);
  EXPECT_THAT(error_of([&] { still.read("type = \"wall_force\"\nwall = \"lift\"\n"); }), HasSubstr("left"));
  EXPECT_THAT(error_of([&] { Still<2>(0.35, Tank::without_walls).read("type = \"wall_force\"\n"); }),
              HasSubstr("case.toml:1"));
  // Columns by dimension: 1-D fx; 3-D three forces and three moments.
  EXPECT_EQ(Still<1>(0.5).read("type = \"wall_force\"\n").size(), 1u);
  EXPECT_EQ(Still<3>(0.1).read("type = \"wall_force\"\n").size(), 6u);
}

TEST(Comparison, MatchesNumbersByHand) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Samples ours{{0, 1, 2, 3}, {0, 2, 6, nan}};
  const Samples reference{{-1, 0.5, 1.5, 2, 2.5}, {9, 2, 3, 6, 9}};
  // Ours covers 0 ... 2: at 0.5, 1.5, 2 it is 1, 4, 6; differences -1, 1, 0; rms = sqrt(2/3); range 6 - 2 = 4.
  const Comparison all = compare(ours, reference, infinity);
  EXPECT_EQ(all.points, 3u);
  EXPECT_DOUBLE_EQ(all.rms, std::sqrt(2.0 / 3));
  EXPECT_DOUBLE_EQ(all.range, 4);
  EXPECT_DOUBLE_EQ(all.relative, std::sqrt(2.0 / 3) / 4);
  EXPECT_EQ(all.peak, 6);
  EXPECT_EQ(all.peak_time, 2);
  EXPECT_EQ(all.reference_peak, 6);
  EXPECT_EQ(all.reference_peak_time, 2);
  // Until 1.7: differences -1, 1; rms 1; range 1; our samples within 0.5 ... 1.5: the one at 1.
  const Comparison part = compare(ours, reference, 1.7);
  EXPECT_EQ(part.points, 2u);
  EXPECT_DOUBLE_EQ(part.rms, 1);
  EXPECT_DOUBLE_EQ(part.relative, 1);
  EXPECT_EQ(part.peak, 2);
  EXPECT_EQ(part.peak_time, 1);
  // Nothing in common: no points, not a number.
  EXPECT_EQ(compare(ours, {{7}, {1}}, infinity).points, 0u);
  EXPECT_TRUE(std::isnan(compare({}, reference, infinity).rms));
}

TEST(Comparison, LinesUpAsText) {
  Comparison one{
      .gauge = "P1", .column = "p", .unit = "Pa", .rms = 100, .range = 400, .relative = 0.25, .peak = 5, .points = 3};
  Comparison two = one;
  two.gauge = "a_long_name";
  two.rms = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Comparison> both{one, two};
  const std::string text = comparison_table(both);
  // Names start and numbers end at the same place in each line, in widths counted by hand.
  EXPECT_THAT(text, HasSubstr("P1           p            3  100 Pa  400 Pa     25.0 %"));
  EXPECT_THAT(text, HasSubstr("a_long_name  p            3       -  400 Pa     25.0 %"));
  EXPECT_EQ(comparison_table({}), "");
}

TEST(GaugeSet, WritesWhatIsDueAndResumesWithTheSameBytes) {
  const std::string text =
      "[[gauge]]\nname = \"a\"\ntype = \"front\"\nevery = \"0.3 s\"\n[[gauge]]\nname = \"b\"\ntype = \"extremes\"\n";
  const TemporaryFolder whole, broken;
  constexpr double step = 0.07;
  const auto advance = [](Still<1>& still, GaugeSet<1>& set, int steps) {
    for (int k = 0; k < steps; ++k) {
      still.flow->drift(step);  // v = 0: only time goes on
      set.sample(*still.flow);
    }
  };
  Still<1> still(0.5);
  auto set = still.gauges(text);
  EXPECT_THROW(set.sample(*still.flow), Error);
  set.create(whole.path());
  set.sample(*still.flow);
  set.sample(*still.flow);  // again at the same time: nothing is due
  advance(still, set, 20);
  // Steps of 0.07 s: the first at or after 0, 0.3, 0.6, 0.9, 1.2 s, written with the time that they have.
  const auto times = read_csv(whole / "gauges/a.csv").columns[0].values;
  ASSERT_EQ(times.size(), 5u);
  for (const auto& [k, expected] : {std::pair{0, 0.0}, {1, 0.35}, {2, 0.63}, {3, 0.91}, {4, 1.26}})
    EXPECT_NEAR(times[static_cast<std::size_t>(k)], expected, 1e-12);

  // Broken off after 14 steps, resumed from step 9, whether or not the time of resumption is sampled again: the same
  // bytes.
  for (const bool again : {false, true}) {
    Still<1> first(0.5), second(0.5);
    auto set_1 = first.gauges(text), set_2 = second.gauges(text);
    set_1.create(broken.path());
    set_1.sample(*first.flow);
    advance(first, set_1, 14);
    for (int k = 0; k < 9; ++k) second.flow->drift(step);
    set_2.resume(broken.path(), second.flow->time());
    if (again) set_2.sample(*second.flow);
    advance(second, set_2, 11);
    for (const char* file : {"gauges/a.csv", "gauges/b.csv"})
      EXPECT_EQ(read_bytes(broken / file), read_bytes(whole / file));
  }
}

TEST(GaugeSet, ComparesWithReferenceData) {
  const TemporaryFolder folder;
  write_bytes(folder / "data.csv", "t [ms],x\n0,0\n500,1.95\n1000,9\n");
  const std::string text =
      "[[gauge]]\nname = \"tip\"\ntype = \"front\"\nreference = { file = \"data.csv\", time = \"t\", value = \"x\", "
      "time_scale = 1e-3, scale = 0.5, shift = 0.1, until = \"0.6 s\" }\n";
  Still<1> still(0.5);
  auto set = still.gauges(text, folder.path());
  set.create(folder.path());
  for (int k = 0; k < 8; ++k) {
    set.sample(*still.flow);
    still.flow->drift(0.1);
  }
  const auto found = set.compare();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].gauge, "tip");
  EXPECT_EQ(found[0].column, "front");
  EXPECT_EQ(found[0].unit, "m");
  EXPECT_EQ(found[0].points, 2u);
  // Ours is 0.475 throughout; the reference 0.1 and 1.075: differences 0.375 and -0.6.
  EXPECT_NEAR(found[0].rms, std::sqrt((0.375 * 0.375 + 0.6 * 0.6) / 2), 1e-12);
  EXPECT_NEAR(found[0].range, 0.975, 1e-12);
  EXPECT_NEAR(found[0].reference_peak_time, 0.5, 1e-12);
}

TEST(GaugeSet, SaysWhatIsWrongAndWhere) {
  const TemporaryFolder folder;
  write_bytes(folder / "data.csv", "t,P1 [kPa]\n0,0\n");
  const Still<1> still(0.5);
  const auto complaint = [&](const std::string& text) {
    return error_of([&] { still.gauges("[[gauge]]\nname = \"a\"\n" + text, folder.path()); });
  };
  EXPECT_THAT(complaint("type = \"prob\"\n"), HasSubstr("probe"));
  EXPECT_THAT(complaint("type = \"prob\"\n"), HasSubstr("case.toml:3:8"));
  EXPECT_THAT(complaint("type = \"front\"\naxes = \"x\"\n"), HasSubstr("axis"));
  EXPECT_THAT(complaint("type = \"probe\"\nat = [1, 2]\n"), HasSubstr("needs 1 values"));
  EXPECT_THAT(complaint("type = \"probe\"\nat = [1]\nreference = { file = \"no.csv\" }\n"),
              HasSubstr("case.toml:5:22"));
  EXPECT_THAT(complaint("type = \"probe\"\nat = [1]\nreference = { file = \"data.csv\", value = \"P2\" }\n"),
              HasSubstr("P1"));
  EXPECT_THAT(complaint("type = \"probe\"\nat = [1]\nreference = { file = \"data.csv\" }\n"),
              HasSubstr("is in kPa, not in Pa"));
  EXPECT_THAT(complaint("type = \"front\"\n[[gauge]]\nname = \"a\"\ntype = \"front\"\n"), HasSubstr("two gauges"));
  EXPECT_THAT(complaint("type = \"front\"\n[[gauge]]\nname = \"../a\"\ntype = \"front\"\n"), HasSubstr("cannot name"));
  EXPECT_THAT(complaint("type = \"height\"\nat = [0]\nfrom = 0\nto = 0\n"), HasSubstr("case.toml:6"));
  EXPECT_EQ(gauge_infos().size(), 14u);
}

}  // namespace
}  // namespace undine
