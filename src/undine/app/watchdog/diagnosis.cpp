#include "undine/app/watchdog/diagnosis.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "undine/app/watchdog/causes/catalogue.hpp"

namespace undine {
namespace {

std::string vector_text(const Vec3& a, int dimensions) {
  std::string text;
  for (int k = 0; k < dimensions; ++k) text += fmt::format("{}{:.6g}", k ? ", " : "", a[k]);
  return "(" + text + ")";
}

std::string forces_text(const std::vector<ForceShare>& forces) {
  std::string text;
  for (const ForceShare& share : forces)
    text += fmt::format("{}{} {:.4g}", text.empty() ? "" : ", ", share.term, share.size);
  return text + " m/s^2";
}

Json vector_json(const Vec3& a, int dimensions) {
  Json array = Json::array();
  for (int k = 0; k < dimensions; ++k) array.push_back(a[k]);
  return array;
}

}  // namespace

double Evidence::natural_speed() const {
  const double thrown = causes::WildParticle::holds(*this) ? start.typical_speed : start.fastest;
  // Gas expands into a void with 2 c/(gamma - 1), which is what twice c and the factors of those who ask allow for.
  return std::max({std::sqrt(2 * setup.gravity * setup.depth), thrown, before.fastest_wall, 2 * start.sound});
}

Diagnosis diagnose(const Evidence& evidence) {
  Diagnosis diagnosis{.cause = "unknown",
                      .title = "No known cause fits",
                      .because = "none of the tests of `undine list causes` holds",
                      .remedy =
                          "take a smaller step (time.courant = 0.2), a larger speed of sound, or more artificial "
                          "viscosity; look at the steps in 'window'",
                      .also = {}};
  bool found = false;
  causes::Causes::for_each([&]<class Cause>(Cause) {
    if (!Cause::holds(evidence)) return;
    if (found) {
      diagnosis.also.emplace_back(Cause::info.name);
      return;
    }
    found = true;
    diagnosis.cause = Cause::info.name;
    diagnosis.title = Cause::info.title;
    diagnosis.because = Cause::because(evidence);
    diagnosis.remedy = Cause::remedy(evidence);
  });
  return diagnosis;
}

std::string describe_alarm(const Evidence& e) {
  const auto& a = e.particle;
  const std::string who = a.id >= 0 ? fmt::format("particle {}", a.id) : "the run";
  const std::string when = fmt::format("at t = {:.6g} s", e.time);
  switch (e.alarm) {
    case Alarm::not_finite:
      return fmt::format("{} is no longer finite {}", who, when);
    case Alarm::outside:
      return fmt::format("{} left the domain {}", who, when);
    case Alarm::step_collapse:
      return fmt::format("the time step collapsed to {:.3g} s {}", e.dt, when);
    case Alarm::density:
      return fmt::format("the density of {} is beyond bounds {}", who, when);
    case Alarm::coincidence:
      return fmt::format("particles lie on each other {}; {} is the closest to another one", when, who);
    case Alarm::residual:
      return fmt::format("the residual of the energy audit jumped {}", when);
    case Alarm::energy:
      return fmt::format("{} has no internal energy or density above zero left {}", who, when);
    case Alarm::support:
      return fmt::format("no support radius serves {} {}", who, when);
    case Alarm::isolated:
      return fmt::format("particles have no neighbours within their support {}", when);
  }
  return "the run went bad " + when;
}

std::string diagnosis_text(const Diagnosis& d, const Evidence& e) {
  const auto& a = e.particle;
  const int n = e.setup.dimensions;
  std::string text = fmt::format("what      {} (step {}, dt {:.4g} s)\n", describe_alarm(e), e.step, e.dt);
  if (a.id >= 0) {
    text += fmt::format("particle  {} at x = {} m, v = {} m/s, acceleration {} m/s^2\n", a.id, vector_text(a.x, n),
                        vector_text(a.v, n), vector_text(a.acc, n));
    text += fmt::format("state     rho = {:.6g} kg/m^3 ({}), p = {:.6g} Pa, c = {:.4g} m/s\n", a.rho,
                        e.setup.gas ? fmt::format("e = {:.6g} J/kg, H = {:.4g} m", a.e, a.support)
                                    : fmt::format("rho_0 = {:.6g}", a.rho_0),
                        a.p, a.c);
    if (!a.forces.empty())
      text += fmt::format("terms     largest: {}; {}\n", a.forces.front().term, forces_text(a.forces));
  }
  text += fmt::format("cause     {}: {}\n", d.cause, d.title);
  text += fmt::format("because   {}\n", d.because);
  text += fmt::format("remedy    {}\n", d.remedy);
  if (!d.also.empty()) text += fmt::format("or        {}\n", fmt::join(d.also, ", "));
  return text;
}

Json diagnosis_json(const Diagnosis& d, const Evidence& e) {
  const auto& a = e.particle;
  const int n = e.setup.dimensions;
  Json json{{"alarm", alarm_names[static_cast<std::size_t>(e.alarm)]},
            {"what", describe_alarm(e)},
            {"cause", d.cause},
            {"title", d.title},
            {"because", d.because},
            {"remedy", d.remedy},
            {"also", d.also},
            {"time", e.time},
            {"step", e.step},
            {"dt", e.dt}};
  if (a.id >= 0) {
    Json forces = Json::array();
    for (const ForceShare& share : a.forces) forces.push_back({{"term", share.term}, {"acceleration", share.size}});
    json["particle"] = {{"id", a.id},
                        {"x", vector_json(a.x, n)},
                        {"v", vector_json(a.v, n)},
                        {"acceleration", vector_json(a.acc, n)},
                        {"rho", a.rho},
                        {"rho_0", a.rho_0},
                        {"p", a.p},
                        {"c", a.c}};
    if (e.setup.gas) json["particle"].update({{"e", a.e}, {"support", a.support}});
    json["terms"] = forces;
  }
  return json;
}

}  // namespace undine
