#include "undine/app/case_setup.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "undine/app/case_ghosts.hpp"
#include "undine/app/case_particles.hpp"
#include "undine/app/case_shapes.hpp"
#include "undine/app/case_wall_particles.hpp"
#include "undine/app/case_walls.hpp"
#include "undine/core/error.hpp"
#include "undine/geometry/embed.hpp"
#include "undine/geometry/fill.hpp"
#include "undine/geometry/points.hpp"
#include "undine/search/cell_grid.hpp"

namespace undine {
namespace {

/// Particles of one body before they enter the store.
struct Body {
  std::string name;
  Group group;
  int material = 0;
  std::vector<Vec3> points;
  std::map<std::string, std::vector<double>> given;  ///< columns of a particle list: vx, vy, vz, rho, m
  Table table;
  bool of_a_run = false;     ///< particles that a run left, which may be closer than any lattice lays them
  bool may_coincide = true;  ///< points that a lattice laid are apart from each other
  int motion = -1;           ///< of a wall: its number in WallPlan::motions
  std::shared_ptr<ReflectingSurface> surface = {};  ///< of a wall with a shape: that alone
  double coarser = 1;                               ///< spacing of a fluid's lattice over the case's
};

constexpr std::int64_t most_layers = 100;  ///< of a wall
constexpr int no_body = -1;                ///< number of a wall that has no particles of its own, but ghosts

template <int N>
class Reader {
 public:
  explicit Reader(const Table& root) : root_(root) {}

  CaseSetup<N> read() {
    setup_.title = root_.text("title", "");
    setup_.spacing = root_.positive("spacing", unit::length);
    setup_.choice = read_scheme<N>(root_, setup_.spacing, setup_.scheme);
    const auto fluids = root_.tables("fluid");
    if (fluids.empty())
      throw InputError({.what = "the case has no fluid",
                        .where = root_.where(),
                        .why = "nothing would move",
                        .fix = "add a [[fluid]] with a shape"});
    for (const Table& t : fluids) read_fluid_points(t);
    fluids_ = bodies_.size();
    for (const Table& t : root_.tables("wall")) read_wall(t);
    check_names();
    place_domain();
    check_overlaps();
    read_materials(fluids);
    fill_store();
    read_body_force();
    start_walls();
    plan_walls();
    connect_distance();
    connect_reflector();
    connect_domain();
    connect_ghosts();
    setup_.walls = walls_;
    return std::move(setup_);
  }

 private:
  /// Marks keys that this choice does not use, so that Undine does not call them unknown.
  static void unused(const Table& table, std::initializer_list<const char*> keys) {
    for (const char* key : keys) (void)table.has(key);
  }

  void take_list(Body& body) {
    auto list = read_particle_list(body.table, N, body.group);
    body.of_a_run = list.of_a_run;
    body.points = std::move(list.points);
    body.given = std::move(list.given);
  }

  /// Refuses a shape whose filling would not end. `layers` of a wall lie on one side of its surface; 0: the shape is
  /// filled.
  void check_size(const Table& table, const Shape& shape, int layers = 0, Side side = Side::outside) const {
    const Bounds box = shape.bounds();
    for (int k = 0; k < N; ++k)
      if (!std::isfinite(box.lo[k]) || !std::isfinite(box.hi[k])) return;  // filling says so
    const double depth = layers * setup_.spacing;
    const auto points = [&](double margin) { return lattice_points(box, setup_.spacing, margin, N); };
    const double tried = points(side == Side::outside ? depth : 0);
    const double spared = layers == 0 ? 0 : points(side == Side::outside ? 0 : -depth);
    // Other shapes may take up little of their bounds; what they do take is checked once it is known.
    check_room(table, shape.as_box() ? tried - spared : 0.1 * tried, setup_.spacing);
  }

  void read_fluid_points(const Table& table) {
    Body body{table.text("name", fmt::format("fluid{}", bodies_.size())),
              Group::fluid,
              static_cast<int>(bodies_.size()),
              {},
              {},
              table};
    if (table.has("particles")) {
      take_list(body);
      unused(table, {"shape", "lattice", "anchor", "jitter", "seed", "spacing"});
    } else {
      const Lattice lattice =
          table.choice("lattice", {"cubic", "hexagonal"}, "cubic") == "cubic" ? Lattice::cubic : Lattice::hexagonal;
      const double spacing = table.positive("spacing", unit::length, setup_.spacing);
      if (spacing < setup_.spacing * (1 - 1e-9))
        table.fail("spacing",
                   fmt::format("a spacing of {:.4g} m is finer than the case's {:.4g} m", spacing, setup_.spacing),
                   "particles are checked, and walls laid, with the case's",
                   "let 'spacing' at the top be that of the finest fluid");
      body.coarser = spacing / setup_.spacing;
      LatticeSpec spec{spacing, N, lattice, {}};
      if (table.has("anchor")) spec.anchor = read_point(table, "anchor", N);
      const ShapePtr shape = read_shape(table.table("shape"), N);
      check_size(table, *shape);
      body.points = with_place(table, [&] { return fill_lattice(*shape, spec); });
      body.may_coincide = false;
      const double jitter = table.in_range("jitter", unit::one, {0, 0.5}, 0.0) * spacing;
      if (jitter > 0) {
        shake(body.points, jitter, static_cast<std::uint64_t>(table.integer("seed", 1)));
        body.may_coincide = true;
      }
      unused(table, {"seed"});
    }
    if (body.points.empty())
      throw InputError(
          {.what = fmt::format("fluid '{}' has no particles", body.name),
           .where = table.where(),
           .why = fmt::format("no lattice point of spacing {:.4g} m lies in its shape", setup_.spacing * body.coarser),
           .fix = "make the shape larger or the spacing smaller"});
    check_room(table, static_cast<double>(body.points.size()), setup_.spacing);
    bodies_.push_back(std::move(body));
  }

