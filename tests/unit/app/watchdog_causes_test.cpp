#include <functional>
#include <limits>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "undine/app/watchdog/causes/catalogue.hpp"
#include "undine/app/watchdog/diagnosis.hpp"

namespace undine {
namespace {

using causes::Causes;
using testing::HasSubstr;

/// A dam break of water, 0.2 m deep, at 2 cm and ten times the speed: nothing is wrong with it.
Evidence sound_run() {
  Evidence e;
  e.alarm = Alarm::density;
  e.time = 0.1;
  e.step = 400;
  e.dt = 2e-4;
  e.setup = {.spacing = 0.02, .support = 0.052, .kappa = 2, .sound_speed = 20, .gravity = 9.81, .depth = 0.2};
  e.setup.walls = e.setup.guarded = true;
  e.start.fastest = e.start.typical_speed = 0.5;
  return e;
}

/// The same of gas: a tube in which all is well.
void gas(Evidence& e) {
  e.setup.gas = e.setup.follows = true;
  e.setup.stiff = false;
  e.setup.sound_speed = e.start.sound = 1.2;
  e.before.courant = 0.3;
}

void left(Evidence& e, double speed) {
  e.alarm = Alarm::outside;
  e.exit = {.left = true, .speed = speed};
}

struct Planted {
  std::string cause;
  std::function<void(Evidence&)> sick;    ///< what makes it the diagnosis
  std::function<void(Evidence&)> nearly;  ///< the same on the other side of its limit
};

const std::vector<Planted>& planted() {
  static const std::vector<Planted> all{
      {"body_force_not_finite", [](Evidence& e) { e.before.body_force_finite = false; }, [](Evidence&) {}},
      {"units_of_density", [](Evidence& e) { e.start.most_mass = 1000; }, [](Evidence& e) { e.start.most_mass = 9; }},
      {"initial_density", [](Evidence& e) { e.start.highest_density = 1.6; },
       [](Evidence& e) { e.start.highest_density = 1.1; }},
      {"overlap_at_start",
       [](Evidence& e) {
         e.start.closest = 0.7;
         e.start.most_filling = 1.9;
       },
       [](Evidence& e) { e.start.closest = 0.7; }},  // jitter alone
      {"wild_particle", [](Evidence& e) { e.start.fastest = 4000; }, [](Evidence& e) { e.start.fastest = 3; }},
      {"step_over_courant", [](Evidence& e) { e.dt = 1.2e-3; }, [](Evidence& e) { e.dt = 7e-4; }},
      {"step_over_viscous", [](Evidence& e) { e.setup.viscosity = 2; }, [](Evidence& e) { e.setup.viscosity = 0.4; }},
      {"wall_faster_than_sound", [](Evidence& e) { e.before.fastest_wall = 8; },
       [](Evidence& e) { e.before.fastest_wall = 3; }},
      {"units_of_gravity", [](Evidence& e) { e.setup.gravity = 9810; }, [](Evidence& e) { e.setup.gravity = 40; }},
      {"sound_speed_too_small", [](Evidence& e) { e.setup.sound_speed = 2; },
       [](Evidence& e) { e.setup.sound_speed = 12; }},
      {"one_particle_takes_the_step",
       [](Evidence& e) {
         e.alarm = Alarm::step_collapse;
         e.before.one_against_rest = 1e5;
       },
       [](Evidence& e) { e.before.one_against_rest = 1e5; }},
      {"shared_work",
       [](Evidence& e) {
         gas(e);
         e.alarm = Alarm::energy;
         e.setup.shares_work = true;
       },
       [](Evidence& e) {
         gas(e);
         e.alarm = Alarm::energy;
       }},
      {"too_few_particles",
       [](Evidence& e) {
         gas(e);
         e.alarm = Alarm::support;
         e.setup.least_company = 2.2;
         e.exit.company = 2;
         e.setup.room = 0.1;
         e.exit.widest = 0.101;  // where it also outgrew its room, more room would not help
       },
       [](Evidence& e) {
         gas(e);
         e.alarm = Alarm::support;
         e.setup.least_company = 2.2;
         e.exit.company = 3;
       }},
      {"no_room_for_support",
       [](Evidence& e) {
         gas(e);
         e.alarm = Alarm::support;
         e.setup.room = 0.1;
         e.exit.widest = 0.101;
       },
       [](Evidence& e) {
         gas(e);
         e.alarm = Alarm::support;
         e.exit.widest = 0.101;
       }},  // there is room without end: particles that coincide have no support either
      {"support_without_neighbours",
       [](Evidence& e) {
         gas(e);
         e.alarm = Alarm::isolated;
         e.before.isolated = 0.3;
       },
       [](Evidence& e) {
         gas(e);
         e.before.isolated = 0.1;
       }},
      {"wall_too_thin",
       [](Evidence& e) {
         e.setup.guarded = false;
         e.setup.layers_missing = 2;
         e.particle.depth = -0.01;
       },
       [](Evidence& e) {
         e.setup.layers_missing = 2;
         e.before.behind = 0.01;
       }},  // what is guarded holds with one layer too
      {"wall_unguarded",
       [](Evidence& e) {
         e.setup.guarded = false;
         e.before.behind = 0.01;
       },
       [](Evidence& e) {
         e.setup.guarded = false;
         e.before.behind = 0.004;
       }},
      {"nothing_below",
       [](Evidence& e) {
         left(e, 2);
         e.exit.downwards = true;
       },
       [](Evidence& e) {
         left(e, 200);
         e.exit.downwards = true;
       }},
      {"domain_too_small",
       [](Evidence& e) {
         left(e, 2);
         e.exit.upwards = true;
       },
       [](Evidence& e) {
         left(e, 200);
         e.exit.upwards = true;
       }},
      {"left_through_gap", [](Evidence& e) { left(e, 2); }, [](Evidence& e) { left(e, 200); }},
      {"euler_unstable", [](Evidence& e) { e.setup.euler = true; }, [](Evidence&) {}},
      {"kernel_unfit",
       [](Evidence& e) {
         e.alarm = Alarm::coincidence;
         e.setup.gradient_peak = 1.16;
       },
       [](Evidence& e) { e.setup.gradient_peak = 1.16; }},
      {"support_too_small", [](Evidence& e) { e.start.neighbours = 4; }, [](Evidence& e) { e.start.neighbours = 9; }},
      {"tensile_clumping",
       [](Evidence& e) {
         e.before.clumped = 0.3;
         e.before.tension = 0.9;
       },
       [](Evidence& e) { e.before.tension = 0.9; }},
      {"missing_viscosity", [](Evidence& e) { e.setup.damped = false; },
       [](Evidence& e) {
         left(e, 2);
         e.setup.damped = false;
       }},
  };
  return all;
}

TEST(Causes, NoneFitsASoundRun) {
  const Diagnosis diagnosis = diagnose(sound_run());
  EXPECT_EQ(diagnosis.cause, "unknown");
  EXPECT_TRUE(diagnosis.also.empty());
  EXPECT_FALSE(diagnosis.remedy.empty());
}

TEST(Causes, EachIsFoundByItsEvidenceAndNotShortOfIt) {
  for (const Planted& one : planted()) {
    Evidence sick = sound_run(), nearly = sound_run();
    one.sick(sick);
    one.nearly(nearly);
    EXPECT_EQ(diagnose(sick).cause, one.cause);
    EXPECT_NE(diagnose(nearly).cause, one.cause);
  }
}

TEST(Causes, EachIsPlanted) {
  std::set<std::string> names;
  for (const Planted& one : planted()) names.insert(one.cause);
  for (const std::string& name : Causes::names()) EXPECT_TRUE(names.contains(name)) << name;
  EXPECT_EQ(static_cast<int>(names.size()), Causes::size);
}

TEST(Causes, SayWhatSpeaksForThemAndWhatToChange) {
  for (const Planted& one : planted()) {
    Evidence sick = sound_run();
    sick.particle.id = 17;
    one.sick(sick);
    const Diagnosis diagnosis = diagnose(sick);
    EXPECT_GT(diagnosis.because.size(), 20u) << one.cause;
    EXPECT_GT(diagnosis.remedy.size(), 20u) << one.cause;
    EXPECT_EQ(diagnosis.because.find("nan"), std::string::npos) << diagnosis.because;
    const std::string text = diagnosis_text(diagnosis, sick);
    EXPECT_THAT(text, HasSubstr(one.cause));
    EXPECT_THAT(text, HasSubstr(diagnosis.remedy));
    EXPECT_EQ(diagnosis_json(diagnosis, sick)["cause"], one.cause);
  }
}

TEST(Causes, TheMoreSpecificComesFirstAndTheOthersAreNamed) {
  Evidence e = sound_run();
  e.setup.damped = false;
  e.setup.sound_speed = 2;
  const Diagnosis diagnosis = diagnose(e);
  EXPECT_EQ(diagnosis.cause, "sound_speed_too_small");
  EXPECT_THAT(diagnosis.also, testing::Contains("missing_viscosity"));
}

// Criterion: what is usual for a gas (walls above the speed of sound, masses as unlike as densities) is no cause, and
// its step is judged by the speed of signals.
TEST(Causes, OfAGasAreAskedAsAGasNeeds) {
  Evidence e = sound_run();
  gas(e);
  e.alarm = Alarm::coincidence;
  e.before.fastest_wall = 3;
  e.start.least_mass = 0.01;
  e.setup.gravity = 100;
  e.before.clumped = 0.1;
  EXPECT_EQ(diagnose(e).cause, "unknown");
  e.before.courant = 1.2;
  EXPECT_EQ(diagnose(e).cause, "step_over_courant");
  EXPECT_THAT(diagnose(e).remedy, HasSubstr("0.3"));
  e.setup.fixed_step = true;
  e.dt = 4e-3;
  EXPECT_THAT(diagnose(e).remedy, HasSubstr("0.001 s"));  // 0.3 of 4 ms/1.2
  e.before.courant = 0.3;
  e.setup.damped = false;
  EXPECT_EQ(diagnose(e).cause, "missing_viscosity");
  EXPECT_THAT(diagnose(e).remedy, HasSubstr("signal"));
}

// Criterion: gas that expands into a void leaves with 5 c and has left calmly; with 20 c it was thrown out.
TEST(Causes, GasThatExpandsLeavesCalmly) {
  Evidence e = sound_run();
  gas(e);
  e.setup.walls = false;
  e.start.fastest = e.start.typical_speed = 0;
  e.setup.gravity = 0;
  left(e, 5 * e.start.sound - 0.01);
  EXPECT_EQ(diagnose(e).cause, "domain_too_small");
  left(e, 20 * e.start.sound);
  EXPECT_EQ(diagnose(e).cause, "unknown");
}

TEST(Causes, RemediesGiveNumbersThatHold) {
  Evidence e = sound_run();
  e.setup.fixed_step = true;
  e.dt = 1.2e-3;
  // 0.4 h/c = 0.4 0.026 / 20
  EXPECT_THAT(diagnose(e).remedy, HasSubstr("0.00052 s"));
  e = sound_run();
  e.setup.sound_speed = 2;
  EXPECT_THAT(diagnose(e).remedy, HasSubstr("19.8 m/s"));  // ten times sqrt(2 g 0.2 m)
}

TEST(Diagnosis, TellsOfAGasItsEnergyAndSupport) {
  Evidence e = sound_run();
  gas(e);
  e.alarm = Alarm::energy;
  e.particle.id = 3;
  e.particle.e = 2.5;
  e.particle.support = 0.036;
  const std::string text = diagnosis_text(diagnose(e), e);
  EXPECT_THAT(text, HasSubstr("particle 3 has no internal energy or density above zero left"));
  EXPECT_THAT(text, HasSubstr("e = 2.5 J/kg, H = 0.036 m"));
  EXPECT_EQ(diagnosis_json(diagnose(e), e)["particle"]["support"], 0.036);
  EXPECT_EQ(diagnosis_json(diagnose(e), e)["alarm"], "energy");
}

TEST(Diagnosis, NamesTheParticleAndTheTermThatActsMost) {
  Evidence e = sound_run();
  e.particle.id = 17;
  e.particle.x = {{0.1, 0.2, 0}};
  e.particle.forces = {{"pressure (wall)", 1e5}, {"gravity", 9.81}};
  const std::string text = diagnosis_text(diagnose(e), e);
  EXPECT_THAT(text, HasSubstr("the density of particle 17 is beyond bounds at t = 0.1 s (step 400"));
  EXPECT_THAT(text, HasSubstr("x = (0.1, 0.2) m"));
  EXPECT_THAT(text, HasSubstr("largest: pressure (wall)"));
  const Json json = diagnosis_json(diagnose(e), e);
  EXPECT_EQ(json["alarm"], "density");
  EXPECT_EQ(json["particle"]["id"], 17);
  EXPECT_EQ(json["terms"][0]["term"], "pressure (wall)");
}

}  // namespace
}  // namespace undine
