#pragma once
#include <memory>
#include <vector>

#include "undine/schemes/by_id.hpp"
#include "undine/schemes/flow.hpp"
#include "undine/schemes/gas_options.hpp"
#include "undine/schemes/gas_sweeps.hpp"
#include "undine/schemes/weakly_compressible_sweeps.hpp"

namespace undine {

/// A compressible gas with its internal energy e, which is kicked like the velocity. Energy has two accounts in the
/// particles, kinetic and internal; pressure, viscosity and conductivity move it between them.
template <int N>
class Gas : public Flow<N> {
 public:
  using Options = GasOptions<N>;

  /// Takes the particles as set up (x, v, rho, e, m, h, alpha_v, and rho_0 or mu where something asks for them) and
  /// evaluates their rates. With the `memory` of an earlier run it goes on with the same bits.
  Gas(Store<N> store, const Domain<N>& domain, Options options, const std::vector<double>& memory = {});
  /// The same without rates: `start` is still to come.
  Gas(Store<N> store, const Domain<N>& domain, Options options, Unstarted);

  void kick(double dt) override;
  void compress(double dt) override;
  void continuity() override;
  void predict_kick(double dt) override;
  void correct_kick(double dt) override;
  void smooth() override;
  void save() override;
  void restore() override;
  void book(double dt) override;
  Step stable_step(const StepLimits& limits) const override;
  Energies energies() const override;
  void evaluate_wall_forces() override;

  const Options& options() const { return options_; }
  /// The sweeps that accelerate the gas, as they are set.
  const typename GasSweeps<N>::Force& force_sweep() const { return force_; }
  const typename WeaklyCompressibleSweeps<N>::WallPush& push_sweep() const { return push_; }

 private:
  using Flow<N>::store_;
  using Flow<N>::ghosts_;
  using Flow<N>::plan_;
  using Flow<N>::body_power_;
  using Flow<N>::time_;
  using Flow<N>::ledger_;
  using Sweeps = GasSweeps<N>;
  using Shared = WeaklyCompressibleSweeps<N>;

  /// Of each particle on the way to its H: what is known to hold the solution, and whether it is still to be found.
  struct SupportSearch {
    std::vector<Vec<2>> brackets;
    std::vector<char> open;
  };

  Gas(Store<N> store, const Domain<N>& domain, std::shared_ptr<const Options> options);
  void prepare() override;
  std::vector<double*> remembered() override;
  WallVolume wall_volume() const override { return WallVolume::present; }
  std::vector<typename Flow<N>::Evolved> evolved() const override;
  void configure();
  void make_plan();
  void add_density_stages();
  void add_gradient_stages();
  void add_ghost_stage(const char* name, const FieldSet& fields);
  void foresee_supports(double dt);
  void find_supports();
  bool adapt_supports(SupportSearch& search);
  [[noreturn]] void no_support_found() const;
  void check_state() const;
  /// Whether walls are neighbours of the gas, beyond what they push.
  bool answered() const { return mirrored_ || held_; }

  const Options& options_;
  bool mirrored_ = false;  ///< whether ghosts answer for the fluid
  bool held_ = false;      ///< whether wall particles answer with a state that they keep
  ById<N> de_before_, e_start_, h_start_;

  typename Sweeps::Density density_{"density sum", Group::fluid};
  typename Sweeps::Rate rate_{"continuity", Group::fluid};
  typename Sweeps::Force force_{"force", Group::fluid, Booking::on};
  typename Sweeps::Foresight foresight_{"divergence of acceleration", Group::fluid};
  typename Sweeps::Force wall_force_{"wall force", Group::wall};
  typename Shared::Strain gradient_{"velocity gradient", Group::fluid};
  typename Shared::WallPush push_{"wall push", Group::fluid, Booking::on};
  typename Shared::WallPush pushed_back_{"push on walls", Group::wall};
};

extern template class Gas<1>;
extern template class Gas<2>;
extern template class Gas<3>;

}  // namespace undine
