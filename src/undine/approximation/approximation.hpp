#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "undine/approximation/neighbourhood.hpp"
#include "undine/approximation/stencil.hpp"
#include "undine/kernels/kernel.hpp"
#include "undine/search/search.hpp"

namespace undine::approximation {

/// Scattered points that fields are known at.
template <int N>
struct Points {
  std::vector<Vec<N>> x;            ///< m
  std::vector<double> volume = {};  ///< m/rho, m^N; may be empty for methods that need none
};

struct Options {
  std::string method = "mls";     ///< a name of `Methods`
  std::optional<int> order = {};  ///< of the method; unless given 1, or what is nearest to it
  KernelChoice kernel = {};
  double support = 0;             ///< H, m
  double condition_limit = 1e10;  ///< above it a neighbourhood is degenerate
  std::string search = "cell_grid";
};

/// Fields at query points: fields[f][q].
template <int N>
struct Estimates {
  std::vector<std::vector<Estimate<N>>> fields;
  std::vector<Status> status;
  std::vector<double> condition;          ///< of the system solved; infinite if singular, NaN if there was none
  std::vector<std::uint32_t> neighbours;  ///< points in the support

  std::size_t count(Status status) const;
};

/// Fields and their derivatives from scattered points, by one of the `Methods`. Where a field's value, gradient or
/// Hessian cannot be had, it is NaN and the point's status says why; whether the method has derivatives at all,
/// degrees() says. Any number of threads may ask.
template <int N>
class Approximation {
 public:
  /// Throws InputError where the options contradict themselves, the method or the points.
  Approximation(Points<N> points, const Options& options);

  /// What the method gives, and up to which degree of polynomial exactly.
  Degrees degrees() const { return degrees_; }
  int order() const { return order_; }
  std::size_t size() const { return points_.x.size(); }

  /// The weights of the points at x.
  Stencil<N> stencil(const Vec<N>& x) const;

  /// The fields, each with one value per point, at all queries. Throws InputError if a size does not fit or a query is
  /// not finite.
  Estimates<N> evaluate(std::span<const Vec<N>> queries, const std::vector<std::span<const double>>& fields) const;

 private:
  void check() const;
  Neighbourhood<N> neighbourhood(const Vec<N>& centre, const std::vector<std::uint32_t>& found) const;
  Stencil<N> stencil(const Vec<N>& x, std::vector<std::uint32_t>& found) const;

  Points<N> points_;
  int method_ = 0, order_ = 0;
  KernelChoice kernel_;
  double support_, condition_limit_;
  Degrees degrees_;
  bool needs_volumes_ = false, about_a_point_ = false;
  std::unique_ptr<NeighbourSearch<N>> search_;
};

extern template class Approximation<1>;
extern template class Approximation<2>;
extern template class Approximation<3>;

}  // namespace undine::approximation
