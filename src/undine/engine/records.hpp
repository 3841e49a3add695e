#pragma once
#include <span>

#include "undine/core/carried.hpp"
#include "undine/engine/position_code.hpp"
#include "undine/engine/sweep.hpp"

namespace undine {

/// The records of all particles, side by side.
template <class Real>
struct Records {
  std::span<Real> usual, extra;
};

namespace detail {

/// Fields that terms divide by: their reciprocals are taken once per particle. Plain loops, which define what is right,
/// divide.
template <class Tag, class V>
inline constexpr bool knows_inverse = lanes_of<V> > 1 &&
                                      (std::is_same_v<Tag, field::rho> || std::is_same_v<Tag, field::c>);
/// Fields that float keeps as deviations.
template <class Tag, class V>
inline constexpr bool is_deviation = std::is_same_v<V, Pack<float>>&& std::is_same_v<Tag, field::rho>;

/// The type in which a term sees a field in a loop over values V; T is V for sources and its number for the target.
template <int N, class Tag, class V, class T>
using pair_value =
    std::conditional_t<is_deviation<Tag, V>, Shifted<T>,
                       std::conditional_t<knows_inverse<Tag, V>, Known<T>, typename Tag::template value<N, T>>>;
template <int N, class V, class T, class List>
struct PairRowOf;
template <int N, class V, class T, class... F>
struct PairRowOf<N, V, T, Fields<F...>> {
  using type = typename Fields<F...>::template Made<pair_value<N, F, V, T>...>;
};

/// How many numbers a field has in a record: a reciprocal follows its number.
template <int N, class Tag, class V>
inline constexpr int record_numbers = Tag::info.components(N) + (knows_inverse<Tag, V> ? 1 : 0);
template <int N, class V, class... F>
constexpr int record_numbers_of(Fields<F...>) {
  return (record_numbers<N, F, V> + ... + 0);
}
/// Where the numbers of one field begin among those of all fields of a list.
template <int N, class Tag, class V, class... F>
constexpr int record_offset_of(Fields<F...>) {
  int at = 0;
  bool found = false;
  ((found = found || std::is_same_v<F, Tag>, at += found ? 0 : record_numbers<N, F, V>), ...);
  return at;
}

template <class U>
auto usual_reads() {
  if constexpr (U::presence == Presence::rare) {
    return Fields<>{};
  } else if constexpr (requires { typename U::Term::usual_reads; }) {
    return typename U::Term::usual_reads{};
  } else {
    return typename U::Term::reads{};
  }
}

template <class T>
inline constexpr int numbers_in = 1;
template <int N, class T>
inline constexpr int numbers_in<Vec<N, T>> = N* numbers_in<T>;

/// Calls f(index, number) for each number of a value, with the index, counted from `first`, as a constant: sums kept in
/// an array under constant indices stay in registers.
template <int first, class T, class F>
[[gnu::always_inline]] inline void for_each_indexed(T& value, F&& f) {
  if constexpr (is_vec<std::remove_const_t<T>>) {
    constexpr int count = static_cast<int>(sizeof(value.c) / sizeof(value.c[0]));
    constexpr int width = numbers_in<std::remove_cvref_t<decltype(value.c[0])>>;
    [&]<int... K>(std::integer_sequence<int, K...>) __attribute__((always_inline)) {
      (for_each_indexed<first + K * width>(value.c[K], f), ...);
    }
    (std::make_integer_sequence<int, count>{});
  } else {
    f(std::integral_constant<int, first>{}, value);
  }
}

constexpr int whole_groups(int numbers) { return (numbers + 3) / 4 * 4; }

}  // namespace detail

/// What a sweep packs of each particle before it visits pairs: the fields that its terms read, in one piece, in the
/// type of the pair arithmetic. Position and what nearly every run needs stand in the usual record; what other choices
/// read, and the support radius where each particle has its own, in a second one, which is neither packed nor loaded
/// where nobody asks.
template <int N, class V, class... Uses>
class RecordLayout {
 public:
  using Real = scalar_of<V>;
  using UsualReads = Union<decltype(detail::usual_reads<Uses>())...>;
  using Reads = Union<UsualReads, typename Uses::Term::reads...>;
  using SourceRow = typename detail::PairRowOf<N, V, V, Reads>::type;
  using TargetRow = typename detail::PairRowOf<N, V, Real, Reads>::type;

