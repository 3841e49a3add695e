#pragma once
#include "undine/app/watchdog/cause.hpp"

namespace undine::causes {

// What only a gas can go bad of: its internal energy, and a support that is its own.

/// Forms that halve the work of a pair conserve energy, and take it from cold gas that moves away from hot gas: it does
/// the work of the other's pressure, with energy that it does not have.
struct SharedWork {
  static constexpr Info info{"shared_work", "Cold gas pays for the work of hot gas beside it",
                             "an internal energy fell below zero, and the form of the work halves it between a pair",
                             "Monaghan (1992), sec. 3; Price (2012), sec. 3.2"};
  static bool holds(const Evidence& e) { return e.alarm == Alarm::energy && e.setup.shares_work; }
  static std::string because(const Evidence& e) {
    return fmt::format(
        "particle {} had {:.4g} J/kg a step before; signals cross {:.2g} h in one, which is not too far, and each pair "
        "halves its work",
        e.particle.id, e.particle.e, e.courant());
  }
  static std::string remedy(const Evidence&) {
    return "set scheme.energy.form to \"own\" with the pressure form \"symmetric\", to \"own_volume\" with \"sum\"; or "
           "take scheme.name = \"gas\", whose form does the same";
  }
};

/// However large its H, a particle sums no more than sum_b m_b W(0): with few others around, or light ones, that is too
/// little for any H.
struct TooFewParticles {
  static constexpr Info info{"too_few_particles", "The gas has too few particles for a support",
                             "no H gives rho H^N = m q^N: sum_b m_b H^N W(0) < m_a q^N",
                             "Springel & Hernquist (2002); Price (2012)"};
  static bool holds(const Evidence& e) { return e.alarm == Alarm::support && e.exit.company < e.setup.least_company; }
  static std::string because(const Evidence& e) {
    return fmt::format(
        "all particles together count as {:.3g} like particle {}; within an H that fits a density there are {:.3g} or "
        "more",
        e.exit.company, e.particle.id, e.setup.least_company);
  }
  static std::string remedy(const Evidence& e) {
    if (e.setup.removes && e.step > 0)
      return "widen [domain] or set an earlier time.end, so that not nearly all of the gas has left; more particles "
             "(spacing) help for a while";
    return "take more particles (a smaller spacing), of masses that are alike";
  }
};

struct NoRoomForSupport {
  static constexpr Info info{"no_room_for_support", "The support grew beyond what walls or periods have room for",
                             "H > what ghosts were checked for, or half a period", "Niedoba (2012), 2.2.5"};
  static bool holds(const Evidence& e) { return e.alarm == Alarm::support && e.exit.widest > e.setup.room; }
  static std::string because(const Evidence& e) {
    return fmt::format("H is {:.4g} m, there is room for {:.4g} m; it was {:.4g} m at the start", e.exit.widest,
                       e.setup.room, e.setup.support);
  }
  static std::string remedy(const Evidence& e) {
    const double growth = 1.5 * e.exit.widest / e.setup.support;
    return e.setup.ghosts
               ? fmt::format(
                     "set scheme.smoothing.growth to {:.2g}, with walls that are thick enough and as far apart "
                     "from each other; or take more particles where the gas is thin",
                     growth)
               : std::string("widen [domain] along its periods, or take more particles where the gas is thin");
  }
};

struct SupportWithoutNeighbours {
  static constexpr Info info{"support_without_neighbours", "The gas is thinner than its support reaches",
                             "more than watchdog.isolated of its particles have no neighbour within H",
                             "Hernquist & Katz (1989), sec. 2; Niedoba (2012), 2.2.4"};
  static bool holds(const Evidence& e) { return e.alarm == Alarm::isolated; }
  static std::string because(const Evidence& e) {
    return fmt::format("{:.0f} % of the particles have no neighbour within their support, which {}",
                       100 * e.before.isolated,
                       e.setup.follows ? "follows the density by its rate, and there is none" : "stays as it was");
  }
  static std::string remedy(const Evidence&) {
    return "take scheme.name = \"gas\", whose support follows from the density (law \"number_density\"), or "
           "scheme.smoothing.law = \"density\"";
  }
};

}  // namespace undine::causes
