#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <tuple>
#include <vector>

#include "gpu/lane.hpp"
#include "undine/engine/pair.hpp"
#include "undine/terms/catalogue.hpp"

// The fused force pass on a GPU: every term of the lists of a weakly compressible flow, chosen at run time, over every
// kernel. One thread sums over the neighbours of one particle, in float on fixed-point positions; the same terms in
// plain double loops on the host say what is right. Exit code 1: they differ; 77: there is no GPU, so that the float
// pass ran on the host only.

namespace undine::gpu {

constexpr int dimensions = 3;
constexpr double tolerance = 1e-5;
constexpr int skipped = 77;

/// Everything that acts in one pass, as data.
struct Pass {
  std::tuple<OneOf<terms::PressureForms>, OneOf<terms::ContinuityForms>, OneOf<terms::ViscosityForms>,
             OneOf<terms::ArtificialViscosities>, OneOf<terms::DiffusionForms>, OneOf<terms::VelocityCorrections>,
             terms::ApproachSpeed>
      terms;
  KernelChoice kernel;
  double support, smoothing_length;
};

template <class... Term>
std::tuple<Union<typename Term::reads...>, Union<typename Term::adds...>> fields_of(const std::tuple<Term...>&);
using Reads = std::tuple_element_t<0, decltype(fields_of(Pass{}.terms))>;
using Adds = std::tuple_element_t<1, decltype(fields_of(Pass{}.terms))>;
template <class V>
using Row = Reads::template Row<dimensions, V>;
template <class V>
using Sums = Adds::template Row<dimensions, V>;

/// Adds what particle b does to particle a.
template <class V>
constexpr void add_pair(const Pass& pass, const Vec<dimensions, V>& dx, const Row<V>& a, const Row<V>& b,
                        Sums<V>& sums) {
  const V H = pass.support, h = pass.smoothing_length, inverse = 1 / pass.support;
  const V inverse_cubed = inverse * inverse * inverse;
  const V r_sq = norm_sq(dx), r = sqrt(r_sq), R = r * inverse;
  const auto inside = r_sq < H * H;
  V w, grad;
  pass.kernel.visit([&]<class Kernel>(Kernel) {
    w = Kernel::template w<dimensions>(R) * inverse_cubed;
    grad = Kernel::template slope_over_R<dimensions>(R) * (inverse_cubed * inverse * inverse);
  });
  const PairBase<dimensions, V> base{.dx = dx,
                                     .r = r,
                                     .r_sq = r_sq,
                                     .support = H,
                                     .h = h,
                                     .inv_r_sq = 1.0 / (r_sq + 0.01 * sq(h)),
                                     .inv_rho = 2.0 / (a.rho + b.rho),
                                     .inside = inside};
  const Pair<dimensions, V> ab{base, w, dx * grad, &pass.kernel};
  const auto one = [&]<class Term>(const Term& term) {
    const auto row = term(a, b, ab);
    Term::adds::for_each([&]<class F>(F) {
      if constexpr (F::info.join == Join::max) {
        F::of(sums) = max(F::of(sums), select(inside, V(F::of(row)), V(0)));
      } else {
        F::of(sums) += F::of(row);
      }
    });
  };
  std::apply([&](const auto&... term) { (one(term), ...); }, pass.terms);
}

/// Particles as a GPU sees them, and the neighbours of each: those of particle i are neighbours[starts[i] ...
/// starts[i+1]].
struct View {
  using V = Lane<float>;
  const Vec<dimensions, std::uint32_t>* x;  ///< fixed point: differences wrap and are exact
  const Row<V>* rows;
  const std::uint32_t *starts, *neighbours;
  std::uint32_t count;
  float unit;  ///< m

