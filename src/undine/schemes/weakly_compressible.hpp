#pragma once
#include <memory>
#include <vector>

#include "undine/schemes/consistent_sweeps.hpp"
#include "undine/schemes/flow.hpp"
#include "undine/schemes/weakly_compressible_options.hpp"
#include "undine/schemes/weakly_compressible_sweeps.hpp"

namespace undine {

/// A weakly compressible liquid with its walls.
template <int N>
class WeaklyCompressible : public Flow<N> {
 public:
  using Options = WeaklyCompressibleOptions<N>;

  /// Takes the particles as set up (x, v, rho, m, h, rho_0, mu of fluid and wall) and evaluates their rates. With the
  /// `memory` of an earlier run it goes on with the same bits: the store must then be as it was, every field in its
  /// order.
  WeaklyCompressible(Store<N> store, const Domain<N>& domain, Options options, const std::vector<double>& memory = {});
  /// The same without rates: `start` is still to come.
  WeaklyCompressible(Store<N> store, const Domain<N>& domain, Options options, Unstarted);

  void compress(double dt) override;
  void continuity() override;
  void smooth() override;
  void book(double dt) override;
  Step stable_step(const StepLimits& limits) const override;
  Energies energies() const override;
  void evaluate_wall_forces() override;

  const Options& options() const { return options_; }
  /// Sweeps that accelerate the fluid, as they are set: where gradients are corrected or particles shifted, and at
  /// walls that push.
  const typename ConsistentSweeps<N>::Force& consistent_force_sweep() const { return consistent_force_; }
  const typename WeaklyCompressibleSweeps<N>::WallPush& push_sweep() const { return push_; }

 private:
  using Flow<N>::store_;
  using Flow<N>::domain_;
  using Flow<N>::neighbours_;
  using Flow<N>::ghosts_;
  using Flow<N>::plan_;
  using Flow<N>::body_power_;
  using Flow<N>::time_;
  using Flow<N>::ledger_;
  using Sweeps = WeaklyCompressibleSweeps<N>;
  using Consistent = ConsistentSweeps<N>;

  WeaklyCompressible(Store<N> store, const Domain<N>& domain, std::shared_ptr<const Options> options);
  void prepare() override;
  std::span<const Vec<N>> drift_correction() const override;
  std::vector<double*> remembered() override;
  std::vector<typename Flow<N>::Evolved> evolved() const override;
  void limit_state() override;
  void configure();
  void configure_consistent();
  void make_plan();
  void add_wall_stages();
  void add_inertia_stage();
  void add_mirror_stage();
  void add_push_stages();
  void add_strain_stage();
  void add_consistent_stages();
  template <class Force>
  void book_force(const Force& force, double dt);
  /// Whether walls hold the fluid by a friction of their own.
  bool holds() const { return options_.wall_no_slip && options_.viscosity; }
  /// Whether walls accelerate fluid through `acc_wall`, in a sweep of their own.
  bool pushes() const { return !options_.consistent() && (options_.repulsion || holds()); }
  /// Whether viscosity acts between fluid and walls in the sweep of ConsistentSweeps.
  bool rubs() const {
    return options_.consistent() && options_.wall_density != walls::WallDensity::none && options_.wall_friction &&
           options_.viscosity;
  }
  /// A summed density leaves nothing for diffusion to change.
  bool diffuses() const { return options_.diffusion && options_.density == DensityForm::evolved; }
  bool renormalises() const {
    return diffuses() && options_.diffusion->index() == terms::DiffusionForms::index<terms::DiffusionAntuono>();
  }

  const Options& options_;
  double strain_power_ = 0, strain_dissipated_ = 0;

  typename Sweeps::Force force_{"force", Group::fluid, Booking::on};
  typename Sweeps::Continuity continuity_{"continuity", Group::fluid};
  typename Sweeps::Continuity wall_continuity_{"wall continuity", Group::wall};
  typename Sweeps::Summation wall_summation_{"wall summation", Group::wall};
  typename Sweeps::WallPressure wall_pressure_{"wall pressure", Group::wall};
  typename Sweeps::WallAnswer wall_answer_{"wall answer sums", Group::wall};
  typename Sweeps::WallPush push_{"wall push", Group::fluid, Booking::on};
  typename Sweeps::WallPush pushed_back_{"push on walls", Group::wall};
  typename Sweeps::Gradient gradient_{"density gradient", Group::fluid};
  typename Sweeps::Strain strain_{"velocity gradient", Group::fluid};
  typename Sweeps::WallForce wall_force_{"wall force", Group::wall};
  typename Consistent::Force consistent_force_{"force", Group::fluid, Booking::on};
  typename Consistent::Continuity consistent_continuity_{"continuity", Group::fluid};
  typename Consistent::Shift shift_{"shift", Group::fluid};
};

extern template class WeaklyCompressible<1>;
extern template class WeaklyCompressible<2>;
extern template class WeaklyCompressible<3>;

}  // namespace undine