  /// Displaces points by up to `amount` in each coordinate, the same for the same seed on every machine.
  static void shake(std::vector<Vec3>& points, double amount, std::uint64_t seed) {
    std::uint64_t state = seed * 0x9e3779b97f4a7c15ULL + 1;
    for (auto& p : points)
      for (int k = 0; k < N; ++k) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        p[k] += amount * (static_cast<double>(state >> 11) * 0x1p-52 - 1.0);
      }
  }

  /// Geometry errors get the table's place.
  template <class F>
  static auto with_place(const Table& table, F&& f) {
    try {
      return f();
    } catch (const InputError& error) {
      if (error.parts().where.line > 0) throw;
      auto parts = error.parts();
      parts.where = table.where();
      throw InputError(std::move(parts));
    }
  }

  int layers_needed() const {
    return static_cast<int>(std::ceil(setup_.options().support.uniform / setup_.spacing - 1e-9));
  }

  void read_wall(const Table& table) {
    Body body{table.text("name", fmt::format("wall{}", fluids_ + walls_read_++)), Group::wall, 0, {}, {}, table};
    const Table shape_table = table.table("shape");
    const Side fluid_side =
        table.choice("fluid", {"inside", "outside"}, "inside") == "inside" ? Side::inside : Side::outside;
    const std::vector<std::string> faces{"x-", "x+", "y-", "y+", "z-", "z+"};
    const FaceSet open = parse_faces(table.choices("open", {faces.begin(), faces.begin() + 2 * N}, {}));
    const bool has_list = table.has("particles");
    const bool reflects = setup_.choice.reflects && table.flag("reflects", true);
    const bool pushes = setup_.choice.wall_force == walls::WallForce::distance;
    ShapePtr shape;
    if (!has_list || shape_table.exists()) shape = read_shape(shape_table, N);
    if (!shape && (pushes || setup_.options().wall_density == walls::WallDensity::mirrored))
      table.fail("particles", "this wall has no shape", "its treatment needs to know where the surface is",
                 "add the shape on whose surface the particles lie, or choose another treatment");
    std::vector<PlacedSurface> placed;
    const auto add_to = [&](const std::shared_ptr<ReflectingSurface>& surface) {
      placed.push_back({surface, add_surface(*surface, shape, fluid_side, open)});
    };
    if (shape && reflects) add_to(surface_);
    if (shape && pushes) add_to(pushing_);
    const bool may_move = !placed.empty() || setup_.choice.wall_particles;
    if (shape) add_to(walls_);
    if (setup_.choice.ghosts) {
      for (const char* key : {"displacement", "slide"})
        if (table.has(key))
          table.fail(key, "walls with ghosts do not move", "their mirrors stand still",
                     "choose another treatment, such as 'adami' or 'mdbc'");
    } else if (may_move) {
      body.motion = read_motion(table, placed);
    }
    if (shape) {
      body.surface = std::make_shared<ReflectingSurface>();
      add_surface(*body.surface, shape, fluid_side, open);
    }
    if (setup_.choice.ghosts) {
      if (!shape) shape = read_shape(shape_table, N);  // says that it is missing
      if (!reflects)
        table.fail("reflects", "walls with ghosts reflect", "a particle behind one would have its ghost in the fluid",
                   "leave 'reflects' out");
      ghosts_.add(table, body.name, *shape, fluid_side, open);
      if (!setup_.bodies.emplace(body.name, no_body).second)
        table.fail("name", fmt::format("two bodies are named '{}'", body.name), {}, "give each its own name");
    }
    if (shape && fluid_side == Side::inside) setup_.container.include(shape->bounds());
    unused(table, {"reflects", "sheet", "layers", "thin"});
    if (has_list) {
      take_list(body);
    } else if (setup_.choice.wall_particles) {
      body.points = wall_points(table, *shape, fluid_side, open);
    }
    if (setup_.choice.wall_particles) bodies_.push_back(std::move(body));
  }

  std::size_t add_surface(ReflectingSurface& surface, const ShapePtr& shape, Side fluid, const FaceSet& open) const {
    const auto box = shape->as_box();
    if (box && fluid == Side::inside) return surface.add_tank(*box, N, open, setup_.choice.restitution);
    return surface.add(shape, fluid, setup_.choice.restitution);
  }

