#include "undine/app/setup/start.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "undine/geometry/embed.hpp"

namespace undine {
namespace {

/// Initial pressure as a function of position: a formula, the hydrostatic start, or zero.
template <int N>
std::function<double(const Vec3&)> start_pressure(const Body& body, const materials::Material& material,
                                                  const Vec<N>& gravity) {
  const double rest = material.pressure(material.rho_0);
  if (body.group == Group::wall) return [rest](const Vec3&) { return rest; };
  if (body.table.has("surface")) {
    const double surface = body.table.quantity("surface", unit::length);
    const double strength = norm(gravity);
    if (strength == 0)
      body.table.fail("surface", "a hydrostatic start needs gravity", {}, "set gravity or leave 'surface' out");
    return [=, &material](const Vec3& p) {
      return material.rho_0 * std::max(0.0, strength * surface + dot(gravity, narrow<N>(p)));
    };
  }
  const Expression formula = body.table.expression("pressure", Expression(rest));
  return [formula](const Vec3& p) { return formula(p[0], p[1], p[2], 0); };
}

/// Internal energy, and what the law for H takes as reference: the state at the start.
template <int N>
void start_gas(const Body& body, std::size_t i, double pressure, CaseSetup<N>& setup) {
  auto& store = setup.store;
  const double density = store.template get<field::rho>()[i];
  const double energy = setup.options().materials[body.material].internal_energy(density, pressure);
  if (body.group == Group::fluid && !(energy >= 0))
    body.table.fail("pressure", fmt::format("no internal energy belongs to a pressure of {:.4g} Pa", pressure),
                    "it would be negative", "raise the pressure");
  store.template get<field::e>()[i] = energy;
  store.template get<field::alpha_v>()[i] = setup.choice.alpha_at_start;
  // H = H_0 (rho_0/rho)^(1/N) takes one H_0 for all.
  store.template get<field::rho_0>()[i] = density * std::pow(body.coarser, N);
}

/// Appends the particles of one body.
template <int N>
void append_body(const Body& body, CaseSetup<N>& setup) {
  auto& store = setup.store;
  const auto& options = setup.options();
  const auto& material = options.materials[body.material];
  const std::size_t first = store.append(body.group, body.points.size(), body.material);
  double volume = 1;
  for (int k = 0; k < N; ++k) volume *= setup.spacing * body.coarser;
  const double mass = body.table.positive("particle_mass", unit::mass, material.rho_0 * volume);
  const auto pressure = start_pressure<N>(body, material, options.gravity);
  const StartVelocity<N> velocity(body);
  for (std::size_t k = 0; k < body.points.size(); ++k) {
    const std::size_t i = first + k;
    store.template get<field::x>()[i] = narrow<N>(body.points[k]);
    store.template get<field::v>()[i] = velocity(k);
    const auto given = [&](const char* name, double otherwise) {
      const auto column = body.given.find(name);
      return column == body.given.end() ? otherwise : column->second[k];
    };
    const double p = pressure(body.points[k]);
    if (!std::isfinite(p)) refuse_not_finite(body.table, "pressure", "pressure", body.points[k]);
    const bool thermal = setup.choice.is_gas && material.is_thermal();
    const double density = thermal ? material.rho_0 : material.density(p);
    if (!std::isfinite(density) || density <= 0)
      body.table.fail("pressure", fmt::format("no density belongs to a pressure of {:.4g} Pa", p),
                      "the equation of state cannot be that low", "raise the pressure or the speed of sound");
    store.template get<field::rho>()[i] = given("rho", density);
    store.template get<field::m>()[i] = given("m", mass);
    store.template get<field::h>()[i] = options.support.uniform * body.coarser;
    store.template get<field::rho_0>()[i] = material.rho_0;
    store.template get<field::mu>()[i] = material.mu;
    if (setup.choice.is_gas) start_gas(body, i, p, setup);
  }
}

}  // namespace

template <int N>
StartVelocity<N>::StartVelocity(const Body& body) : body_(body) {
  if (body.group == Group::fluid && !body.given.contains("vx"))
    formulas_ = body.table.expressions("velocity", N, std::vector<Expression>(N));
}

template <int N>
Vec<N> StartVelocity<N>::operator()(std::size_t particle) const {
  Vec<N> v;
  if (body_.given.contains("vx")) {
    for (int k = 0; k < N; ++k) {
      const auto column = body_.given.find(std::string("v") + "xyz"[k]);
      v[k] = column == body_.given.end() ? 0.0 : column->second[particle];
    }
    return v;
  }
  if (formulas_.empty()) return v;
  const auto& p = body_.points[particle];
  for (int k = 0; k < N; ++k) {
    v[k] = formulas_[static_cast<std::size_t>(k)](p[0], p[1], p[2], 0);
    if (!std::isfinite(v[k])) refuse_not_finite(body_.table, "velocity", fmt::format("velocity[{}]", k), p);
  }
  return v;
}

template <int N>
void fill_store(const std::vector<Body>& bodies, CaseSetup<N>& setup) {
  setup.store.allocate(Fields<field::x, field::v, field::rho, field::h, field::m, field::rho_0, field::rho_wall,
                              field::mu, field::x_list>::set());
  if (setup.choice.is_gas) setup.store.allocate(Fields<field::e, field::alpha_v>::set());
  for (const Group group : all_groups)  // ids follow the order of bodies within each group
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (bodies[b].group != group) continue;
      append_body(bodies[b], setup);
      setup.body_of_id.insert(setup.body_of_id.end(), bodies[b].points.size(), static_cast<int>(b));
    }
}

void refuse_not_finite(const Table& table, std::string_view key, std::string_view name, const Vec3& at) {
  table.fail(key, fmt::format("'{}' is not a finite number at ({:.4g}, {:.4g}, {:.4g}) m", name, at[0], at[1], at[2]),
             "a particle begins there",
             "look for a division by 0 or the root or logarithm of a negative number; if(condition, a, b) takes "
             "either value");
}

template class StartVelocity<1>;
template class StartVelocity<2>;
template class StartVelocity<3>;

template void fill_store(const std::vector<Body>&, CaseSetup<1>&);
template void fill_store(const std::vector<Body>&, CaseSetup<2>&);
template void fill_store(const std::vector<Body>&, CaseSetup<3>&);

}  // namespace undine
