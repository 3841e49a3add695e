#include "undine/app/case_scheme.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "undine/app/case_scheme_parts.hpp"
#include "undine/app/parameters.hpp"
#include "undine/core/error.hpp"
#include "undine/integrators/catalogue.hpp"

namespace undine {
namespace {

template <int N>
void read_smoothing(const Table& scheme, double spacing, double preset_ratio, const SmoothingWords& words,
                    FlowOptions<N>& options) {
  const Table table = scheme.table("smoothing");
  auto& support = options.support;
  // A kernel whose natural kappa is 1 leaves h = H: viscosity and step limits then see the whole support.
  support.kappa = table.in_range("kappa", unit::one, {0.5, 10}, options.kernels[0].natural_kappa());
  if (table.has("support") && table.has("h_over_spacing"))
    table.fail("h_over_spacing", "both 'support' and 'h_over_spacing' are given",
               "they say the same thing: H = kappa h", "keep one of them");
  if (table.has("h_over_spacing")) {
    support.uniform = support.kappa * spacing * table.positive("h_over_spacing", unit::one);
  } else {
    support.uniform = table.positive("support", unit::length, preset_ratio * spacing);
  }
  const double ratio = support.uniform / spacing;
  if (ratio < 1.2 || ratio > 8)
    table.fail(table.has("support") ? "support" : "h_over_spacing",
               fmt::format("the support radius is {:.3g} spacings", ratio),
               fmt::format(
                   "H = {:.4g} m, spacing = {:.4g} m; below 1.2 a particle has no neighbours, above 8 it has thousands",
                   support.uniform, spacing),
               "choose support between 2 and 4 spacings (h_over_spacing about 1.0 to 2.0)");
  const auto chosen = [&](const char* key, const std::vector<std::string>& all, std::string_view fallback) {
    return std::ranges::find(all, table.choice(key, all, std::string(fallback))) - all.begin();
  };
  options.smoothing = static_cast<SmoothingLaw>(chosen("law", words.laws, words.law));
  support.mean = static_cast<Symmetrisation>(chosen("mean", words.means, "arithmetic"));
}

/// The instruction set of the pair loops. Another number of lanes rounds differently, so a run that is to be the same
/// bits on another machine names one that both have.
template <int N>
void read_instructions(const Table& scheme, FlowOptions<N>& options) {
  std::vector<std::string> names{"auto"};
  names.insert(names.end(), instruction_set_names.begin(), instruction_set_names.end());
  const auto chosen = std::ranges::find(names, scheme.choice("instructions", names, "auto")) - names.begin();
  if (chosen == 0) return;
  const auto set = static_cast<InstructionSet>(chosen - 1);
  if (!can_run(set))
    scheme.fail("instructions", fmt::format("this machine cannot run '{}'", names[static_cast<std::size_t>(chosen)]),
                fmt::format("the widest instruction set here is '{}'",
                            instruction_set_names[static_cast<std::size_t>(best_instructions())]),
                "leave the key out, or name a narrower set");
  options.backend.instructions = options.neighbours.instructions = set;
}

template <int N>
void read_backend(const Table& scheme, FlowOptions<N>& options) {
  const std::vector<std::string> kinds(backend_names.begin(), backend_names.end());
  const std::vector<std::string> precisions(precision_names.begin(), precision_names.end());
  options.backend.kind =
      static_cast<BackendKind>(std::ranges::find(kinds, scheme.choice("backend", kinds, "threads")) - kinds.begin());
  const bool plain = options.backend.kind != BackendKind::threads;
  options.backend.precision = static_cast<PairPrecision>(
      std::ranges::find(precisions, scheme.choice("precision", precisions, plain ? "double" : "mixed")) -
      precisions.begin());
  if (plain && options.backend.precision == PairPrecision::mixed)
    scheme.fail("precision", "the serial and checked backends work in double only", "they define what is right",
                "set precision = \"double\" or backend = \"threads\"");
  read_instructions(scheme, options);
  std::vector<std::string> searches;
  for (const Info& info : search_infos()) searches.emplace_back(info.name);
  const Table search = scheme.table("search");
  options.neighbours.search = search.choice("name", searches, "cell_grid");
  options.neighbours.skin = search.in_range("skin", unit::one, {0, 1}, 0.1);
  const std::vector<std::string> lists(lists_names.begin(), lists_names.end());
  options.neighbours.lists = static_cast<Lists>(
      std::ranges::find(lists, search.choice("lists", lists, plain ? "plain" : "auto")) - lists.begin());
  options.neighbours.list_memory = 1e6 * search.in_range("list_memory_mb", unit::one, {0, 1e9}, 0);
}

/// What viscosities do at walls. A preset's no-slip walls are a default only where walls and fluid can do it.
template <int N>
void read_slip(const Table& wall, std::string_view preset, WeaklyCompressibleOptions<N>& options) {
  options.wall_friction = wall.flag("friction", true);
  using walls::WallDensity;
  const bool answers =
      options.wall_density == WallDensity::extrapolated || options.wall_density == WallDensity::mirrored;
  if (!wall.has("slip") && (preset != "no_slip" || !answers || !options.viscosity || wall.has("friction"))) return;
  if (wall.has("friction"))
    wall.fail("slip", "both 'slip' and 'friction' are given", "friction = false is slip = \"free_slip\"",
              "keep 'slip'");
  const std::string slip = wall.choice("slip", {"free_slip", "wall_velocity", "no_slip"}, std::string(preset));
  options.wall_friction = slip != "free_slip";
  options.wall_no_slip = slip == "no_slip";
  if (!options.wall_no_slip) return;
  if (!answers)
    wall.fail("slip", "these walls cannot hold the fluid at their surface",
              "only the treatments 'adami' and 'mdbc' answer with a velocity",
              "take one of them, or slip = \"wall_velocity\"");
  if (!options.viscosity)
    wall.fail("slip", "nothing holds the fluid at a no-slip wall", "the case has no viscous force",
              "choose scheme.viscosity.form, such as \"morris\"");
}

/// Corrected gradients and shifted particles.
template <int N, class Preset>
void read_consistency(const Table& scheme, WeaklyCompressibleOptions<N>& options, Preset) {
  options.corrected_gradients =
      scheme.choice("gradients", {"plain", "corrected"}, std::string(Preset::gradients)) == "corrected";
  options.shifting = read_optional<terms::Shiftings>(scheme.table("shifting"), Preset::shifting);
  if (options.consistent() && options.xsph)
    scheme.table("xsph").fail("form", "XSPH does not go with corrected gradients or shifted particles",
                              "both would say how particles move beside their velocity",
                              "set scheme.xsph.form = \"none\", or gradients = \"plain\" and shifting.form = \"none\"");
}

template <int N, class Preset>
SchemeChoice read_liquid(const Table& root, double spacing, WeaklyCompressibleOptions<N>& options, Preset) {
  SchemeChoice choice;
  const Table scheme = root.table("scheme");
  constexpr PresetBasics basics = basics_of<Preset>();
  read_basics<N>(scheme, spacing, basics,
                 {{"constant", "density"}, {"arithmetic", "geometric", "max", "min"}, "constant"}, options);

  const std::string density = read_form<terms::ContinuityForms>(scheme.table("density"), Preset::density,
                                                                {"summation", "normalised_summation"});
  options.density = density_form(density);
  options.continuity.choose(std::max(0, terms::ContinuityForms::index_of(density)));
  read_density_filter(scheme, options.density == DensityForm::evolved, options);
  options.pressure.choose(
      terms::PressureForms::index_of(read_form<terms::PressureForms>(scheme.table("pressure"), Preset::pressure)));
  choice.separation = Preset::separation;
  choice.reach = Preset::reach;
  options.viscosity = read_optional<terms::ViscosityForms>(scheme.table("viscosity"), Preset::viscosity);
  options.diffusion = read_optional<terms::DiffusionForms>(scheme.table("density_diffusion"), Preset::diffusion);
  terms::ViscosityMonaghan artificial;
  artificial.alpha = Preset::alpha;
  options.artificial =
      read_optional<terms::ArtificialViscosities>(scheme.table("artificial_viscosity"), Preset::artificial, artificial);
  options.xsph =
      read_optional<terms::VelocityCorrections>(scheme.table("xsph"), Preset::xsph, terms::Xsph{Preset::epsilon});
  options.xsph_target =
      scheme.table("xsph").choice("acts_on", {"position", "velocity"}, std::string(Preset::xsph_target)) == "velocity"
          ? XsphTarget::velocity
          : XsphTarget::position;
  read_consistency(scheme, options, Preset{});
  options.strain_dissipation = root.table("output").flag("strain_dissipation", false);

  read_walls<N>(scheme, basics, options, choice);
  read_slip(scheme.table("wall"), Preset::slip, options);
  if (options.consistent() && choice.wall_force == walls::WallForce::repulsion)
    scheme.table("wall").fail("treatment", "walls that repel do not go with corrected gradients or shifted particles",
                              "they are no part of the neighbourhood whose moments and concentration are summed",
                              "take walls of particles, such as \"adami\"");
  read_time(root, basics, choice);
  return choice;
}

}  // namespace

template <int N>
void read_basics(const Table& scheme, double spacing, const PresetBasics& preset, const SmoothingWords& words,
                 FlowOptions<N>& options) {
  const std::string kernel = scheme.choice("kernel", Kernels::names(), std::string(preset.kernel));
  const char* roles[] = {"density_kernel", "pressure_kernel", "viscosity_kernel"};
  for (int role = 0; role < kernel_roles; ++role)
    options.kernels[role] = KernelChoice(Kernels::index_of(scheme.choice(roles[role], Kernels::names(), kernel)));
  read_smoothing(scheme, spacing, preset.support_over_spacing, words, options);
  read_backend(scheme, options);
}

template <int N>
void read_walls(const Table& scheme, const PresetBasics& preset, FlowOptions<N>& options, SchemeChoice& choice) {
  const Table wall = scheme.table("wall");
  const std::string treatment = wall.choice("treatment", walls::Walls::names(), std::string(preset.wall));
  walls::Walls::visit(walls::Walls::index_of(treatment), [&]<class W>(W) {
    options.wall_density = W::density;
    choice.wall_force = walls::force_of<W>();
    choice.reflects = wall.flag("guard", W::reflects || preset.guard);
    if constexpr (requires { W::slip; }) choice.ghosts = W::slip;
  });
  if (choice.ghosts) {
    options.ghost_hydrostatic = wall.flag("hydrostatic", true);
    if (!choice.reflects)
      wall.fail("guard", "walls with ghosts need the guard",
                "the ghost of a particle behind a wall would lie in the fluid", "leave 'guard' out");
  }
  const bool repels = choice.wall_force == walls::WallForce::repulsion;
  choice.wall_particles = (options.wall_density != walls::WallDensity::none && !choice.ghosts) || repels;
  options.wall_pulls = wall.flag("pulls", preset.wall_pulls);
  choice.restitution = wall.in_range("restitution", unit::one, {0, 1}, 1.0);
  const std::int64_t layers = wall.integer("layers", repels ? 1 : preset.wall_layers);
  if (layers < 0 || layers > 100)
    wall.fail("layers", fmt::format("a wall cannot have {} layers", layers), {},
              "give 1 to 100, or 0 for as many as the support needs");
  choice.wall_layers = static_cast<int>(layers);
  if (options.wall_density == walls::WallDensity::modified) {
    choice.wall_reference = wall.choice("reference", {"auto", "rho_0", "given"}, std::string(preset.wall_reference));
    if (choice.wall_reference == "given")
      choice.wall_reference_density = wall.positive("reference_density", unit::density);
  }
}

void read_time(const Table& root, const PresetBasics& preset, SchemeChoice& choice) {
  const Table time = root.table("time");
  choice.end = time.positive("end", unit::time);
  choice.integrator = time.choice("integrator", integrators::Integrators::names(), std::string(preset.integrator));
  integrators::Integrators::visit(integrators::Integrators::index_of(choice.integrator), [&]<class I>(I) {
    if constexpr (requires { I::adapts; }) {
      if (!time.has("step")) choice.tolerance = time.positive("tolerance", unit::one, 1e-5);
    }
  });
  if (time.has("step") || (preset.fixed_step > 0 && !time.has("courant"))) {
    choice.limits.fixed = time.positive("step", unit::time, preset.fixed_step);
  } else {
    choice.limits.courant = time.positive("courant", unit::one, choice.limits.courant);
    choice.limits.force = time.positive("force", unit::one, choice.limits.force);
    choice.limits.viscous = time.positive("viscous", unit::one, choice.limits.viscous);
    choice.limits.largest = time.positive("largest_step", unit::time, choice.end);
  }
}

template <int N>
SchemeChoice read_scheme(const Table& root, double spacing, SchemeOptions<N>& options) {
  const Table scheme = root.table("scheme");
  const int preset = presets::Presets::index_of(scheme.choice("name", presets::Presets::names(), "recommended"));
  SchemeChoice choice = presets::Presets::visit(preset, [&]<class Preset>(Preset p) {
    if constexpr (requires { Preset::is_gas; }) {
      return read_gas<N>(root, spacing, options.template emplace<GasOptions<N>>(), p);
    } else {
      return read_liquid<N>(root, spacing, options.template emplace<WeaklyCompressibleOptions<N>>(), p);
    }
  });
  choice.preset = preset;
  std::vector<double> none(N, 0.0);
  choice.gravity = root.quantities("gravity", unit::acceleration, N, none);
  std::visit(
      [&](FlowOptions<N>& common) {
        for (int k = 0; k < N; ++k) common.gravity[k] = choice.gravity[k];
      },
      options);
  return choice;
}

template <int N>
std::string describe_terms(const SchemeOptions<N>& options) {
  const auto if_any = [](const char* what, const auto& term) {
    return term ? fmt::format(", {} {}", what, term->info().name) : std::string();
  };
  if (const auto* gas = std::get_if<GasOptions<N>>(&options)) {
    const char* densities[] = {"by continuity", "summed", "summed and normalised", "and support by each other"};
    return fmt::format("density {}{}, pressure {}, energy {}{}{}{}{}", densities[static_cast<int>(gas->density)],
                       if_any("filter", gas->density_filter), gas->pressure.info().name, gas->energy.info().name,
                       if_any("artificial viscosity", gas->artificial),
                       gas->switches() ? fmt::format(" ({})", gas->viscosity_switch.info().name) : "",
                       gas->conductivity ? ", conductivity" : "", if_any("viscosity", gas->stress));
  }
  const auto& liquid = std::get<WeaklyCompressibleOptions<N>>(options);
  return fmt::format("pressure {}, {}{}{}{}{}{}", liquid.pressure.info().name,
                     liquid.density == DensityForm::evolved ? liquid.continuity.info().name : "summation",
                     if_any("filter", liquid.density_filter), if_any("viscosity", liquid.viscosity),
                     if_any("artificial viscosity", liquid.artificial), if_any("diffusion", liquid.diffusion),
                     liquid.xsph ? ", XSPH" : "");
}

materials::Material read_material(const Table& table, const SchemeChoice& choice, double expected_speed,
                                  std::vector<std::string>& warnings) {
  materials::Material material;
  material.name = table.text("name", "water");
  material.rho_0 = table.positive("density", unit::density, 1000.0);
  const bool saalfeld = choice.preset == presets::Presets::index<presets::Saalfeld>();
  material.mu = table.non_negative("viscosity", unit::dynamic_viscosity, choice.is_gas ? 0 : saalfeld ? 1.52e-3 : 1e-3);

  const Table eos = table.table("eos");
  const auto fallback = presets::Presets::visit(choice.preset, [](auto p) { return decltype(p)::eos; });
  const std::string form = read_form<materials::EquationsOfState>(eos, fallback);
  const double sound_speed = std::max(10 * expected_speed, 1e-3);
  materials::EquationsOfState::visit(materials::EquationsOfState::index_of(form), [&](auto law) {
    law.rho_0 = material.rho_0;
    if constexpr (requires { law.c_0; }) law.c_0 = sound_speed;
    read_parameters(eos, law);
    material.eos = law;
  });
  presets::Presets::visit(choice.preset, [&]<class Preset>(Preset) {
    if constexpr (requires { Preset::tension; }) {
      // Without gravity nothing presses a liquid together: a closed flow needs its tension.
      const bool falls = std::ranges::any_of(choice.gravity, [](double g) { return g != 0; });
      material.tension = eos.flag("tension", Preset::tension || !falls);
    }
  });
  const double c = material.sound_speed(material.rho_0);
  if (!choice.is_gas && c < 9.999 * expected_speed)
    warnings.push_back(
        fmt::format("{}: the speed of sound of '{}' is {:.4g} m/s, only {:.2g} times the expected velocity of {:.4g} "
                    "m/s; density will "
                    "vary by more than 1 % (ten times or more is usual: {:.4g} m/s)",
                    eos.where().text(), material.name, c, c / expected_speed, expected_speed, sound_speed));
  return material;
}

template SchemeChoice read_scheme<1>(const Table&, double, SchemeOptions<1>&);
template std::string describe_terms<1>(const SchemeOptions<1>&);
template void read_basics<1>(const Table&, double, const PresetBasics&, const SmoothingWords&, FlowOptions<1>&);
template void read_walls<1>(const Table&, const PresetBasics&, FlowOptions<1>&, SchemeChoice&);
template SchemeChoice read_scheme<2>(const Table&, double, SchemeOptions<2>&);
template std::string describe_terms<2>(const SchemeOptions<2>&);
template void read_basics<2>(const Table&, double, const PresetBasics&, const SmoothingWords&, FlowOptions<2>&);
template void read_walls<2>(const Table&, const PresetBasics&, FlowOptions<2>&, SchemeChoice&);
template SchemeChoice read_scheme<3>(const Table&, double, SchemeOptions<3>&);
template std::string describe_terms<3>(const SchemeOptions<3>&);
template void read_basics<3>(const Table&, double, const PresetBasics&, const SmoothingWords&, FlowOptions<3>&);
template void read_walls<3>(const Table&, const PresetBasics&, FlowOptions<3>&, SchemeChoice&);

}  // namespace undine
