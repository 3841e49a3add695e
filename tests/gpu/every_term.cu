#include "gpu/lane.hpp"
#include "undine/engine/pair.hpp"
#include "undine/terms/catalogue.hpp"

// Compiles every term of every list and every smoothing kernel as device code, each in a GPU kernel of its own, so that
// the compiler's report has one line of registers and spills for each. Nothing here runs.

namespace undine::gpu {

/// What the engine hands to a term: gradients by the supports of both particles where the term asks for them.
template <class Term>
inline constexpr bool takes_two = requires {
  requires Term::needs_both_supports;
};
template <int N, class V, class Term>
using PairFor = std::conditional_t<takes_two<Term>, PairOfTwo<N, V>, Pair<N, V>>;

template <int N, class V, class Term>
__global__ void one_pair(Term term, const typename Term::reads::template Row<N, V>* rows,
                         const PairFor<N, V, Term>* pairs, typename Term::adds::template Row<N, V>* out) {
  const unsigned i = blockIdx.x * blockDim.x + threadIdx.x;
  const auto row = term(rows[0], rows[i], pairs[i]);
  Term::adds::for_each([&]<class F>(F) { F::of(out[i]) += F::of(row); });
}

template <int N, class V, class K>
__global__ void one_kernel(const V* R, V* out) {
  using Kernel = NormedKernel<K>;
  const unsigned i = blockIdx.x * blockDim.x + threadIdx.x;
  out[5 * i] = Kernel::template w<N>(R[i]);
  out[5 * i + 1] = Kernel::template slope<N>(R[i]);
  out[5 * i + 2] = Kernel::template slope_over_R<N>(R[i]);
  out[5 * i + 3] = Kernel::template curvature<N>(R[i]);
  out[5 * i + 4] = Kernel::template laplacian<N>(R[i]);
}

template <class List>
struct Every;
template <class... Entries>
struct Every<Catalogue<Entries...>> {
  template <int N, class V>
  static void terms() {
    (one_pair<N, V, Entries><<<1, 1>>>(Entries{}, nullptr, nullptr, nullptr), ...);
  }
  template <int N, class V>
  static void kernels() {
    (one_kernel<N, V, Entries><<<1, 1>>>(nullptr, nullptr), ...);
  }
};

template <int N, class V>
void every_one() {
  Every<terms::PressureForms>::terms<N, V>();
  Every<terms::ContinuityForms>::terms<N, V>();
  Every<terms::ViscosityForms>::terms<N, V>();
  Every<terms::DiffusionForms>::terms<N, V>();
  Every<terms::ArtificialViscosities>::terms<N, V>();
  Every<terms::VelocityCorrections>::terms<N, V>();
  Every<terms::Sums>::terms<N, V>();
  Every<terms::Measures>::terms<N, V>();
  Every<terms::GradHDensities>::terms<N, V>();
  Every<terms::GasPressureForms>::terms<N, V>();
  Every<terms::EnergyForms>::terms<N, V>();
  Every<terms::GasViscosities>::terms<N, V>();
  Every<terms::StressForms>::terms<N, V>();
  Every<terms::Conductivities>::terms<N, V>();
  Every<Kernels>::kernels<N, V>();
}

template <class V>
void every_dimension() {
  every_one<1, V>();
  every_one<2, V>();
  every_one<3, V>();
}

void every_value_type() {
  every_dimension<Lane<float>>();
  every_dimension<double>();
}

}  // namespace undine::gpu
