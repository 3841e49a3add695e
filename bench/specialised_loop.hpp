#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <vector>

#include "specialised_vector.hpp"
#include "undine/schemes/weakly_compressible.hpp"

// The force pass of the bench as one would write it by hand for this one scheme: Wendland C2, uniform H, symmetric
// pressure, continuity, alpha viscosity without beta, Fourtakas diffusion under gravity along z, XSPH, and the largest
// mu, in float on fixed-point positions.

namespace specialised {

/// How a loop is specialised further.
struct Traits {
  int width;        ///< floats of a record: 12, or 8 where mass is one constant and c follows from rho (gamma = 7)
  bool books;       ///< whether it also adds up the power of each term, as the scheme asks
  bool whole_rows;  ///< whether lists were filled up to whole vectors beforehand
};

/// Neighbour lists one after the other.
struct Lists {
  std::vector<std::uint32_t> starts{0}, indices;
};

struct Constants {
  double unit;  ///< of positions, m
  float H, mass, rho_0, c_0, alpha, delta, epsilon, gravity;
};

/// What the pass gives, laid out as the fields of the store, and the powers in W.
struct Results {
  std::vector<double> acc, v_xsph, drho, drho_diff, mu_cfl;
  double pressure = 0, compression = 0, artificial = 0, diffusion = 0;
};

/// Position code, density difference, velocity, p/rho^2; then c, 1/c, m, m/rho.
template <Traits traits>
void pack(const undine::Store<3>& store, const Constants& constants, std::vector<float>& records) {
  using namespace undine::field;
  const auto at = store.get<x>();
  const auto speed = store.get<v>();
  const auto density = store.get<rho>(), pressure = store.get<p>(), sound = store.get<c>(), mass = store.get<m>();
  const double units_per_m = 1 / constants.unit;
  records.resize(store.size() * traits.width);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < store.size(); ++i) {
    float* to = records.data() + i * traits.width;
    for (int k = 0; k < 3; ++k) {
      const auto code = static_cast<std::uint32_t>(static_cast<std::int64_t>(std::nearbyint(at[i][k] * units_per_m)));
      std::memcpy(to + k, &code, sizeof(code));
    }
    to[3] = static_cast<float>(density[i] - constants.rho_0);
    for (int k = 0; k < 3; ++k) to[4 + k] = static_cast<float>(speed[i][k]);
    const double inverse = 1 / density[i];
    to[7] = static_cast<float>(pressure[i] * inverse * inverse);
    if constexpr (traits.width == 12) {
      to[8] = static_cast<float>(sound[i]);
      to[9] = static_cast<float>(1 / sound[i]);
      to[10] = static_cast<float>(mass[i]);
      to[11] = static_cast<float>(mass[i] * inverse);
    }
  }
}

/// Sums over the neighbours of one particle, still in lanes.
struct Sums {
  V force[3]{}, artificial[3]{}, xsph[3]{}, drho{}, diffusion{}, mu{};
};

template <Traits traits>
class Loop {
 public:
  explicit Loop(const Constants& constants) : k_(constants) {
    const double inv_h = 1.0 / k_.H, norm = 21 / (2 * std::numbers::pi) * inv_h * inv_h * inv_h;
    inv_h_ = static_cast<float>(inv_h);
    w_ = static_cast<float>(norm);
    grad_ = static_cast<float>(-20 * norm * inv_h * inv_h);
    h_ = 0.5F * k_.H;
    eta_sq_ = 0.01F * h_ * h_;
    unit_ = static_cast<float>(k_.unit);
  }

  void run(const std::vector<float>& records, const Lists& lists, const undine::Store<3>& store,
           Results& results) const {
    const auto mass = store.get<undine::field::m>();
    const auto n = static_cast<std::ptrdiff_t>(lists.starts.size() - 1);
    double pressure = 0, compression = 0, artificial = 0, diffusion = 0;
#pragma omp parallel for schedule(dynamic, 128) reduction(+ : pressure, compression, artificial, diffusion)
    for (std::ptrdiff_t a = 0; a < n; ++a) {
      const float* record = records.data() + a * traits.width;
      const Sums sums = sum_over(records.data(), record, lists.indices.data() + lists.starts[a],
                                 static_cast<int>(lists.starts[a + 1] - lists.starts[a]));
      float s[12];
      sum_four(sums.force[0], sums.force[1], sums.force[2], sums.drho, s);
      sum_four(sums.xsph[0], sums.xsph[1], sums.xsph[2], sums.diffusion, s + 4);
      if constexpr (traits.books) {
        sum_four(sums.artificial[0], sums.artificial[1], sums.artificial[2], sums.artificial[0], s + 8);
        for (int k = 0; k < 3; ++k) {
          pressure += mass[a] * record[4 + k] * s[k];
          artificial += mass[a] * record[4 + k] * s[8 + k];
          s[k] += s[8 + k];
        }
        compression += mass[a] * record[7] * s[3];
        diffusion += mass[a] * record[7] * s[7];
      }
      for (int k = 0; k < 3; ++k) results.acc[3 * a + k] = s[k];
      results.drho[a] = s[3];
      for (int k = 0; k < 3; ++k) results.v_xsph[3 * a + k] = s[4 + k];
      results.drho_diff[a] = s[7];
      results.mu_cfl[a] = largest(sums.mu);
    }
    results.pressure = pressure;
    results.compression = compression;
    results.artificial = artificial;
    results.diffusion = diffusion;
  }

