#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "undine/core/stopwatch.hpp"
#include "undine/engine/interpolate.hpp"
#include "undine/engine/pair_sweep.hpp"
#include "undine/engine/plan.hpp"
#include "undine/engine/update.hpp"
#include "undine/integrators/step_control.hpp"
#include "undine/schemes/by_id.hpp"
#include "undine/schemes/energies.hpp"
#include "undine/schemes/flow_options.hpp"
#include "undine/schemes/ghosts.hpp"

namespace undine {

/// Says of a flow that its rates are to be evaluated later, by `start`: who would look at what that finds wrong then
/// has the flow to look at.
struct Unstarted {};
inline constexpr Unstarted unstarted;

/// What flows of any kind have: particles with their lists and plan, walls that move, and the moves that integrators
/// are made of (integrators/euler.hpp lists them). A scheme says which stages give the rates, what else is kicked, and
/// where the energy goes. Moves throw RunError when a value is no longer finite or a particle left the domain.
template <int N>
class Flow {
 public:
  virtual ~Flow() = default;
  Flow(const Flow&) = delete;
  Flow& operator=(const Flow&) = delete;

  /// Evaluates the rates of the particles as set up, or goes on from the `memory` of an earlier run. Once, before any
  /// move; constructors that are not told `unstarted` have done it.
  void start(const std::vector<double>& memory = {});

  // Moves.
  void drift(double dt);
  virtual void kick(double dt);
  virtual void compress(double dt) = 0;
  virtual void continuity() = 0;
  virtual void predict_kick(double dt);
  virtual void correct_kick(double dt);
  virtual void smooth();
  virtual void save();
  virtual void restore();
  void evaluate();
  virtual void book(double dt) = 0;

  // Moves of Runge-Kutta integrators (integrators/runge_kutta.hpp lists them).
  void start_stages(int slopes);
  void take_slope(int k);
  void stage(std::span<const double> weights);
  void finish(std::span<const double> weights);
  double stage_error(std::span<const double> weights) const;
  void reject();
  integrators::StepControl& step_control() { return control_; }

  /// The largest step that the limits allow for the rates at hand, and which limit it was.
  virtual Step stable_step(const StepLimits& limits) const = 0;

  virtual Energies energies() const = 0;
  /// Force on the walls' particles from the fluid, field acc of the wall group (m/s^2, times m gives N). Changes no
  /// state.
  virtual void evaluate_wall_forces() = 0;

  /// What a checkpoint must keep besides the store: time, ledger, powers, the support at the last list build.
  std::vector<double> memory() const;

  const Store<N>& store() const { return store_; }
  Store<N>& store() { return store_; }
  const Domain<N>& domain() const { return domain_; }
  const FlowOptions<N>& options() const { return *common_; }
  const Neighbours<N>& neighbours() const { return neighbours_; }
  double support() const { return support_now_; }
  /// What sweeps must know to run on such particles and their lists with the choices of this flow.
  SweepContext<N> context(Store<N>& store, const Neighbours<N>& neighbours) const;
  /// The fields between the particles, for as long as the flow is there.
  InterpolationSource<N> interpolation_source() const;
  double time() const { return time_; }
  const Plan& plan() const { return plan_; }
  long list_builds() const { return list_builds_; }
  /// Fluid particles that left the domain and were taken out.
  long escaped() const { return escaped_; }
  /// The sweeps of an evaluation by the loop that they run on, and why not on the usual one, for people.
  std::string describe_sweeps() const;
  /// Seconds spent: neighbour lists, pair sweeps.
  double seconds_lists() const { return seconds_lists_; }
  double seconds_sweeps() const { return seconds_sweeps_; }
  /// Lowest potential energy level: E_pot counts from here, m (along the direction against gravity).
  void set_potential_origin(const Vec<N>& x) { potential_origin_ = x; }
  const Vec<N>& potential_origin() const { return potential_origin_; }

 protected:
  /// A field that is integrated in time and the fields whose sum is its rate; and what a Runge-Kutta step keeps of
  /// both.
  struct Evolved {
    // Without it g++ 12 breaks down over the initialisers of the last two members.
    Evolved(Group of, int what, std::vector<int> by) : group(of), field(what), rates(std::move(by)) {}

    Group group;
    int field;
    std::vector<int> rates;
    ById<N> start;
    std::vector<std::vector<ById<N>>> slopes;  ///< by stage, then by rate
  };

  Flow(Store<N> store, const Domain<N>& domain, std::shared_ptr<const FlowOptions<N>> options);

