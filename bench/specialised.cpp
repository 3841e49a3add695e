// What do choices cost? The force pass of the engine, every option chosen at run time, against a loop written by hand
// for one scheme, on the same particles and lists, in one process, by turns. Prints nanoseconds per particle, medians
// of the rounds, and their ratio; exits with 1 where the two do not agree.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <omp.h>

#include "specialised_loop.hpp"
#include "undine/app/bench/measure.hpp"
#include "undine/app/bench/states.hpp"

namespace specialised {
namespace {

using namespace undine;

constexpr double tolerance = 1e-5;
/// For density diffusion: where the engine rounds densities, and not their differences, to float.
constexpr double tolerance_diffusion = 1e-4;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The lists of the fluid as the engine has them now; `whole_rows`: filled up with the target itself.
Lists copied_lists(const WeaklyCompressible<3>& flow, bool whole_rows) {
  Lists lists;
  std::vector<std::uint32_t> scratch;
  const std::size_t n = flow.store().range(Group::fluid).size();
  for (std::size_t a = 0; a < n; ++a) {
    const auto list = flow.neighbours().of(Group::fluid, a, Group::fluid, flow.store(), scratch);
    lists.indices.insert(lists.indices.end(), list.begin(), list.end());
    while (whole_rows && lists.indices.size() % lanes != 0) lists.indices.push_back(static_cast<std::uint32_t>(a));
    lists.starts.push_back(static_cast<std::uint32_t>(lists.indices.size()));
  }
  return lists;
}

Constants constants_of(const WeaklyCompressible<3>& flow) {
  const auto& options = flow.options();
  const auto& eos = std::get<materials::TaitSoundSpeed>(options.materials[0].eos);
  Constants k;
  k.unit = flow.neighbours().list_radius() * 0x1p-24;
  k.H = static_cast<float>(flow.support());
  k.mass = static_cast<float>(flow.store().get<field::m>()[0]);
  k.rho_0 = static_cast<float>(eos.rho_0);
  k.c_0 = static_cast<float>(eos.c_0);
  k.alpha = static_cast<float>(options.artificial->get<terms::ViscosityMonaghan>().alpha);
  k.delta = static_cast<float>(options.diffusion->get<terms::DiffusionFourtakas>().delta);
  k.epsilon = static_cast<float>(options.xsph->get<terms::Xsph>().epsilon);
  k.gravity = static_cast<float>(options.gravity[2]);
  return k;
}

/// Largest difference relative to the largest value.
double disagreement(std::span<const double> values, std::span<const double> expected) {
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    largest = std::max(largest, std::abs(expected[i]));
    difference = std::max(difference, std::abs(values[i] - expected[i]));
  }
  return difference / largest;
}

/// One loop by hand, timed and compared.
class Contender {
 public:
  virtual ~Contender() = default;
  virtual void run(const Store<3>& store) = 0;
  virtual bool books() const = 0;

  const char* name = "";
  Results results;
  std::vector<double> seconds, seconds_packing;  ///< of each round; packing is part of the first
};

template <Traits traits>
class ContenderOf : public Contender {
 public:
  ContenderOf(const char* its_name, const WeaklyCompressible<3>& flow)
      : constants_(constants_of(flow)), loop_(constants_), lists_(copied_lists(flow, traits.whole_rows)) {
    name = its_name;
    const std::size_t n = flow.store().size();
    for (auto* vectors : {&results.acc, &results.v_xsph}) vectors->resize(3 * n);
    for (auto* scalars : {&results.drho, &results.drho_diff, &results.mu_cfl}) scalars->resize(n);
  }
  void run(const Store<3>& store) override {
    const double start = seconds_now();
    pack<traits>(store, constants_, records_);
    seconds_packing.push_back(seconds_now() - start);
    loop_.run(records_, lists_, store, results);
    seconds.push_back(seconds_now() - start);
  }
  bool books() const override { return traits.books; }