  constexpr Sums<V> sum(const Pass& pass, std::uint32_t a) const {
    Sums<V> sums{};
    const Row<V> row_a = rows[a];
    for (std::uint32_t at = starts[a]; at < starts[a + 1]; ++at) {
      const std::uint32_t b = neighbours[at];
      Vec<dimensions, V> dx;
      for (int k = 0; k < dimensions; ++k) dx[k] = V(static_cast<std::int32_t>(x[a][k] - x[b][k])) * V(unit);
      add_pair(pass, dx, row_a, rows[b], sums);
    }
    return sums;
  }
};

__global__ void sweep(const __grid_constant__ Pass pass, const View particles, Sums<View::V>* sums) {
  const std::uint32_t a = blockIdx.x * blockDim.x + threadIdx.x;
  if (a < particles.count) sums[a] = particles.sum(pass, a);
}

/// A cube of disordered particles, far from the origin.
class Crowd {
 public:
  explicit Crowd(int side) {
    constexpr double origin = 1000 * spacing;
    const auto vector = [&](double size) {
      return Vec<dimensions>{{size * between(-1, 1), size * between(-1, 1), size * between(-1, 1)}};
    };
    for (int cell = 0; cell < side * side * side; ++cell) {
      const Vec<dimensions> at{{cell % side + 0.0, cell / side % side + 0.0, cell / side / side + 0.0}};
      x_.push_back(Vec<dimensions>{{origin, origin, origin}} + spacing * (at + vector(0.3)));
      Row<double> row;
      row.m = 1000 * cube(spacing) * between(0.9, 1.1);
      row.rho = 1000 * between(0.95, 1.05);
      row.mu = between(0.5, 1.5);
      row.p = between(-1e4, 1e4);
      row.c = 30 * between(0.9, 1.1);
      row.v = vector(1);
      row.grad_rho_l = vector(1e3);
      rows_.push_back(row);
    }
    find_neighbours();
    to_float();
  }

  std::vector<Sums<double>> sums_in_double(const Pass& pass) const {
    std::vector<Sums<double>> sums(x_.size());
    for (std::size_t a = 0; a < x_.size(); ++a)
      for (std::uint32_t at = starts_[a]; at < starts_[a + 1]; ++at) {
        const std::uint32_t b = neighbours_[at];
        add_pair(pass, x_[a] - x_[b], rows_[a], rows_[b], sums[a]);
      }
    return sums;
  }

  /// The float pass, on the host.
  std::vector<Sums<View::V>> sums_in_float(const Pass& pass) const {
    const View view = view_of(codes_.data(), float_rows_.data(), starts_.data(), neighbours_.data());
    std::vector<Sums<View::V>> sums(view.count);
    for (std::uint32_t a = 0; a < view.count; ++a) sums[a] = view.sum(pass, a);
    return sums;
  }

  std::vector<Sums<View::V>> sums_on_device(const Pass& pass) const;

  std::size_t size() const { return x_.size(); }
  std::size_t pairs() const { return neighbours_.size(); }

  static constexpr double spacing = 0.01, support = 2.6 * spacing, kappa = 2;

 private:
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }

  /// Also pairs a little further apart than the support, as a list with a skin has them.
  void find_neighbours() {
    starts_.push_back(0);
    for (const auto& a : x_) {
      for (std::size_t b = 0; b < x_.size(); ++b)
        if (norm_sq(a - x_[b]) < sq(1.1 * support)) neighbours_.push_back(static_cast<std::uint32_t>(b));
      starts_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
    }
  }

  void to_float() {
    for (const auto& x : x_) {
      Vec<dimensions, std::uint32_t> code;
      for (int k = 0; k < dimensions; ++k)
        code[k] = static_cast<std::uint32_t>(static_cast<std::int64_t>(std::nearbyint(x[k] / unit)));
      codes_.push_back(code);
    }
    for (const auto& row : rows_) {
      Row<View::V> made;
      Reads::for_each([&]<class F>(F) {
        if constexpr (F::info.rank == Rank::scalar) {
          F::of(made) = F::of(row);
        } else {
          for (int k = 0; k < dimensions; ++k) F::of(made)[k] = F::of(row)[k];
        }
      });
      float_rows_.push_back(made);
    }
  }

  View view_of(const Vec<dimensions, std::uint32_t>* x, const Row<View::V>* rows, const std::uint32_t* starts,
               const std::uint32_t* neighbours) const {
    return {x, rows, starts, neighbours, static_cast<std::uint32_t>(x_.size()), static_cast<float>(unit)};
  }

  static constexpr double unit = support * 0x1p-24;  ///< of positions in fixed point, m
  std::mt19937_64 random_;
  std::vector<Vec<dimensions>> x_;
  std::vector<Row<double>> rows_;
  std::vector<Vec<dimensions, std::uint32_t>> codes_;
  std::vector<Row<View::V>> float_rows_;
  std::vector<std::uint32_t> starts_, neighbours_;
};

/// Ends the program where a call of the CUDA library fails.
void expect_success(cudaError_t error) {
  if (error == cudaSuccess) return;
  std::printf("CUDA: %s\n", cudaGetErrorString(error));
  std::exit(1);
}

