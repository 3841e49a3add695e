#pragma once
#include <tuple>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine {

/// One term out of a list, chosen at run time. It is itself a term, so a sweep holds it like any other; the choice is
/// uniform over all pairs. The alternatives must add to the same fields.
template <class List>
class OneOf;

template <class... Terms>
class OneOf<Catalogue<Terms...>> {
 public:
  using List = Catalogue<Terms...>;
  using reads = Union<typename Terms::reads...>;
  using usual_reads = typename std::tuple_element_t<0, std::tuple<Terms...>>::reads;  ///< of the first, the default
  using adds = typename std::tuple_element_t<0, std::tuple<Terms...>>::adds;
  static_assert((std::is_same_v<adds, typename Terms::adds> && ...),
                "alternatives of one choice add to the same fields");

  OneOf() = default;
  /// The given alternative with its parameters, chosen.
  template <class Term>
  requires(std::is_same_v<Term, Terms> || ...) OneOf(const Term& term) : index_(List::template index<Term>()) {
    std::get<Term>(terms_) = term;
  }

  void choose(int index) { index_ = index; }
  int index() const { return index_; }
  Info info() const { return List::info(index_); }

  /// The parameters of one alternative, chosen or not.
  template <class Term>
  Term& get() {
    return std::get<Term>(terms_);
  }
  template <class Term>
  const Term& get() const {
    return std::get<Term>(terms_);
  }

  /// The first alternative: for loops that are compiled for it alone.
  const auto& first() const { return std::get<0>(terms_); }

  /// Calls f(term) for the chosen alternative.
  template <class F>
  void with_chosen(F&& f) {
    (void)((std::is_same_v<Terms, Terms> && index_ == List::template index<Terms>() &&
            (f(std::get<Terms>(terms_)), true)) ||
           ...);
  }

  /// The fields that the chosen alternative reads.
  FieldSet chosen_reads() const {
    FieldSet set;
    ((index_ == List::template index<Terms>() ? void(set = Terms::reads::set()) : void()), ...);
    return set;
  }

  [[gnu::always_inline]] constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return List::visit(
        index_, [&]<class Term>(Term) __attribute__((always_inline)) { return std::get<Term>(terms_)(a, b, ab); });
  }

 private:
  int index_ = 0;
  std::tuple<Terms...> terms_;
};

}  // namespace undine
