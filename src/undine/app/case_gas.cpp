#include <algorithm>

#include <fmt/format.h>

#include "undine/app/case_scheme_parts.hpp"

namespace undine {
namespace {

/// Form of the density, which the laws for H and the forms of the forces depend on.
template <int N>
void read_density(const Table& scheme, std::string_view fallback, GasOptions<N>& options) {
  const Table table = scheme.table("density");
  auto words = terms::ContinuityForms::names();
  words.insert(words.end(), {"summation", "normalised_summation"});
  const std::string form = read_form<terms::GradHDensities>(table, fallback, words);
  options.density = terms::GradHDensities::index_of(form) >= 0 ? DensityForm::grad_h : density_form(form);
  options.grad_h.choose(std::max(0, terms::GradHDensities::index_of(form)));
  options.continuity.choose(std::max(0, terms::ContinuityForms::index_of(form)));
}

/// Pressure and work. Forms of grad-h sums need the sum of the same name.
template <int N>
void read_forces(const Table& scheme, std::string_view fallback, GasOptions<N>& options) {
  const bool iterates = options.iterates();
  const std::string own(options.grad_h.info().name);
  const bool is_grad_h = terms::GradHDensities::index_of(fallback) >= 0;
  const Table pressure = scheme.table("pressure"), energy = scheme.table("energy");
  const std::string force = read_form<terms::GasPressureForms>(pressure, iterates    ? std::string_view(own)
                                                                         : is_grad_h ? std::string_view("symmetric")
                                                                                     : fallback);
  const std::string work = read_form<terms::EnergyForms>(energy, force);
  const auto needs_other = [&](const std::string& form) {
    return terms::GradHDensities::index_of(form) >= 0 && !(iterates && form == own);
  };
  const auto fail = [&](const Table& table, const std::string& form) {
    table.fail("form", fmt::format("'{}' belongs to the density form of that name", form),
               "it weighs with the factor Omega of that sum",
               fmt::format("set scheme.density.form = \"{}\", or take \"symmetric\"", form));
  };
  if (needs_other(force)) fail(pressure, force);
  if (needs_other(work)) fail(energy, work);
  options.pressure.choose(terms::GasPressureForms::index_of(force));
  options.energy.choose(terms::EnergyForms::index_of(work));
}

/// Artificial viscosity, its switch and limiter, conductivity, and the viscosity of the gas itself.
template <int N, class Preset>
void read_dissipation(const Table& scheme, GasOptions<N>& options, SchemeChoice& choice, Preset) {
  OneOf<terms::GasViscosities> viscosity;
  viscosity.get<terms::GasViscositySignal>() = {Preset::alpha, Preset::beta};
  viscosity.get<terms::GasViscosityMonaghan>() = {Preset::alpha, Preset::beta};
  const Table artificial = scheme.table("artificial_viscosity");
  options.artificial = read_optional<terms::GasViscosities>(artificial, Preset::artificial, viscosity);
  if (options.artificial) {
    options.limiter = artificial.choice("limiter", {"balsara", "none"}, std::string(Preset::limiter)) == "balsara";
    const Table table = scheme.table("viscosity_switch");
    auto& rule = options.viscosity_switch;
    rule.choose(
        terms::ViscositySwitches::index_of(read_form<terms::ViscositySwitches>(table, Preset::viscosity_switch)));
    options.artificial->with_chosen([&](const auto& term) { choice.alpha_at_start = term.alpha; });
    rule.with_chosen([&](auto& chosen) {
      if constexpr (requires { chosen.parameters(); }) read_parameters(table, chosen);
      if constexpr (requires { chosen.alpha_min; }) {
        if (!(chosen.alpha_max >= chosen.alpha_min))
          table.fail("alpha_max",
                     fmt::format("alpha_max = {} is less than alpha_min = {}", chosen.alpha_max, chosen.alpha_min), {},
                     "raise it");
        choice.alpha_at_start = chosen.alpha_min;
      }
    });
  }
  options.conductivity = read_optional<terms::Conductivities>(scheme.table("conductivity"), Preset::conductivity);
  options.stress = read_optional<terms::StressForms>(scheme.table("viscosity"), "none");
}

/// Gas meets ghosts, particles that repel, or surfaces that reflect.
template <int N>
void check_walls(const Table& wall, const GasOptions<N>& options, const SchemeChoice& choice) {
  using walls::WallDensity;
  const bool of_gas =
      choice.ghosts || options.wall_density == WallDensity::none || options.wall_density == WallDensity::held;
  if (!of_gas || choice.wall_force == walls::WallForce::distance)
    wall.fail("treatment", "this treatment of walls is for liquids",
              "it answers with a pressure that knows no internal energy",
              "take \"ghost_free_slip\", \"repulsive\" or \"elastic\"");
}

}  // namespace

template <int N, class Preset>
SchemeChoice read_gas(const Table& root, double spacing, GasOptions<N>& options, Preset preset) {
  SchemeChoice choice;
  choice.is_gas = true;
  const Table scheme = root.table("scheme");
  constexpr PresetBasics basics = basics_of<Preset>();
  read_density(scheme, Preset::density, options);
  read_density_filter(scheme, options.density == DensityForm::evolved, options);
  const std::string_view law = options.iterates()                ? "number_density"
                               : Preset::law == "number_density" ? "density"
                                                                 : Preset::law;
  read_basics<N>(scheme, spacing, basics,
                 {{"constant", "density", "density_rate", "number_density"},
                  {"arithmetic", "geometric", "max", "min", "gradients"},
                  law},
                 options);
  options.own_supports = true;
  options.support_over_spacing = options.support.uniform / spacing;
  const Table smoothing = scheme.table("smoothing");
  if (options.iterates() != (options.smoothing == SmoothingLaw::number_density))
    smoothing.fail("law", "density and H come from each other, or neither from the other",
                   fmt::format("the density form is '{}'",
                               options.iterates() ? options.grad_h.info().name : "not one of the grad-h sums"),
                   options.iterates() ? "leave 'law' out" : "set scheme.density.form = \"grad_h\", or another law");
  if (options.kernels[static_cast<std::size_t>(KernelRole::viscosity)] !=
      options.kernels[static_cast<std::size_t>(KernelRole::pressure)])
    scheme.fail("viscosity_kernel", "gases have one kernel for all forces", "work and forces are summed together",
                "leave the key out");
  read_forces(scheme, Preset::pressure, options);
  read_dissipation(scheme, options, choice, preset);
  read_walls<N>(scheme, basics, options, choice);
  options.ghost_hydrostatic = false;
  options.wall_pulls = true;
  if (choice.wall_force == walls::WallForce::repulsion && scheme.table("wall").flag("answers", false))
    options.wall_density = walls::WallDensity::held;
  check_walls(scheme.table("wall"), options, choice);
  // How far H may grow where walls mirror the gas.
  choice.support_growth = smoothing.in_range("growth", unit::one, {1, 100}, 2.0);
  choice.limits.courant = 0.3;
  read_time(root, basics, choice);
  if (options.smoothing == SmoothingLaw::continuity && choice.integrator.find('_') != std::string::npos &&
      choice.integrator != "predictor_corrector")
    smoothing.fail("law", fmt::format("'{}' does not step H by its rate", choice.integrator),
                   "with density by continuity, \"density\" is the same law in closed form",
                   "set law = \"density\", or take the integrator \"leapfrog\"");
  return choice;
}

template SchemeChoice read_gas<1>(const Table&, double, GasOptions<1>&, presets::Gas);
template SchemeChoice read_gas<2>(const Table&, double, GasOptions<2>&, presets::Gas);
template SchemeChoice read_gas<3>(const Table&, double, GasOptions<3>&, presets::Gas);
template SchemeChoice read_gas<1>(const Table&, double, GasOptions<1>&, presets::Niedoba);
template SchemeChoice read_gas<2>(const Table&, double, GasOptions<2>&, presets::Niedoba);
template SchemeChoice read_gas<3>(const Table&, double, GasOptions<3>&, presets::Niedoba);

}  // namespace undine