  /// The number of the wall's motion in the options; -1 where it stands still.
  int read_motion(const Table& table, const std::vector<PlacedSurface>& placed) {
    auto motion = read_wall_motion<N>(table, setup_.choice, placed, fastest_wall_);
    if (!motion) return -1;
    setup_.options().walls.motions.push_back(std::move(*motion));
    return static_cast<int>(setup_.options().walls.motions.size()) - 1;
  }

  std::vector<Vec3> wall_points(const Table& table, const Shape& shape, Side fluid_side, const FaceSet& open) {
    const auto& choice = setup_.choice;
    const bool repels = choice.wall_force == walls::WallForce::repulsion;
    const bool sheet = table.flag("sheet", choice.wall_layers == 1 && !repels);
    if (sheet) {
      const auto box = shape.as_box();
      if (!box)
        table.fail("sheet", "a sheet of wall particles needs a box", "points are laid on the box's faces",
                   "set sheet = false or use a box");
      return fill_face_sheet(*box, {setup_.spacing, N, open});
    }
    const int needed = layers_needed();
    const std::int64_t asked = table.integer("layers", choice.wall_layers > 0 ? choice.wall_layers : needed);
    if (asked > most_layers)
      table.fail("layers", fmt::format("a wall of {} layers is thicker than any support", asked),
                 fmt::format("{} layers span it", needed), fmt::format("set layers = {}, or leave it out", needed));
    const int layers = static_cast<int>(std::max<std::int64_t>(asked, 0));
    if (layers < 1 || (layers < needed && !table.flag("thin", choice.wall_layers > 0)))
      table.fail(
          "layers", fmt::format("a wall of {} layer{} is thinner than the support", layers, layers == 1 ? "" : "s"),
          fmt::format(
              "the support radius {:.4g} m spans {} spacings of {:.4g} m; fluid would feel what is behind the wall",
              setup_.options().support.uniform, needed, setup_.spacing),
          fmt::format("set layers = {}, leave it out, or say thin = true if this is meant", needed));
    const Side wall_side = fluid_side == Side::inside ? Side::outside : Side::inside;
    check_size(table, shape, layers, wall_side);
    const double spacing = repels ? repelling_spacing() : setup_.spacing;
    const double offset = repels && !shifted() ? 0 : 0.5;
    return with_place(table, [&] { return fill_shell(shape, {spacing, layers, wall_side, N, offset, open}); });
  }

  /// Whether repulsive particles lie half of their spacing behind the surface: Niedoba (2012), 3.3.
  bool shifted() const { return root_.table("scheme").table("wall").flag("shift", true); }

  double repelling_spacing() const {
    return undine::repelling_spacing(root_.table("scheme").table("wall"), setup_.spacing);
  }

  /// Monaghan (1994) takes D = 5 g H, H the depth of the fluid; the expected speed is sqrt(2 g H).
  void read_repulsion() {
    const Table table = root_.table("scheme").table("wall");
    terms::Repulsion repulsion;
    repulsion.D = 2.5 * sq(setup_.expected_speed);
    // Fluid on the lattice begins half a spacing from the surface, where it is to feel nothing.
    repulsion.r_0 = 0.5 * (setup_.spacing + (shifted() ? repelling_spacing() : 0));
    read_parameters(table, repulsion);
    const double H = setup_.options().support.uniform;
    if (!(repulsion.r_0 > 0 && repulsion.r_0 <= H))
      table.fail("r_0", fmt::format("walls cannot repel from {:.4g} m", repulsion.r_0),
                 fmt::format("neighbours are known up to the support radius H = {:.4g} m only", H),
                 fmt::format("take about one spacing, {:.4g} m", setup_.spacing));
    for (const double p : {repulsion.p1, repulsion.p2})
      if (std::abs(2 * p - std::round(2 * p)) > 1e-9)
        table.fail(p == repulsion.p1 ? "p1" : "p2", fmt::format("the exponent {} is no multiple of 1/2", p), {},
                   "take 12 and 6, 4 and 2, or 9.5 and 4");
    if (!(repulsion.p1 > repulsion.p2))
      table.fail("p1", fmt::format("p1 = {} is not larger than p2 = {}", repulsion.p1, repulsion.p2),
                 "walls would attract", "take 12 and 6, 4 and 2, or 9.5 and 4");
    setup_.options().repulsion = repulsion;
  }

  /// What keeps pairs apart, if the pressure form has it: it is to stop two particles that meet at the expected speed.
  void read_separation() {
    auto* liquid = std::get_if<WeaklyCompressibleOptions<N>>(&setup_.scheme);
    if (!liquid) return;
    liquid->pressure.with_chosen([&](auto& form) {
      if constexpr (requires { form.separation; }) {
        const Table table = root_.table("scheme").table("pressure");
        form.separation = setup_.choice.separation * sq(setup_.expected_speed);
        form.reach = setup_.choice.reach * setup_.spacing;
        read_parameters(table, form);
        if (!(form.reach > 0 && form.reach <= liquid->support.uniform))
          table.fail("reach", fmt::format("pairs cannot be kept {:.4g} m apart", form.reach),
                     "it is a distance above zero, and neighbours are known up to the support radius only",
                     fmt::format("take about half a spacing, {:.4g} m", 0.5 * setup_.spacing));
      }
    });
  }

