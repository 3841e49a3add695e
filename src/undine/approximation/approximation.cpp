#include "undine/approximation/approximation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "undine/approximation/catalogue.hpp"
#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"

namespace undine::approximation {
namespace {

int method_named(const std::string& name) {
  const int index = Methods::index_of(name);
  if (index >= 0) return index;
  const auto guess = did_you_mean(name, Methods::names());
  throw InputError({.what = fmt::format("there is no method of approximation '{}'", shortened(name, 60)),
                    .fix = fmt::format("{}{}valid: {}", guess, guess.empty() ? "" : " ", listed(Methods::names()))});
}

template <class M>
int chosen_order(std::optional<int> order) {
  if (!order) return std::clamp(1, M::lowest_order, M::highest_order);
  if (*order >= M::lowest_order && *order <= M::highest_order) return *order;
  throw InputError({.what = fmt::format("'{}' has no order {}", M::info.name, *order),
                    .why = M::lowest_order == M::highest_order
                               ? fmt::format("its order is {}", M::lowest_order)
                               : fmt::format("it has the orders {} to {}", M::lowest_order, M::highest_order),
                    .fix = "choose another order or method"});
}

template <class M>
void check_kernel(KernelChoice kernel) {
  const bool positive = kernel.visit([](auto k) { return decltype(k)::Shape::positive; });
  if (M::needs_positive_kernel && !positive)
    throw InputError({.what = fmt::format("'{}' cannot take the kernel '{}'", M::info.name, kernel.info().name),
                      .why = "the kernel is negative in places, and squares are weighted with it",
                      .fix = "choose a kernel that is positive, such as wendland_c2"});
}

template <int N>
bool finite(const Vec<N>& x) {
  for (int k = 0; k < N; ++k)
    if (!std::isfinite(x[k])) return false;
  return true;
}

/// W, grad W and grad grad W of the kernel at x_c - x_j = -s.
template <int N>
void evaluate_kernel(KernelChoice choice, bool twice, Neighbourhood<N>& around) {
  choice.visit([&](auto kernel) {
    for (const Vec<N>& s : around.s) {
      const double R = norm(s), slope_over_R = kernel.template slope_over_R<N>(R);
      around.W.push_back(kernel.template w<N>(R));
      around.dW.push_back(-slope_over_R * s);
      if (!twice) continue;
      const double curvature = kernel.template curvature<N>(R);
      const Vec<N> n = R > 0 ? s / R : s;
      Matrix<N> ddW = (curvature - slope_over_R) * outer(n, n);
      for (int a = 0; a < N; ++a) ddW[a][a] += R > 0 ? slope_over_R : curvature;
      around.ddW.push_back(ddW);
    }
  });
}

/// From an expansion about a point to one about x = point + d, lengths in H; exact for the polynomial of the expansion.
template <int N>
void move_expansion(const Vec<N>& d, Stencil<N>& out) {
  for (std::size_t j = 0; j < out.points.size(); ++j) {
    out.value[j] += dot(out.gradient[j], d);
    if (out.hessian.empty()) continue;
    for (int a = 0; a < N; ++a) {
      out.value[j] += 0.5 * d[a] * dot(out.hessian[j][a], d);
      out.gradient[j][a] += dot(out.hessian[j][a], d);
    }
  }
}

}  // namespace

template <int N>
std::size_t Estimates<N>::count(Status wanted) const {
  return static_cast<std::size_t>(std::count(status.begin(), status.end(), wanted));
}

template <int N>
Approximation<N>::Approximation(Points<N> points, const Options& options)
    : points_(std::move(points)),
      method_(method_named(options.method)),
      kernel_(options.kernel),
      support_(options.support),
      condition_limit_(options.condition_limit) {
  Methods::visit(method_, [&]<class M>(M) {
    order_ = chosen_order<M>(options.order);
    check_kernel<M>(kernel_);
    degrees_ = M::reproduces(order_);
    const bool kink = kernel_.slope<N>(0.0) != 0;
    if (M::differentiates_kernel_twice && kink) degrees_.hessian = Degrees::not_given;
    needs_volumes_ = M::needs_volumes;
    about_a_point_ = M::about_a_point;
  });
  check();
  search_ = make_search<N>(options.search);
  search_->build(points_.x, support_, Domain<N>::unbounded());
}

template <int N>
void Approximation<N>::check() const {
  if (!(std::isfinite(support_) && support_ > 0))
    throw InputError({.what = fmt::format("the support radius is {}", support_),
                      .why = "it must be greater than 0",
                      .fix = "give a length of some point distances"});
  if (!(condition_limit_ > 1))
    throw InputError({.what = fmt::format("the limit of the condition number is {}", condition_limit_),
                      .why = "no condition number is below 1"});
  if (points_.x.empty()) throw InputError({.what = "there are no points to approximate from"});
  for (std::size_t i = 0; i < points_.x.size(); ++i)
    if (!finite(points_.x[i])) throw InputError({.what = fmt::format("point {} is not finite", i + 1)});
  if (points_.volume.empty() && needs_volumes_)
    throw InputError({.what = fmt::format("'{}' needs the volumes of the points", Methods::info(method_).name),
                      .why = "its sums are integrals",
                      .fix = "give volumes, or masses and densities, or choose a method that needs none, such as mls"});
  if (!points_.volume.empty() && points_.volume.size() != points_.x.size())
    throw InputError({.what = "the numbers of points and of volumes differ",
                      .why = fmt::format("{} points, {} volumes", points_.x.size(), points_.volume.size())});
  for (std::size_t i = 0; i < points_.volume.size(); ++i)
    if (const double V = points_.volume[i]; !(std::isfinite(V) && V > 0))
      throw InputError({.what = fmt::format("the volume of point {} is {}", i + 1, V), .why = "it must be above 0"});
}

template <int N>
Neighbourhood<N> Approximation<N>::neighbourhood(const Vec<N>& centre, const std::vector<std::uint32_t>& found) const {
  const double H = support_;
  Neighbourhood<N> around;
  for (std::size_t j = 0; j < found.size(); ++j) {
    around.s.push_back((points_.x[found[j]] - centre) / H);
    if (needs_volumes_) around.V.push_back(points_.volume[found[j]] / std::pow(H, N));
    if (about_a_point_ && around.centre == around.none && points_.x[found[j]] == centre) around.centre = j;
  }
  evaluate_kernel(kernel_, degrees_.hessian != Degrees::not_given, around);
  return around;
}

template <int N>
Stencil<N> Approximation<N>::stencil(const Vec<N>& x) const {
  std::vector<std::uint32_t> found;
  return stencil(x, found);
}

template <int N>
Stencil<N> Approximation<N>::stencil(const Vec<N>& x, std::vector<std::uint32_t>& found) const {
  if (!finite(x)) throw InputError({.what = "a point to approximate at is not finite"});
  Stencil<N> out;
  const auto refuse = [&](Status status, double condition) {
    out = Stencil<N>{.status = status, .condition = condition};
    return out;
  };
  const double H = support_;
  search_->find(x, H, found);
  if (found.empty()) return refuse(Status::no_neighbours, std::numeric_limits<double>::quiet_NaN());
  Vec<N> centre = x;
  if (about_a_point_) {
    const auto distance = [&](std::uint32_t j) { return norm_sq(points_.x[j] - x); };
    centre = points_.x[*std::ranges::min_element(found, {}, distance)];
    search_->find(centre, H, found);
  }
  const Neighbourhood<N> around = neighbourhood(centre, found);
  const bool enough = Methods::visit(method_, [&]<class M>(M) {
    if (around.size() < static_cast<std::size_t>(M::least_points(N, order_))) return false;
    M::weigh(around, order_, out);
    return true;
  });
  if (!enough) return refuse(Status::too_few, std::numeric_limits<double>::quiet_NaN());
  if (!(out.condition <= condition_limit_))
    return refuse(Status::degenerate,
                  std::isnan(out.condition) ? std::numeric_limits<double>::infinity() : out.condition);
  out.points = found;
  if (about_a_point_) move_expansion((x - centre) / H, out);
  for (auto& g : out.gradient) g = g / H;
  for (auto& h : out.hessian) h = h / sq(H);
  return out;
}

template <int N>
Estimates<N> Approximation<N>::evaluate(std::span<const Vec<N>> queries,
                                        const std::vector<std::span<const double>>& fields) const {
  for (const auto& field : fields)
    if (field.size() != size())
      throw InputError({.what = "the numbers of points and of values differ",
                        .why = fmt::format("{} points, {} values", size(), field.size())});
  for (std::size_t f = 0; f < fields.size(); ++f)
    for (std::size_t i = 0; i < size(); ++i)
      if (!std::isfinite(fields[f][i]))
        throw InputError({.what = fmt::format("value {} of field {} is not finite", i + 1, f + 1)});
  for (std::size_t q = 0; q < queries.size(); ++q)
    if (!finite(queries[q])) throw InputError({.what = fmt::format("query point {} is not finite", q + 1)});

  Estimates<N> all;
  all.fields.assign(fields.size(), std::vector<Estimate<N>>(queries.size()));
  all.status.resize(queries.size());
  all.condition.resize(queries.size());
  all.neighbours.resize(queries.size());
#pragma omp parallel for schedule(dynamic, 16)
  for (std::size_t q = 0; q < queries.size(); ++q) {
    std::vector<std::uint32_t> found;
    const Stencil<N> weights = stencil(queries[q], found);
    all.status[q] = weights.status;
    all.condition[q] = weights.condition;
    all.neighbours[q] = static_cast<std::uint32_t>(found.size());
    if (weights.status != Status::ok) continue;
    for (std::size_t f = 0; f < fields.size(); ++f) {
      Estimate<N>& at = all.fields[f][q];
      at.value = 0;
      if (!weights.gradient.empty()) at.gradient = {};
      if (!weights.hessian.empty()) at.hessian = {};
      for (std::size_t j = 0; j < weights.points.size(); ++j) {
        const double u = fields[f][weights.points[j]];
        at.value += weights.value[j] * u;
        if (!weights.gradient.empty()) at.gradient += weights.gradient[j] * u;
        if (!weights.hessian.empty()) at.hessian += weights.hessian[j] * u;
      }
    }
  }
  return all;
}

template struct Estimates<1>;
template struct Estimates<2>;
template struct Estimates<3>;
template class Approximation<1>;
template class Approximation<2>;
template class Approximation<3>;

}  // namespace undine::approximation