  // What a scheme says.
  /// Updates before the lists are looked at, which must reach as far as the largest support.
  virtual void prepare() {}
  /// Added to the velocity that moves particles, m/s; empty: nothing.
  virtual std::span<const Vec<N>> drift_correction() const { return {}; }
  /// What is integrated in time; position first.
  virtual std::vector<Evolved> evolved() const;
  /// Which density gives wall particles their volume.
  virtual WallVolume wall_volume() const { return WallVolume::at_rest; }
  /// Keeps the state within bounds after a stage.
  virtual void limit_state() {}
  /// Numbers that rates left behind and `book` needs, and accounts: what a checkpoint keeps besides time and lists.
  virtual std::vector<double*> remembered() = 0;
  std::vector<double*> accounts();
  /// Appends the powers that a sweep booked.
  template <class Sweep>
  static void remember_powers(Sweep& sweep, std::vector<double*>& numbers) {
    const auto one = [&](Power& power) {
      for (double& number : power) numbers.push_back(&number);
    };
    std::apply([&](auto&... use) { (one(use.power), ...); }, sweep.uses());
  }
  /// Kinetic and potential energy, and the accounts; what compression stored is left to the scheme.
  Energies energies_of_motion() const;

  // Making the plan.
  template <class Sweep>
  void add_sweep(Sweep& sweep, bool from_walls) {
    Resources reads(Group::fluid, sweep.reads() | place());
    if (from_walls) reads.add(Group::wall, sweep.reads() | place());
    reads.add(sweep.target(), sweep.target_reads() | place());
    plan_.add({sweep.name(), reads, Resources(sweep.target(), sweep.adds()), [this, &sweep] { run(sweep); }});
    sweeps_.push_back({sweep.name(), [this, &sweep] { return sweep.path(context(), common_->backend); },
                       [this, &sweep] { return sweep.unusual(context(), common_->backend); }});
  }
  template <class Update>
  void add_update(std::string name, Group group, const Update& rule) {
    plan_.add({std::move(name), Resources(group, Update::reads::set()), Resources(group, Update::writes::set()),
               [this, group, rule] { update(store_, group, rule); }});
  }
  /// The density as a sum, where it is one; `walls` take part in it.
  void add_summation_stages(DensityForm form, bool walls);
  /// Gravity, imposed forces and, where walls push, `acc_wall`, all added to the acceleration.
  void add_body_force_stage(bool walls_push);
  struct PlanFields {
    FieldSet given;     ///< exist in every group before the first stage
    FieldSet used;      ///< besides what stages read and write
    FieldSet kept;      ///< of integrators
    Resources at_rest;  ///< zero where nothing writes them
  };
  /// Allocates what the stages use, and puts them into order.
  void finish_plan(const PlanFields& fields);

  /// Runs a sweep, for the targets that are `wanted` if not for all.
  template <class Sweep>
  void run(Sweep& sweep, std::span<const char> wanted = {}) {
    const Stopwatch watch(seconds_sweeps_);
    auto all = context();
    all.wanted = wanted;
    sweep.run(all, common_->backend);
  }
  SweepContext<N> context() { return context(store_, neighbours_); }
  void refresh_lists();
  /// What every sweep reads of its particles.
  FieldSet place() const {
    return common_->supports_vary() ? Fields<field::x, field::h>::set() : Fields<field::x>::set();
  }
  /// The end of the last step, s.
  double step_end() const { return step_end_; }
  Vec<N> gravity_of_ghosts() const { return common_->ghost_hydrostatic ? common_->gravity : Vec<N>{}; }

  Store<N> store_;
  Domain<N> domain_;
  Neighbours<N> neighbours_;
  std::optional<Ghosts<N>> ghosts_;
  Plan plan_;
  double body_power_ = 0;  ///< of the imposed force at the last evaluation, W
  double time_ = 0;
  Energies::Ledger ledger_;

 private:
  struct SweepNote {
    std::string name;
    std::function<SweepPath()> path;
    std::function<std::string()> unusual;
  };
  void check_particles();
  void check_support() const;
  void place_surfaces(double t) const;
  void move_walls();
  void push_from_walls(double dt);
  void filter_density();
  double largest_support() const;
  Vec<N> change(const Evolved& state, std::size_t r, std::int64_t id, std::span<const double> weights) const;
  /// The state of a stage; what XSPH did against gravity on the way, J.
  double take_stage(std::span<const double> weights);
  void recall(const std::vector<double>& numbers);

  std::shared_ptr<const FlowOptions<N>> common_;
  PairSweep<N, Use<terms::Summation>> summation_{"summation", Group::fluid};
  PairSweep<N, Use<terms::Summation>> fluid_summation_{"summation over the fluid", Group::fluid};
  PairSweep<N, Use<terms::ShepardSum>> shepard_{"shepard sum", Group::fluid};
  std::vector<SweepNote> sweeps_;
  Vec<N> potential_origin_{};
  double support_now_ = 0;
  double time_start_ = 0;
  double step_end_ = 0;  ///< when the last step ended, s
  double steps_since_filter_ = 0;
  Energies::Ledger ledger_start_;
  std::vector<Evolved> stages_;
  integrators::StepControl control_;
  long list_builds_ = 0, escaped_ = 0;
  double seconds_lists_ = 0, seconds_sweeps_ = 0;
};

extern template class Flow<1>;
extern template class Flow<2>;
extern template class Flow<3>;

}  // namespace undine
