#pragma once
#include <span>
#include <vector>

#include "undine/engine/update.hpp"

namespace undine {

/// The state of a step's start and the slopes of its stages, for Runge-Kutta integrators. They are kept by particle id,
/// for an evaluation may change the order of the particles, and only while the step lasts. Ghosts (negative ids) have
/// no state.
template <int N>
class Stages {
 public:
  /// Keeps these fields as they are, and makes room for slopes.
  void start(const Store<N>& store, const std::vector<int>& fields, int slopes) {
    fields_ = fields;
    width_ = 0;
    for (const int f : fields_) width_ += components(f);
    std::int64_t last = -1;
    for (const auto id : store.ids()) last = std::max(last, id);
    rows_ = static_cast<std::size_t>(last + 1);
    start_.assign(rows_ * width_, 0);
    slopes_.resize(static_cast<std::size_t>(slopes));
    for (auto& slope : slopes_) slope.assign(rows_ * width_, 0);
    for_each_number(store, [&](double number, std::size_t at) { start_[at] = number; });
  }

  /// The slope of every field as `move` changes it within dt; the fields are left as they were.
  template <class Move>
  void take(Store<N>& store, int k, double dt, Move&& move) {
    std::vector<std::vector<double>> before;
    for (const int f : fields_) before.emplace_back(store.raw(f).begin(), store.raw(f).end());
    move();
    auto& slope = slopes_[static_cast<std::size_t>(k)];
    for_each_number(store, [&](double number, std::size_t at) { slope[at] = number; });
    for (std::size_t f = 0; f < fields_.size(); ++f) std::ranges::copy(before[f], store.raw(fields_[f]).begin());
    for_each_number(store, [&](double number, std::size_t at) { slope[at] = (slope[at] - number) / dt; });
  }
  /// Sets the slope of one vector field of particle i; the others are as taken.
  void put(const Store<N>& store, int k, int field, std::size_t i, const Vec<N>& rate) {
    double* const to = row(slopes_[static_cast<std::size_t>(k)], store, i) + offset(field);
    for (int c = 0; c < N; ++c) to[c] = rate[c];
  }

  /// The value of the start plus sum_k w_k slope_k, number c of a field of particle i.
  double combined(const Store<N>& store, std::span<const double> w, int field, std::size_t i, int c) const {
    const std::size_t at =
        static_cast<std::size_t>(store.ids()[i]) * width_ + offset(field) + static_cast<std::size_t>(c);
    return start_[at] + change(w, at);
  }
  /// sum_k w_k slope_k alone.
  double change(const Store<N>& store, std::span<const double> w, int field, std::size_t i, int c) const {
    return change(w, static_cast<std::size_t>(store.ids()[i]) * width_ + offset(field) + static_cast<std::size_t>(c));
  }
  /// Writes that to the store, in one group.
  void write(Store<N>& store, Group group, std::span<const double> w, int field) const {
    const auto n = components(field);
    const auto to = store.raw(field);
    for_each_particle(store, group, [&](std::size_t i) {
      if (store.ids()[i] < 0) return;
      for (std::size_t c = 0; c < n; ++c) to[i * n + c] = combined(store, w, field, i, static_cast<int>(c));
    });
  }

  const std::vector<int>& fields() const { return fields_; }
  bool keeps(int field) const { return std::ranges::find(fields_, field) != fields_.end(); }

 private:
  static std::size_t components(int field) {
    return static_cast<std::size_t>(all_fields[static_cast<std::size_t>(field)].components(N));
  }
  std::size_t offset(int field) const {
    std::size_t at = 0;
    for (const int f : fields_) {
      if (f == field) break;
      at += components(f);
    }
    return at;
  }
  double* row(std::vector<double>& rows, const Store<N>& store, std::size_t i) const {
    return rows.data() + static_cast<std::size_t>(store.ids()[i]) * width_;
  }
  double change(std::span<const double> w, std::size_t at) const {
    double sum = 0;
    for (std::size_t k = 0; k < w.size(); ++k)
      if (w[k] != 0) sum += w[k] * slopes_[k][at];
    return sum;
  }
  /// Calls f(number, its place) for every number of every field.
  template <class F>
  void for_each_number(const Store<N>& store, F&& f) const {
    std::size_t first = 0;
    for (const int field : fields_) {
      const auto numbers = store.raw(field);
      const auto n = components(field);
      for (const Group group : all_groups)
        for_each_particle(store, group, [&](std::size_t i) {
          if (store.ids()[i] < 0) return;
          const std::size_t at = static_cast<std::size_t>(store.ids()[i]) * width_ + first;
          for (std::size_t c = 0; c < n; ++c) f(numbers[i * n + c], at + c);
        });
      first += n;
    }
  }

  std::vector<int> fields_;
  std::size_t width_ = 0, rows_ = 0;
  std::vector<double> start_;
  std::vector<std::vector<double>> slopes_;
};

}  // namespace undine
