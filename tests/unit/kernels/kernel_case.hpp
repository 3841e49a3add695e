#pragma once
#include <array>
#include <vector>

#include "undine/core/pack.hpp"
#include "undine/kernels/kernel.hpp"
#include "unit/kernels/jet.hpp"

namespace undine::test {

/// The functions of a kernel of R = r/H, on values of type V.
template <class V>
struct KernelFunctions {
  using Function = V (*)(const V&);
  Function w, slope, slope_over_R, curvature, laplacian;

  std::array<Function, 5> all() const { return {w, slope, slope_over_R, curvature, laplacian}; }
};

/// A kernel in one number of dimensions, with pointers to its functions: so the tests are compiled once, and not anew
/// for each kernel in each dimension.
struct KernelCase {
  Info info;
  int N;
  KernelChoice choice;
  bool positive, monotone;
  int smoothness;
  double natural_kappa, alpha;
  double total;  ///< what the integral of W ought to be

  KernelFunctions<double> normed;
  KernelFunctions<float> in_float;
  KernelFunctions<Pack<float>> in_float_pack;
  KernelFunctions<Pack<double>> in_double_pack;
  /// Without the norm; the Laplacian is none of the kernel's own functions.
  double (*shape)(const double&), (*slope)(const double&), (*slope_over_R)(const double&), (*curvature)(const double&);
  Jet<2> (*short_series)(const Jet<2>&);  ///< of the shape
  Jet<8> (*long_series)(const Jet<8>&);
};

namespace detail {

template <class Normed, int N, class V>
constexpr KernelFunctions<V> functions_of() {
  return {&Normed::template w<N, V>, &Normed::template slope<N, V>, &Normed::template slope_over_R<N, V>,
          &Normed::template curvature<N, V>, &Normed::template laplacian<N, V>};
}

template <class K, int N>
KernelCase kernel_case() {
  using Normed = NormedKernel<K>;
  double total = 1;
  if constexpr (!K::exactly_normalised) total += K::template norm_defect<N>();
  return {.info = K::info,
          .N = N,
          .choice = KernelChoice::of<K>(),
          .positive = K::positive,
          .monotone = K::monotone,
          .smoothness = K::smoothness,
          .natural_kappa = K::natural_kappa,
          .alpha = K::template alpha<N>(),
          .total = total,
          .normed = functions_of<Normed, N, double>(),
          .in_float = functions_of<Normed, N, float>(),
          .in_float_pack = functions_of<Normed, N, Pack<float>>(),
          .in_double_pack = functions_of<Normed, N, Pack<double>>(),
          .shape = &K::template shape<N, double>,
          .slope = &K::template slope<N, double>,
          .slope_over_R = &K::template slope_over_R<N, double>,
          .curvature = &K::template curvature<N, double>,
          .short_series = &K::template shape<N, Jet<2>>,
          .long_series = &K::template shape<N, Jet<8>>};
}

}  // namespace detail

/// Every kernel of the list in 1, 2 and 3 dimensions.
inline std::vector<KernelCase> kernel_cases() {
  std::vector<KernelCase> cases;
  Kernels::for_each([&cases]<class K>(K) {
    cases.push_back(detail::kernel_case<K, 1>());
    cases.push_back(detail::kernel_case<K, 2>());
    cases.push_back(detail::kernel_case<K, 3>());
  });
  return cases;
}

/// The values of w, slope, slope_over_R, curvature, Laplacian of a kernel that is chosen at run time.
template <int N, class V>
std::array<V, 5> chosen_values(KernelChoice kernel, const V& R) {
  return {kernel.w<N>(R), kernel.slope<N>(R), kernel.slope_over_R<N>(R), kernel.curvature<N>(R),
          kernel.laplacian<N>(R)};
}
template <class V>
std::array<V, 5> chosen_values(const KernelCase& k, const V& R) {
  return k.N == 1   ? chosen_values<1>(k.choice, R)
         : k.N == 2 ? chosen_values<2>(k.choice, R)
                    : chosen_values<3>(k.choice, R);
}

}  // namespace undine::test