 private:
  /// What a target brings to all of its pairs.
  struct Target {
    V x[3], drho, v[3], p_over_rho_sq, c, inv_c;
  };

  [[gnu::always_inline]] Sums sum_over(const float* records, const float* record, const std::uint32_t* list,
                                       int count) const {
    Target a;
    for (int k = 0; k < 3; ++k) a.x[k] = all(record[k]);
    a.drho = all(record[3]);
    for (int k = 0; k < 3; ++k) a.v[k] = all(record[4 + k]);
    a.p_over_rho_sq = all(record[7]);
    const float c = traits.width == 12 ? record[8] : sound_speed(1 + record[3] / k_.rho_0);
    a.c = all(c);
    a.inv_c = all(1 / c);
    Sums sums;
    int at = 0;
    for (; at + lanes <= count; at += lanes) {
      const float* from[lanes];
      for (int k = 0; k < lanes; ++k) from[k] = records + std::size_t{list[at + k]} * traits.width;
      one_block(a, from, sums);
    }
    if (!traits.whole_rows && at < count) {
      // Lanes past the end take the target itself, whose share in every sum is zero.
      const float* from[lanes];
      for (int k = 0; k < lanes; ++k)
        from[k] = at + k < count ? records + std::size_t{list[at + k]} * traits.width : record;
      one_block(a, from, sums);
    }
    return sums;
  }

  float sound_speed(float relative_density) const {
    return k_.c_0 * relative_density * relative_density * relative_density;
  }

  [[gnu::always_inline]] void one_block(const Target& a, const float* const* from, Sums& sums) const {
    V b[traits.width];
    transpose<traits.width>(from, b);
    const V zero = all(0), one = all(1);
    V dx[3], dv[3];
    for (int k = 0; k < 3; ++k) dx[k] = code_difference(a.x[k], b[k]) * all(unit_);
    for (int k = 0; k < 3; ++k) dv[k] = a.v[k] - b[4 + k];
    const V r_sq = dx[0] * dx[0] + dx[1] * dx[1] + dx[2] * dx[2];
    const V v_x = dv[0] * dx[0] + dv[1] * dx[1] + dv[2] * dx[2];
    const V R = sqrt(r_sq) * all(inv_h_);
    const V u = max(one - R, zero), u_sq = u * u;
    const V w = u_sq * u_sq * (all(4) * R + one) * all(w_);

    // All quotients of the pair from one division.
    const V rho_sum = (a.drho + b[3]) + all(2 * k_.rho_0), near = r_sq + all(eta_sq_);
    V inv_rho_sum, inv_near, m, volume, c, inv_c;
    if constexpr (traits.width == 12) {
      const V inverse = one / (rho_sum * near);
      inv_rho_sum = inverse * near;
      inv_near = inverse * rho_sum;
      c = b[8];
      inv_c = b[9];
      m = b[10];
      volume = b[11];
    } else {
      const V rho = b[3] + all(k_.rho_0), two = rho_sum * near;
      const V inverse = one / (two * rho), inv_rho = inverse * two;
      inv_rho_sum = inverse * near * rho;
      inv_near = inverse * rho_sum * rho;
      const V q = inv_rho * all(k_.rho_0), s = rho * all(1 / k_.rho_0);
      c = s * s * s * all(k_.c_0);
      inv_c = q * q * q * all(1 / k_.c_0);
      m = all(k_.mass);
      volume = m * inv_rho;
    }
    const V m_grad = m * (u_sq * u * all(grad_));
    sums.drho += m_grad * v_x;

    const V mu = v_x * all(h_) * inv_near;
    sums.mu = max(sums.mu, where_less(r_sq, all(k_.H * k_.H), abs(mu)));
    const V c_sum = a.c + c;
    const V pi = all(-k_.alpha) * c_sum * min(mu, zero) * inv_rho_sum;
    const V p_sum = a.p_over_rho_sq + b[7];
    if constexpr (traits.books) {
      const V force = -m_grad * p_sum, viscous = -m_grad * pi;
      for (int k = 0; k < 3; ++k) sums.force[k] += force * dx[k];
      for (int k = 0; k < 3; ++k) sums.artificial[k] += viscous * dx[k];
    } else {
      const V force = -m_grad * (p_sum + pi);
      for (int k = 0; k < 3; ++k) sums.force[k] += force * dx[k];
    }

    const V hydrostatic = all(-0.5F * k_.gravity) * rho_sum * dx[2] * (a.inv_c * inv_c);
    const V gradient = u_sq * u * all(-grad_ * k_.delta * h_) * r_sq * inv_near;
    sums.diffusion += c_sum * volume * (b[3] - a.drho - hydrostatic) * gradient;

    const V share = all(-2 * k_.epsilon) * m * inv_rho_sum * w;
    for (int k = 0; k < 3; ++k) sums.xsph[k] += share * dv[k];
  }

  Constants k_;
  float inv_h_, w_, grad_, h_, eta_sq_, unit_;
};

}  // namespace specialised