  /// Numbers of the two records, in whole groups of four.
  static constexpr int usual = detail::whole_groups(N + detail::record_numbers_of<N, V>(UsualReads{}));
  static constexpr int extra = detail::whole_groups(detail::record_numbers_of<N, V>(Reads{}) -
                                                    detail::record_numbers_of<N, V>(UsualReads{}) + 1);
  /// Where the support radius stands, counting from the start of the usual record and on through the extra one.
  static constexpr int support_at =
      usual + detail::record_numbers_of<N, V>(Reads{}) - detail::record_numbers_of<N, V>(UsualReads{});

  static bool is_extra(int field) {
    bool found = false;
    Reads::for_each([&]<class F>(F) { found = found || (F::id == field && place_of<F>() >= usual); });
    return found;
  }

  /// Packs all particles. The records live in the store's work space until the next job takes it.
  static Records<Real> fill(const SweepContext<N>& context, const detail::PositionCode<N, Real>& code,
                            bool with_extra) {
    const auto& store = context.store;
    const std::size_t all_usual = store.size() * usual;
    const auto room =
        context.store.workspace().template take<Real>(all_usual + (with_extra ? store.size() * extra : 0));
    const Records<Real> records{room.first(all_usual), room.subspan(all_usual)};
    const auto x = store.template get<field::x>();
    const auto h = store.template get<field::h>();
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < store.size(); ++i) {
      Real* const record = records.usual.data() + i * usual;
      Real* const more = with_extra ? records.extra.data() + i * extra - usual : nullptr;
      const auto position = code.encode(x[i]);
      for (int k = 0; k < N; ++k) record[k] = position[k];
      Reads::for_each([&]<class F>(F) {
        constexpr int place = place_of<F>(), n = F::info.components(N);
        // What no term in use reads has no memory.
        if (!store.fields()[F::id] || (place >= usual && !with_extra)) return;
        Real* const to = (place < usual ? record : more) + place;
        const double* from = store.raw(F::id).data() + i * n;
        const double shift = detail::is_deviation<F, V> ? context.rho_reference : 0;
        for (int k = 0; k < n; ++k) to[k] = static_cast<Real>(from[k] - shift);
        if constexpr (detail::knows_inverse<F, V>) to[n] = static_cast<Real>(1 / from[0]);
      });
      if (with_extra)
        more[support_at] = static_cast<Real>(context.support.per_particle ? h[i] : context.support.uniform);
    }
    return records;
  }

  /// Fills a row from the numbers of both records, of one particle or of one per lane.
  template <class Row, class Number>
  [[gnu::always_inline]] static void load(Row& row, const Number* numbers, Real rho_reference) {
    Reads::for_each([&]<class F>(F) __attribute__((always_inline)) {
      constexpr int first = place_of<F>();
      if constexpr (detail::is_deviation<F, V>) {
        F::of(row) = {numbers[first], Number(rho_reference), numbers[first + 1]};
      } else if constexpr (detail::knows_inverse<F, V>) {
        F::of(row) = {numbers[first], numbers[first + 1]};
      } else {
        detail::for_each_indexed<first>(
            F::of(row), [&](auto k, auto& number) __attribute__((always_inline)) { number = numbers[k]; });
      }
    });
  }

 private:
  template <class F>
  static constexpr int place_of() {
    constexpr int at = detail::record_offset_of<N, F, V>(Reads{});  // the usual ones come first
    constexpr int usual_numbers = detail::record_numbers_of<N, V>(UsualReads{});
    return at < usual_numbers ? N + at : usual + at - usual_numbers;
  }
};

}  // namespace undine
