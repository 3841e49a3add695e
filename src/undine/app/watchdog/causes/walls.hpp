#pragma once
#include "undine/app/watchdog/cause.hpp"

namespace undine::causes {

// How particles get where there should be none.

struct WallTooThin {
  static constexpr Info info{"wall_too_thin", "A wall has fewer layers than the support spans",
                             "fluid behind a wall's surface by 1/4 spacing or more, layers < H/spacing, no guard",
                             "Adami, Hu & Adams (2012), sec. 2.2"};
  static bool holds(const Evidence& e) {
    return e.setup.layers_missing > 0 && !e.setup.guarded && e.behind_walls() > 0.25 * e.setup.spacing;
  }
  static std::string because(const Evidence& e) {
    return fmt::format(
        "a wall lacks {} layer{} of particles, nothing reflects at its surface, and fluid is {:.3g} "
        "spacings behind it",
        e.setup.layers_missing, e.setup.layers_missing == 1 ? "" : "s", e.behind_walls() / e.setup.spacing);
  }
  static std::string remedy(const Evidence&) {
    return "leave 'layers', 'thin' and 'sheet' of the wall out, or set scheme.wall.guard = true";
  }
};

struct WallUnguarded {
  static constexpr Info info{"wall_unguarded", "Fluid passed a wall that nothing guards",
                             "fluid behind a wall's surface by 1/4 spacing or more, which does not reflect", ""};
  static bool holds(const Evidence& e) {
    return e.setup.walls && !e.setup.guarded && e.behind_walls() > 0.25 * e.setup.spacing;
  }
  static std::string because(const Evidence& e) {
    return fmt::format("fluid is {:.3g} spacings behind a wall's surface, and not all of them reflect",
                       e.behind_walls() / e.setup.spacing);
  }
  static std::string remedy(const Evidence&) {
    return "set scheme.wall.guard = true, or take a treatment that holds ('adami', 'combined')";
  }
};

struct NothingBelow {
  static constexpr Info info{"nothing_below", "The fluid falls out of the domain",
                             "left through the face that gravity points to, not past a wall, calmly", ""};
  static bool holds(const Evidence& e) {
    return e.left_calmly() && e.exit.downwards && (!e.setup.walls || e.particle.depth > 0);
  }
  static std::string because(const Evidence& e) {
    return fmt::format("the particle left downwards at {:.4g} m/s, {}", e.exit.speed,
                       e.setup.walls ? "where there is no wall" : "and the case has no walls");
  }
  static std::string remedy(const Evidence&) {
    return "add a [[wall]] below the fluid (with fluid = \"inside\" for a tank), or close its face: see 'open'";
  }
};

struct DomainTooSmall {
  static constexpr Info info{"domain_too_small", "The domain ends where fluid may go",
                             "left upwards, or in a case without walls, calmly", ""};
  static bool holds(const Evidence& e) {
    return e.left_calmly() && (e.exit.upwards || !e.setup.walls) && !e.exit.downwards;
  }
  static std::string because(const Evidence& e) {
    return fmt::format("the particle left the domain {}at {:.4g} m/s, no faster than the case's own speeds",
                       e.exit.upwards ? "upwards " : "", e.exit.speed);
  }
  static std::string remedy(const Evidence&) {
    return "widen [domain], or set domain.on_escape to \"remove\" or \"reflect\"";
  }
};

struct LeftThroughGap {
  static constexpr Info info{"left_through_gap", "The fluid left through a gap or an open face",
                             "left sideways, not past a wall's surface, calmly", ""};
  static bool holds(const Evidence& e) {
    return e.left_calmly() && e.setup.walls && e.particle.depth > -0.25 * e.setup.spacing;
  }
  static std::string because(const Evidence& e) {
    return fmt::format("the particle left the domain at {:.4g} m/s where no wall's surface is in the way",
                       e.exit.speed);
  }
  static std::string remedy(const Evidence&) {
    return "close the walls: look at 'open', and for gaps between shapes; or widen [domain]";
  }
};

}  // namespace undine::causes