/// An array on the device.
template <class T>
class DeviceArray {
 public:
  explicit DeviceArray(std::size_t size) : size_(size) { expect_success(cudaMalloc(&data_, size * sizeof(T))); }
  explicit DeviceArray(const std::vector<T>& from) : DeviceArray(from.size()) {
    expect_success(cudaMemcpy(data_, from.data(), size_ * sizeof(T), cudaMemcpyHostToDevice));
  }
  ~DeviceArray() { cudaFree(data_); }
  DeviceArray(const DeviceArray&) = delete;
  DeviceArray& operator=(const DeviceArray&) = delete;

  T* data() const { return data_; }
  std::vector<T> values() const {
    std::vector<T> to(size_);
    expect_success(cudaMemcpy(to.data(), data_, size_ * sizeof(T), cudaMemcpyDeviceToHost));
    return to;
  }

 private:
  T* data_ = nullptr;
  std::size_t size_;
};

std::vector<Sums<View::V>> Crowd::sums_on_device(const Pass& pass) const {
  const DeviceArray x(codes_);
  const DeviceArray rows(float_rows_);
  const DeviceArray starts(starts_), neighbours(neighbours_);
  const DeviceArray<Sums<View::V>> sums(x_.size());
  const View view = view_of(x.data(), rows.data(), starts.data(), neighbours.data());
  constexpr unsigned block = 128;
  sweep<<<(view.count + block - 1) / block, block>>>(pass, view, sums.data());
  expect_success(cudaGetLastError());
  return sums.values();
}

/// Per field, the largest difference relative to the field's largest magnitude, over all passes so far.
class Errors {
 public:
  void compare(const std::vector<Sums<View::V>>& got, const std::vector<Sums<double>>& expected) {
    Adds::for_each([&]<class F>(F) {
      double largest = 0, difference = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        if constexpr (F::info.rank == Rank::scalar) {
          one(F::of(got[i]), F::of(expected[i]), largest, difference);
        } else {
          for (int k = 0; k < dimensions; ++k) one(F::of(got[i])[k], F::of(expected[i])[k], largest, difference);
        }
      }
      // Written so that NaN counts as an error.
      if (!(difference / largest <= worst_[F::id])) worst_[F::id] = difference / largest;
    });
  }

  /// Prints them; whether all are small.
  bool report(const char* where) const {
    bool good = true;
    Adds::for_each([&]<class F>(F) {
      std::printf("%s: %-10.*s %.2e\n", where, static_cast<int>(all_fields[F::id].name.size()),
                  all_fields[F::id].name.data(), worst_[F::id]);
      good = good && worst_[F::id] <= tolerance;
    });
    return good;
  }

 private:
  static void one(View::V got, double expected, double& largest, double& difference) {
    largest = std::max(largest, std::abs(expected));
    const double d = std::abs(got.value - expected);
    if (!(d <= difference)) difference = d;
  }
  double worst_[FieldId::count]{};
};

/// Passes that between them use every kernel and every alternative of every list.
std::vector<Pass> passes() {
  std::vector<Pass> all;
  for (int k = 0; k < Kernels::size; ++k) {
    Pass pass{{}, KernelChoice(k), Crowd::support, Crowd::support / Crowd::kappa};
    std::apply(
        [&](auto&... term) {
          const auto choose = [&](auto& one) {
            if constexpr (requires { one.index(); }) one.choose(k % std::remove_cvref_t<decltype(one)>::List::size);
          };
          (choose(term), ...);
        },
        pass.terms);
    std::get<OneOf<terms::DiffusionForms>>(pass.terms).get<terms::DiffusionFourtakas>().gravity[2] = -9.81;
    std::get<OneOf<terms::ArtificialViscosities>>(pass.terms).get<terms::ViscosityMonaghan>().beta = 1;
    all.push_back(pass);
  }
  return all;
}

int check() {
  int devices = 0;
  const bool has_device = cudaGetDeviceCount(&devices) == cudaSuccess && devices > 0;
  const Crowd crowd(16);
  Errors on_host, on_device;
  for (const Pass& pass : passes()) {
    const auto expected = crowd.sums_in_double(pass);
    on_host.compare(crowd.sums_in_float(pass), expected);
    if (has_device) on_device.compare(crowd.sums_on_device(pass), expected);
  }
  std::printf("%zu particles, %zu pairs, %d passes; largest errors against double:\n", crowd.size(), crowd.pairs(),
              static_cast<int>(passes().size()));
  const bool good = on_host.report("host, float") && (!has_device || on_device.report("GPU, float"));
  if (!has_device) std::printf("no GPU here\n");
  return !good ? 1 : has_device ? 0 : skipped;
}

}  // namespace undine::gpu

int main() { return undine::gpu::check(); }