  void check_names() {
    std::set<std::string> names;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (bodies_[b].group == Group::wall) setup_.bodies.emplace(bodies_[b].name, static_cast<int>(b));
      if (!names.insert(bodies_[b].name).second)
        bodies_[b].table.fail("name", fmt::format("two bodies are named '{}'", bodies_[b].name), {},
                              "give each its own name");
    }
  }

  /// Every particle once within each period, and none on another.
  void check_overlaps() const {
    const bool periodic = setup_.domain.any_periodic();
    std::vector<std::vector<Vec3>> wrapped;
    for (const Body& body : bodies_) {
      check_period(body);
      if (!periodic) continue;
      wrapped.push_back(body.points);
      for (Vec3& p : wrapped.back()) p = widen<N>(setup_.domain.wrapped(narrow<N>(p)));
    }
    const auto points = [&](std::size_t b) -> const std::vector<Vec3>& {
      return periodic ? wrapped[b] : bodies_[b].points;
    };
    const auto closest = [&](const Body& a, const Body& b) {
      return (a.of_a_run || b.of_a_run ? 1e-6 : 0.5 * (1 - 1e-6)) * setup_.spacing;  // half a spacing is fine
    };
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (bodies_[b].may_coincide)
        complain_of(check_overlap(points(b), closest(bodies_[b], bodies_[b])), bodies_[b], bodies_[b]);
      for (std::size_t a = 0; a < b; ++a)
        if (bodies_[a].group == Group::fluid)
          complain_of(check_overlap(points(a), points(b), closest(bodies_[a], bodies_[b])), bodies_[a], bodies_[b]);
    }
  }

  void check_period(const Body& body) const {
    const auto& domain = setup_.domain;
    Bounds box;
    for (const Vec3& p : body.points) box.include(p);
    for (int k = 0; k < N; ++k)
      if (domain.periodic[k] && box.hi[k] - box.lo[k] > domain.length(k))
        throw InputError(
            {.what = fmt::format("'{}' is longer than the period along {}", body.name, "xyz"[k]),
             .where = body.table.where(),
             .why = fmt::format(
                 "its particles reach from {:.4g} to {:.4g} m, the period is {:.4g} m: it would lie on its own image",
                 box.lo[k], box.hi[k], domain.length(k)),
             .fix = "shorten it to the period, name its two ends there in 'open', or widen [domain]"});
  }

  void complain_of(const std::optional<Overlap>& overlap, const Body& a, const Body& b) const {
    if (!overlap) return;
    const Vec3 p = a.points[overlap->a];
    if (&a == &b)
      throw InputError({.what = fmt::format("two particles of '{}' nearly coincide", a.name),
                        .where = a.table.where(),
                        .why = fmt::format("they are {:.3g} m apart near ({:.4g}, {:.4g}, {:.4g}) m, spacing {:.4g} m",
                                           overlap->distance, p[0], p[1], p[2], setup_.spacing),
                        .fix = "remove one of them from the list, or lessen 'jitter'"});
    throw InputError({.what = fmt::format("'{}' and '{}' overlap", a.name, b.name),
                      .where = b.table.where(),
                      .why = fmt::format("particles {:.3g} m apart near ({:.4g}, {:.4g}, {:.4g}) m, spacing {:.4g} m",
                                         overlap->distance, p[0], p[1], p[2], setup_.spacing),
                      .fix = "move one of them, cut it out with a 'difference', or align their edges to the spacing"});
  }

  /// The domain: as given, or room around all particles; far enough up for splashes.
  void place_domain() {
    Bounds all;
    for (const auto& body : bodies_)
      for (const auto& p : body.points) all.include(p);
    if (!setup_.container.empty()) all.include(setup_.container);
    const Table table = root_.table("domain");
    double extent = setup_.options().support.uniform;  // some room even around a single point
    for (int k = 0; k < N; ++k)
      if (std::isfinite(all.hi[k] - all.lo[k])) extent = std::max(extent, all.hi[k] - all.lo[k]);
    std::vector<double> low, high;
    for (int k = 0; k < N; ++k) {
      low.push_back(std::max(all.lo[k], -1e30) - extent);
      high.push_back(std::min(all.hi[k], 1e30) + 2 * extent);
    }
    const std::vector<std::string> axes{"x", "y", "z"};
    const auto periodic = table.choices("periodic", {axes.begin(), axes.begin() + N}, {});
    if (!periodic.empty()) {
      low = table.quantities("low", unit::length, N);
      high = table.quantities("high", unit::length, N);
    } else {
      low = table.quantities("low", unit::length, N, low);
      high = table.quantities("high", unit::length, N, high);
    }
    auto& domain = setup_.domain;
    for (int k = 0; k < N; ++k) {
      domain.low[k] = low[k];
      domain.high[k] = high[k];
      domain.periodic[k] = std::ranges::count(periodic, axes[k]) > 0;
      if (!(high[k] > low[k]))
        table.fail("high", fmt::format("the domain is empty along {}", axes[k]), {}, "make high larger than low");
      if (domain.periodic[k] && setup_.options().gravity[k] != 0)
        root_.fail("gravity",
                   fmt::format("gravity acts along {}, where space repeats", axes[static_cast<std::size_t>(k)]),
                   "a height has no end there, so that the energy audit could not close", "use body_force instead");
      const double reach = setup_.options().support.uniform * (1 + setup_.options().neighbours.skin);
      if (domain.periodic[k] && domain.length(k) < 2 * reach)
        table.fail(
            "high", fmt::format("the period along {} is {:.4g} m", axes[k], domain.length(k)),
            fmt::format("a particle would see its own image: twice the support with skin is {:.4g} m", 2 * reach),
            "widen the domain or lessen the support");
    }
    const std::string on_escape = table.choice("on_escape", {"stop", "remove", "reflect"}, "stop");
    setup_.options().lets_escape = on_escape == "remove";
    domain_reflects_ = on_escape == "reflect";
    for (const auto& body : bodies_)
      for (const auto& p : body.points)
        if (!domain.contains(narrow<N>(p)))
          throw InputError({.what = fmt::format("'{}' begins outside the domain", body.name),
                            .where = table.exists() ? table.where() : body.table.where(),
                            .why = fmt::format("a particle at ({:.4g}, {:.4g}, {:.4g}) m", p[0], p[1], p[2]),
                            .fix = "widen [domain] or move the body"});
  }

  /// The speed that gravity can give over the fluid's height, or the initial speed; sets the default speed of sound.
  void read_materials(const std::vector<Table>& fluids) {
    const auto& g = setup_.options().gravity;
    double lowest = 1e300, highest = -1e300, speed = 0;
    for (const auto& body : bodies_)
      for (std::size_t i = 0; i < body.points.size(); ++i) {
        const double level = -dot(g, narrow<N>(body.points[i]));
        lowest = std::min(lowest, level);
        if (body.group == Group::fluid) {
          highest = std::max(highest, level);
          speed = std::max(speed, norm(velocity(body, i)));
        }
      }
    if (highest > lowest) speed = std::max(speed, std::sqrt(2 * (highest - lowest)));
    if (!root_.has("expected_speed") && fastest_wall_ > 1.0001 * speed)
      throw InputError({.what = "walls move faster than the fluid would by itself",
                        .where = root_.where("wall"),
                        .why = fmt::format("they reach {:.4g} m/s until time.end; gravity and the initial velocities "
                                           "give {:.4g} m/s, from which the speed of sound would follow",
                                           fastest_wall_, speed),
                        .fix = fmt::format("set expected_speed, such as {:.4g} (m/s)", fastest_wall_)});
    setup_.expected_speed = root_.positive("expected_speed", unit::velocity, std::max(speed, 1e-6));
    read_separation();
    if (setup_.choice.wall_force == walls::WallForce::repulsion) read_repulsion();
    for (const Table& table : fluids)
      setup_.options().materials.push_back(read_material(table, setup_.choice, setup_.expected_speed, setup_.warnings));
    refuse_diffusion_of_fluids();
    // E_pot counts from the lowest place that fluid or wall reaches.
    const double g_sq = norm_sq(g);
    if (g_sq > 0) setup_.potential_origin = -(lowest / g_sq) * g;
  }

  /// What evens out densities knows one at rest: between liquids of two it would take away what tells them apart.
  void refuse_diffusion_of_fluids() const {
    const auto* liquid = std::get_if<WeaklyCompressibleOptions<N>>(&setup_.scheme);
    if (liquid && liquid->diffusion) refuse_fluids_of("density_diffusion", "density diffusion acts");
    if (liquid && liquid->density_filter) refuse_fluids_of("density_filter", "the density filter acts");
  }
  void refuse_fluids_of(std::string_view key, std::string_view what) const {
    const auto& materials = setup_.options().materials;
    for (const auto& material : materials)
      if (material.rho_0 != materials.front().rho_0)
        root_.table("scheme").fail(key,
                                   fmt::format("{} between '{}' and '{}', which differ in density", what,
                                               materials.front().name, material.name),
                                   "it would mix their densities, not their noise",
                                   fmt::format("set scheme.{}.form = \"none\"", key));
  }

  [[noreturn]] static void not_finite(const Table& table, std::string_view key, std::string_view name, const Vec3& p) {
    table.fail(key, fmt::format("'{}' is not a finite number at ({:.4g}, {:.4g}, {:.4g}) m", name, p[0], p[1], p[2]),
               "a particle begins there",
               "look for a division by 0 or the root or logarithm of a negative number; if(condition, a, b) takes "
               "either value");
  }

  Vec<N> velocity(const Body& body, std::size_t i) {
    Vec<N> v;
    if (body.given.contains("vx")) {
      for (int k = 0; k < N; ++k) {
        const auto column = body.given.find(std::string("v") + "xyz"[k]);
        v[k] = column == body.given.end() ? 0.0 : column->second[i];
      }
      return v;
    }
    if (body.group == Group::wall) return v;
    auto& formulas = velocities_[body.name];
    if (formulas.empty()) formulas = body.table.expressions("velocity", N, std::vector<Expression>(N));
    const auto& p = body.points[i];
    for (int k = 0; k < N; ++k) {
      v[k] = formulas[k](p[0], p[1], p[2], 0);
      if (!std::isfinite(v[k])) not_finite(body.table, "velocity", fmt::format("velocity[{}]", k), p);
    }
    return v;
  }

  void fill_store() {
    auto& store = setup_.store;
    const auto& options = setup_.options();
    store.allocate(Fields<field::x, field::v, field::rho, field::h, field::m, field::rho_0, field::rho_wall, field::mu,
                          field::x_list>::set());
    if (setup_.choice.is_gas) store.allocate(Fields<field::e, field::alpha_v>::set());
    for (const Group group : all_groups)  // ids follow the order of bodies within each group
      for (std::size_t b = 0; b < bodies_.size(); ++b) {
        Body& body = bodies_[b];
        if (body.group != group) continue;
        const auto& material = options.materials[body.material];
        const std::size_t at = store.append(group, body.points.size(), body.material);
        double volume = 1;
        for (int k = 0; k < N; ++k) volume *= setup_.spacing * body.coarser;
        const double mass = body.table.positive("particle_mass", unit::mass, material.rho_0 * volume);
        const auto pressure = initial_pressure(body, material);
        for (std::size_t i = 0; i < body.points.size(); ++i) {
          setup_.body_of_id.push_back(static_cast<int>(b));
          const std::size_t s = at + i;
          store.template get<field::x>()[s] = narrow<N>(body.points[i]);
          store.template get<field::v>()[s] = velocity(body, i);
          const auto given = [&](const char* name, double otherwise) {
            const auto column = body.given.find(name);
            return column == body.given.end() ? otherwise : column->second[i];
          };
          const double p = pressure(body.points[i]);
          if (!std::isfinite(p)) not_finite(body.table, "pressure", "pressure", body.points[i]);
          const bool thermal = setup_.choice.is_gas && material.is_thermal();
          const double density = thermal ? material.rho_0 : material.density(p);
          if (!std::isfinite(density) || density <= 0)
            body.table.fail("pressure", fmt::format("no density belongs to a pressure of {:.4g} Pa", p),
                            "the equation of state cannot be that low", "raise the pressure or the speed of sound");
          store.template get<field::rho>()[s] = given("rho", density);
          store.template get<field::m>()[s] = given("m", mass);
          store.template get<field::h>()[s] = options.support.uniform * body.coarser;
          store.template get<field::rho_0>()[s] = material.rho_0;
          store.template get<field::mu>()[s] = material.mu;
          if (setup_.choice.is_gas) start_gas(body, s, p, material);
        }
      }
  }

  /// Internal energy, and what the law for H takes as reference: the state at the start.
  void start_gas(const Body& body, std::size_t i, double pressure, const materials::Material& material) {
    auto& store = setup_.store;
    const double density = store.template get<field::rho>()[i];
    const double energy = material.internal_energy(density, pressure);
    if (body.group == Group::fluid && !(energy >= 0))
      body.table.fail("pressure", fmt::format("no internal energy belongs to a pressure of {:.4g} Pa", pressure),
                      "it would be negative", "raise the pressure");
    store.template get<field::e>()[i] = energy;
    store.template get<field::alpha_v>()[i] = setup_.choice.alpha_at_start;
    // H = H_0 (rho_0/rho)^(1/N) takes one H_0 for all.
    store.template get<field::rho_0>()[i] = density * std::pow(body.coarser, N);
  }

  /// Initial pressure as a function of position: a formula, the hydrostatic start, or zero.
  std::function<double(const Vec3&)> initial_pressure(const Body& body, const materials::Material& material) {
    if (body.group == Group::wall) return [rest = material.pressure(material.rho_0)](const Vec3&) { return rest; };
    if (body.table.has("surface")) {
      const double surface = body.table.quantity("surface", unit::length);
      const Vec<N> g = setup_.options().gravity;
      const double strength = norm(g);
      if (strength == 0)
        body.table.fail("surface", "a hydrostatic start needs gravity", {}, "set gravity or leave 'surface' out");
      return [=, &material](const Vec3& p) {
        return material.rho_0 * std::max(0.0, strength * surface + dot(g, narrow<N>(p)));
      };
    }
    const double rest = material.pressure(material.rho_0);
    const Expression formula = body.table.expression("pressure", Expression(rest));
    return [formula](const Vec3& p) { return formula(p[0], p[1], p[2], 0); };
  }

  void read_body_force() {
    if (!root_.has("body_force")) return;
    const auto formulas = root_.expressions("body_force", N);
    const IndexRange fluid = setup_.store.range(Group::fluid);
    for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
      const Vec3 p = widen<N>(setup_.store.template get<field::x>()[i]);
      for (int k = 0; k < N; ++k)
        if (!std::isfinite(formulas[k](p[0], p[1], p[2], 0)))
          not_finite(root_, "body_force", fmt::format("body_force[{}]", k), p);
    }
    setup_.options().body_force = [formulas](const Vec<N>& x, double t) {
      const Vec3 p = widen<N>(x);
      Vec<N> a;
      for (int k = 0; k < N; ++k) a[k] = formulas[k](p[0], p[1], p[2], t);
      return a;
    };
  }

  /// Walls that touch fluid begin with the pressure of the fluid at rest there: without it a tank at rest would ring.
  void start_walls() {
    const double surface = hydrostatic_surface();
    auto& store = setup_.store;
    const IndexRange walls = store.range(Group::wall), fluid = store.range(Group::fluid);
    const auto x = store.template get<field::x>();
    const double H = setup_.options().support.uniform, strength = norm(setup_.options().gravity);
    CellGrid<N> near_fluid, near_wall;
    near_fluid.build(x.subspan(fluid.begin, fluid.size()), H, setup_.domain);
    near_wall.build(x.subspan(walls.begin, walls.size()), H, setup_.domain);
    const double lattice = sum_over_lattice();
    std::vector<std::uint32_t> found;
    for (std::size_t i = walls.begin; i < walls.end; ++i) {
      const auto& material = setup_.options().materials[store.materials()[i]];
      near_fluid.find(x[i], H, found);
      double rest = material.rho_0;
      if (!found.empty() && std::isfinite(surface))
        rest =
            material.density(material.rho_0 * std::max(0.0, strength * surface + dot(setup_.options().gravity, x[i])));
      const Body& body = bodies_[static_cast<std::size_t>(setup_.body_of_id[i])];
      if (!body.given.contains("rho")) store.template get<field::rho>()[i] = rest;
      if (setup_.options().wall_density == walls::WallDensity::held) hold_gas(store, setup_.domain, i, found);
      near_wall.find(x[i], H, found);
      store.template get<field::rho_wall>()[i] = wall_reference(material.rho_0, rest, wall_sum(i, found), lattice);
    }
  }

  /// rho_wref of a modified-density wall particle. "auto": what fluid at rest on the wall lacks to `rest`, which is the
  /// wall particles' own sum, less what a whole lattice sums to beyond rho_0.
  double wall_reference(double rho_0, double rest, double own_sum, double lattice) const {
    if (setup_.choice.wall_reference == "given") return setup_.choice.wall_reference_density;
    return setup_.choice.wall_reference == "auto" ? own_sum + rest - rho_0 * lattice : rho_0;
  }

  double kernel(const Vec<N>& d) const {
    const double H = setup_.options().support.uniform;
    return setup_.options().kernels[static_cast<int>(KernelRole::density)].template w<N>(norm(d) / H) / std::pow(H, N);
  }

  double wall_sum(std::size_t i, const std::vector<std::uint32_t>& neighbours) const {
    const std::size_t first = setup_.store.range(Group::wall).begin;
    const auto x = setup_.store.template get<field::x>();
    double sum = 0;
    for (const auto j : neighbours)
      sum +=
          setup_.store.template get<field::m>()[first + j] * kernel(setup_.domain.nearest_image(x[i] - x[first + j]));
    return sum;
  }

  /// sum of V W over an endless lattice of the case's spacing: 1 but for the kernel's discretisation error.
  double sum_over_lattice() const {
    const double dp = setup_.spacing;
    const int reach = static_cast<int>(std::ceil(setup_.options().support.uniform / dp));
    double sum = 0;
    Vec<N, int> cell;
    for (int k = 0; k < N; ++k) cell[k] = -reach;
    for (;;) {
      Vec<N> d;
      for (int k = 0; k < N; ++k) d[k] = dp * cell[k];
      sum += std::pow(dp, N) * kernel(d);
      int axis = 0;
      for (; axis < N; ++axis) {
        if (++cell[axis] <= reach) break;
        cell[axis] = -reach;
      }
      if (axis == N) return sum;
    }
  }

  /// Height of the first hydrostatic fluid's surface, m; not a number when there is none.
  double hydrostatic_surface() const {
    for (const auto& body : bodies_)
      if (body.group == Group::fluid && body.table.has("surface")) return body.table.quantity("surface", unit::length);
    return std::nan("");
  }

  /// What the scheme is told of walls beyond their particles, which have their ids in the order of the store here.
  void plan_walls() {
    auto& plan = setup_.options().walls;
    const IndexRange walls = setup_.store.range(Group::wall);
    const bool mirrors = setup_.options().wall_density == walls::WallDensity::mirrored;
    if (!plan.moves() && !mirrors) return;
    plan.first_id = static_cast<std::int64_t>(walls.begin);
    const auto x = setup_.store.template get<field::x>();
    for (std::size_t i = walls.begin; i < walls.end; ++i) {
      const Body& body = bodies_[static_cast<std::size_t>(setup_.body_of_id[i])];
      if (plan.moves()) {
        plan.motion.push_back(body.motion);
        plan.start.push_back(x[i]);
      }
      if (mirrors) plan.to_mirror.push_back(narrow<N>(to_mirror(*body.surface, widen<N>(x[i]))));
    }
  }

  /// From a point in the wall to its mirror image across the nearest place of the surface.
  static Vec3 to_mirror(const ReflectingSurface& surface, const Vec3& p) {
    return -2 * surface.depth(0, p) * surface.normal(0, p);
  }

  void connect_distance() {
    if (setup_.choice.wall_force != walls::WallForce::distance) return;
    const Table table = root_.table("scheme").table("wall");
    const double distance = table.positive("distance", unit::length, 0.5 * setup_.spacing);
    setup_.options().pushed_out = [surface = pushing_, distance](const Vec<N>& x) -> Vec<N> {
      return narrow<N>(surface->pushed_out(widen<N>(x), distance));
    };
  }

  /// Fluid that would leave the domain comes back as from a wall; at corners along each axis.
  static Bounce<N> kept_inside(const Domain<N>& domain, Bounce<N> bounce) {
    for (int k = 0; k < N; ++k) {
      if (domain.periodic[k] || !std::isfinite(bounce.x[k])) continue;
      if (bounce.x[k] >= domain.low[k] && bounce.x[k] <= domain.high[k]) continue;
      const double face = bounce.x[k] < domain.low[k] ? domain.low[k] : domain.high[k];
      bounce.x[k] = std::clamp(2 * face - bounce.x[k], domain.low[k], domain.high[k]);
      bounce.v[k] = -bounce.v[k];
    }
    return bounce;
  }

  void connect_domain() {
    if (!domain_reflects_) return;
    setup_.options().reflector = [walls = setup_.options().reflector, domain = setup_.domain](
                                     const Vec<N>& from, const Vec<N>& to, const Vec<N>& v) -> Bounce<N> {
      return kept_inside(domain, walls ? walls(from, to, v) : Bounce<N>{to, v});
    };
  }

  void connect_reflector() {
    if (surface_->empty()) return;
    setup_.options().reflector = [surface = surface_](const Vec<N>& from, const Vec<N>& to,
                                                      const Vec<N>& v) -> Bounce<N> {
      const Vec3 a = widen<N>(from), b = widen<N>(to);
      if (surface->clear(a, b)) return {to, v};
      const Reflection r = surface->reflect(a, b, widen<N>(v));
      return {narrow<N>(r.position), narrow<N>(r.velocity)};
    };
    const IndexRange fluid = setup_.store.range(Group::fluid);
    for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
      const Vec3 p = widen<N>(setup_.store.template get<field::x>()[i]);
      if (surface_->depth(p) >= 0) continue;
      throw InputError({.what = "fluid begins on the wrong side of a wall",
                        .where = root_.where("wall"),
                        .why = fmt::format("a particle at ({:.4g}, {:.4g}, {:.4g}) m is {:.3g} m inside it", p[0], p[1],
                                           p[2], -surface_->depth(p)),
                        .fix = "move the fluid, cut the wall out with a 'difference', or set fluid = "
                               "\"inside\"/\"outside\" on the wall"});
    }
  }

  void connect_ghosts() {
    auto& options = setup_.options();
    if (!setup_.choice.ghosts) return;
    double largest = options.support.uniform;
    for (const Body& body : bodies_) largest = std::max(largest, options.support.uniform * body.coarser);
    options.mirrored_support = largest * setup_.choice.support_growth;
    const double reach = options.mirrored_support * (1 + options.neighbours.skin);
    options.mirrors = ghosts_.mirrors(*setup_.choice.ghosts, reach, setup_.domain);
  }

  const Table& root_;
  CaseSetup<N> setup_;
  std::vector<Body> bodies_;
  std::map<std::string, std::vector<Expression>> velocities_;
  GhostWalls<N> ghosts_;
  std::shared_ptr<ReflectingSurface> surface_ = std::make_shared<ReflectingSurface>();  ///< what reflects
  std::shared_ptr<ReflectingSurface> walls_ = std::make_shared<ReflectingSurface>();    ///< every wall
  std::shared_ptr<ReflectingSurface> pushing_ = std::make_shared<ReflectingSurface>();
  bool domain_reflects_ = false;
  double fastest_wall_ = 0;  ///< m/s, until time.end
  std::size_t fluids_ = 0, walls_read_ = 0;
};

}  // namespace

template <int N>
CaseSetup<N> read_case(const Table& root) {
  return Reader<N>(root).read();
}

template CaseSetup<1> read_case<1>(const Table&);
template CaseSetup<2> read_case<2>(const Table&);
template CaseSetup<3> read_case<3>(const Table&);

}  // namespace undine
