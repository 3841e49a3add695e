#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "undine/engine/plan.hpp"
#include "undine/engine/update.hpp"
#include "undine/schemes/energies.hpp"
#include "undine/schemes/ghosts.hpp"
#include "undine/schemes/weakly_compressible_options.hpp"
#include "undine/schemes/weakly_compressible_sweeps.hpp"

namespace undine {

/// A weakly compressible liquid with its walls: state, rates, and the moves that integrators are made of
/// (integrators/euler.hpp lists them). Throws RunError when a value is no longer finite or a particle left the domain.
template <int N>
class WeaklyCompressible {
 public:
  using Options = WeaklyCompressibleOptions<N>;

  /// Takes the particles as set up (x, v, rho, m, h, rho_0, mu of fluid and wall) and evaluates their rates. With the
  /// `memory` of an earlier run it goes on with the same bits: the store must then be as it was, every field in its
  /// order.
  WeaklyCompressible(Store<N> store, const Domain<N>& domain, Options options, const std::vector<double>& memory = {});
  WeaklyCompressible(const WeaklyCompressible&) = delete;
  WeaklyCompressible& operator=(const WeaklyCompressible&) = delete;

  // Moves.
  void drift(double dt);
  void kick(double dt);
  void compress(double dt);
  void continuity();
  void predict_kick(double dt);
  void correct_kick(double dt);
  void smooth();
  void save();
  void restore();
  void evaluate();
  void book(double dt);

  /// The largest step that the limits allow for the rates at hand, and which limit it was.
  Step stable_step(const StepLimits& limits) const;

  Energies energies() const;
  /// Force on the walls' particles from the fluid, field acc of the wall group (m/s^2, times m gives N). Changes no
  /// state.
  void evaluate_wall_forces();

  /// What a checkpoint must keep besides the store: time, ledger, powers, the support at the last list build.
  std::vector<double> memory() const;

  const Store<N>& store() const { return store_; }
  Store<N>& store() { return store_; }
  const Domain<N>& domain() const { return domain_; }
  const Options& options() const { return options_; }
  const Neighbours<N>& neighbours() const { return neighbours_; }
  double support() const { return support_now_; }
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

 private:
  using Sweeps = WeaklyCompressibleSweeps<N>;

  void configure();
  void make_plan();
  void add_density_stages();
  void add_wall_stages();
  void add_inertia_stage();
  void add_mirror_stage();
  void add_push_stages();
  void add_strain_stage();
  void move_walls();
  void push_from_walls(double dt);
  /// Whether walls hold the fluid by a friction of their own.
  bool holds() const { return options_.wall_no_slip && options_.viscosity; }
  /// Whether walls accelerate fluid through `acc_wall`.
  bool pushes() const { return options_.repulsion || holds(); }
  template <class Self, class F>
  static void for_each_booked_power(Self& self, F&& f);
  template <class Sweep>
  void add_sweep(Sweep& sweep, bool from_walls);
  template <class Update>
  void add_update(std::string name, Group group, const Update& rule);
  template <class Sweep>
  void run(Sweep& sweep);
  SweepContext<N> context();
  struct SweepNote {
    std::string name;
    std::function<SweepPath()> path;
    std::function<std::string()> unusual;
  };
  void refresh_lists();
  void check_particles();
  void check_support() const;
  void place_surfaces(double t) const;
  double largest_support() const;
  /// What every sweep reads of its particles.
  FieldSet place() const { return options_.rho_law ? Fields<field::x, field::h>::set() : Fields<field::x>::set(); }
  Vec<N> gravity_of_ghosts() const { return options_.ghost_hydrostatic ? options_.gravity : Vec<N>{}; }
  /// A summed density leaves nothing for diffusion to change.
  bool diffuses() const { return options_.diffusion && options_.density == DensityForm::evolved; }
  bool renormalises() const {
    return diffuses() && options_.diffusion->index() == terms::DiffusionForms::index<terms::DiffusionAntuono>();
  }
  void recall(const std::vector<double>& numbers);

  Store<N> store_;
  Domain<N> domain_;
  Options options_;
  Neighbours<N> neighbours_;
  std::optional<Ghosts<N>> ghosts_;
  Plan plan_;
  std::vector<SweepNote> sweeps_;
  double support_now_ = 0;
  double body_power_ = 0;  ///< of the imposed force at the last evaluation, W
  double time_ = 0, time_start_ = 0;
  double step_end_ = 0;  ///< when the last step ended, s
  Vec<N> potential_origin_{};
  Energies::Ledger ledger_, ledger_start_;
  double strain_power_ = 0, strain_dissipated_ = 0;
  long list_builds_ = 0, escaped_ = 0;
  double seconds_lists_ = 0, seconds_sweeps_ = 0;

  typename Sweeps::Force force_{"force", Group::fluid, Booking::on};
  typename Sweeps::Continuity continuity_{"continuity", Group::fluid};
  typename Sweeps::Continuity wall_continuity_{"wall continuity", Group::wall};
  typename Sweeps::Summation summation_{"summation", Group::fluid};
  typename Sweeps::Shepard shepard_{"shepard sum", Group::fluid};
  typename Sweeps::Summation wall_summation_{"wall summation", Group::wall};
  typename Sweeps::WallPressure wall_pressure_{"wall pressure", Group::wall};
  typename Sweeps::WallAnswer wall_answer_{"wall answer sums", Group::wall};
  typename Sweeps::WallPush push_{"wall push", Group::fluid, Booking::on};
  typename Sweeps::WallPush pushed_back_{"push on walls", Group::wall};
  typename Sweeps::Gradient gradient_{"density gradient", Group::fluid};
  typename Sweeps::Strain strain_{"velocity gradient", Group::fluid};
  typename Sweeps::WallForce wall_force_{"wall force", Group::wall};
};

extern template class WeaklyCompressible<1>;
extern template class WeaklyCompressible<2>;
extern template class WeaklyCompressible<3>;

}  // namespace undine
