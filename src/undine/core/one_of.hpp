#pragma once
#include <tuple>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine {

/// One entry out of a list, chosen at run time, with the parameters of all.
template <class List>
class ChoiceOf;

template <class... Entries>
class ChoiceOf<Catalogue<Entries...>> {
 public:
  using List = Catalogue<Entries...>;

  ChoiceOf() = default;
  /// The given alternative with its parameters, chosen.
  template <class Entry>
  requires(std::is_same_v<Entry, Entries> || ...) ChoiceOf(const Entry& entry) : index_(List::template index<Entry>()) {
    std::get<Entry>(entries_) = entry;
  }

  void choose(int index) { index_ = index; }
  // constexpr, so that device code may call it too: of what it may not call a GPU compiler silently leaves nothing.
  constexpr int index() const { return index_; }
  Info info() const { return List::info(index_); }

  /// The parameters of one alternative, chosen or not.
  template <class Entry>
  constexpr Entry& get() {
    return std::get<Entry>(entries_);
  }
  template <class Entry>
  constexpr const Entry& get() const {
    return std::get<Entry>(entries_);
  }

  /// The first alternative: for loops that are compiled for it alone.
  constexpr const auto& first() const { return std::get<0>(entries_); }

  /// Calls f(entry) for the chosen alternative.
  template <class F>
  void with_chosen(F&& f) {
    (void)((std::is_same_v<Entries, Entries> && index_ == List::template index<Entries>() &&
            (f(std::get<Entries>(entries_)), true)) ||
           ...);
  }

 private:
  int index_ = 0;
  std::tuple<Entries...> entries_;
};

/// One term out of a list. It is itself a term, so a sweep holds it like any other; the choice is uniform over all
/// pairs. The alternatives must add to the same fields.
template <class List>
class OneOf;

template <class... Terms>
class OneOf<Catalogue<Terms...>> : public ChoiceOf<Catalogue<Terms...>> {
 public:
  using ChoiceOf<Catalogue<Terms...>>::ChoiceOf;
  using List = Catalogue<Terms...>;
  using reads = Union<typename Terms::reads...>;
  using usual_reads = typename std::tuple_element_t<0, std::tuple<Terms...>>::reads;  ///< of the first, the default
  using adds = typename std::tuple_element_t<0, std::tuple<Terms...>>::adds;
  static_assert((std::is_same_v<adds, typename Terms::adds> && ...),
                "alternatives of one choice add to the same fields");

  /// The fields that the chosen alternative reads.
  FieldSet chosen_reads() const {
    FieldSet set;
    ((this->index() == List::template index<Terms>() ? void(set = Terms::reads::set()) : void()), ...);
    return set;
  }

  [[gnu::always_inline]] constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return List::visit(
        this->index(), [&]<class Term>(Term)
                           __attribute__((always_inline)) { return this->template get<Term>()(a, b, ab); });
  }
};

}  // namespace undine