 private:
  Constants constants_;
  Loop<traits> loop_;
  Lists lists_;
  std::vector<float> records_;
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Prints the largest differences; whether they are small enough.
bool agrees(const Contender& hand, WeaklyCompressible<3>& flow) {
  const Store<3>& store = flow.store();
  const auto of = [&](int f, const std::vector<double>& values) { return disagreement(values, store.raw(f)); };
  const double differences[] = {of(FieldId::acc, hand.results.acc), of(FieldId::drho, hand.results.drho),
                                of(FieldId::drho_diff, hand.results.drho_diff),
                                of(FieldId::v_xsph, hand.results.v_xsph), of(FieldId::mu_cfl, hand.results.mu_cfl)};
  fmt::print("  {:<42} acc {:.1e}, drho {:.1e}, drho_diff {:.1e}, v_xsph {:.1e}, mu_cfl {:.1e}", hand.name,
             differences[0], differences[1], differences[2], differences[3], differences[4]);
  bool good = true;
  for (int k = 0; k < 5; ++k) good = good && differences[k] <= (k == 2 ? tolerance_diffusion : tolerance);
  if (hand.books()) {
    // Powers: booking for one second makes them the change of the ledger.
    const auto before = flow.energies().ledger;
    flow.book(1);
    const auto after = flow.energies().ledger;
    const double scale = std::abs(hand.results.pressure) + std::abs(hand.results.artificial);
    const double power =
        std::max({std::abs(after.artificial - before.artificial + hand.results.artificial),
                  std::abs(after.diffusion - before.diffusion + hand.results.diffusion),
                  std::abs(after.exchange - before.exchange + hand.results.pressure + hand.results.compression)}) /
        scale;
    fmt::print(", power {:.1e}", power);
    good = good && power <= tolerance;
  }
  fmt::print("\n");
  return good;
}

int compare(const BenchStateOptions& what, int threads, int rounds) {
  omp_set_num_threads(threads);
  BenchSubject subject(make_bench_state(what));
  WeaklyCompressible<3>& flow = subject.flow();
  ContenderOf<Traits{12, true, false}> same("by hand, same work", flow);
  ContenderOf<Traits{12, false, false}> bare("by hand, without booking", flow);
  ContenderOf<Traits{8, true, true}> least("by hand, records of 8, lists in whole rows", flow);
  Contender* const hands[] = {&same, &bare, &least};

  std::vector<double> engine;
  for (int round = -1; round < rounds; ++round) {  // the first only warms up
    const double start = seconds_now();
    run_force_pass(flow);
    engine.push_back(seconds_now() - start);
    for (Contender* hand : hands) hand->run(flow.store());
    if (round >= 0) continue;
    engine.clear();
    for (Contender* hand : hands) {
      hand->seconds.clear();
      hand->seconds_packing.clear();
    }
  }

  const double ns = 1e9 / subject.fluid();
  fmt::print("{:.0f} particles, {:.1f} neighbours, {} thread(s), medians of {} rounds (fastest)\n", subject.fluid(),
             subject.pairs().mean, threads, rounds);
  const auto line = [&](const char* name, const std::vector<double>& seconds) {
    fmt::print("  {:<42} {:6.1f} ({:.1f}) ns per particle", name, ns * median(seconds),
               ns * *std::ranges::min_element(seconds));
  };
  line("engine", engine);
  fmt::print("\n");
  for (const Contender* hand : hands) {
    line(hand->name, hand->seconds);
    std::vector<double> ratios;
    for (std::size_t k = 0; k < engine.size(); ++k) ratios.push_back(engine[k] / hand->seconds[k]);
    fmt::print(" ({:.1f} packing), engine takes {:.3f} times as long\n", ns * median(hand->seconds_packing),
               median(ratios));
  }
  fmt::print("largest differences from the engine, relative to the largest value:\n");
  bool good = true;
  for (const Contender* hand : hands) good = agrees(*hand, flow) && good;
  if (!good)
    fmt::print(stderr, "error: the loops do not agree to {:g} ({:g} for diffusion)\n", tolerance, tolerance_diffusion);
  return good ? 0 : 1;
}

}  // namespace
}  // namespace specialised

int main(int argc, char** argv) {
  CLI::App app{"The engine's force pass against one written by hand"};
  int particles = 100000, neighbours = 74, threads = 1, rounds = 15;
  app.add_option("--particles", particles, "about how many")->check(CLI::Range(1000, 10000000));
  app.add_option("--neighbours", neighbours, "74 is H = 2.6 dp, 174 is 3.46 dp")->check(CLI::Range(10, 2000));
  app.add_option("--threads", threads, "of both")->check(CLI::Range(1, 1024));
  app.add_option("--rounds", rounds, "by turns")->check(CLI::Range(1, 100000));
  CLI11_PARSE(app, argc, argv);
  undine::BenchStateOptions what;
  what.particles = particles;
  what.support_over_spacing = undine::support_for(neighbours);
  return specialised::compare(what, threads, rounds);
}
