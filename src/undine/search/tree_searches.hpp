#pragma once
#include "undine/search/joined.hpp"
#include "undine/search/search.hpp"
#include "undine/search/tree.hpp"

namespace undine {

/// Hands a ball down from the root of a tree. A node passes it on if it reaches into its box; a leaf gives back its
/// elements inside the ball. Saalfeld (2012), 6.1, figure 15(b).
template <int N, class Rule>
class BallDescent final : public NeighbourSearch<N> {
  static constexpr std::string_view growth = ", O(n log n)", semicolon = "; ",
                                    descent = "a node is left out if gap > R";

 public:
  static constexpr Info info{Rule::name, Joined<Rule::title, growth>::text,
                             Joined<Rule::equation, semicolon, descent>::text, Rule::citation};

  void build(std::span<const Vec<N>> points, double, const Domain<N>& domain) override {
    tree_.template build<Rule>(points, domain);
  }

  void find(const Vec<N>& x, double radius, std::vector<std::uint32_t>& found) const override {
    found.clear();
    const Vec<N> at = tree_.place(x);
    tree_.for_each_leaf_near({at, at}, radius, tree_.rounding(x),
                             [&](std::uint32_t leaf) { tree_.append_near(leaf, x, radius, found); });
    if (!std::is_sorted(found.begin(), found.end())) std::sort(found.begin(), found.end());
  }

  std::size_t bytes() const override { return tree_.bytes(); }

 private:
  Tree<N> tree_;
};

/// Every leaf of a tree has a list of the leaves near it. Who asks looks up its own leaf and goes through that list.
/// Saalfeld (2012), 6.1, figure 15(a), where the list has the leaves that touch: enough if no leaf is smaller than the
/// radius. Here it has those nearer than the radius, which is enough for any, and the leaf itself.
template <int N, class Rule>
class LeafLists final : public NeighbourSearch<N> {
  static constexpr std::string_view suffix = "_leaf_lists", growth = "; leaves know their neighbours, O(n log n)",
                                    semicolon = "; ", lists = "a leaf's list has the leaves with gap <= R";

 public:
  static constexpr Info info{Joined<Rule::name, suffix>::text, Joined<Rule::title, growth>::text,
                             Joined<Rule::equation, semicolon, lists>::text, Rule::citation};

  void build(std::span<const Vec<N>> points, double radius, const Domain<N>& domain) override {
    radius_ = radius;
    // Smaller leaves would only make the lists longer: most of what is so near is found anyway.
    tree_.template build<Rule>(points, domain, 0.5 * radius);
    starts_.clear();
    lists_.clear();
    const auto count = static_cast<std::uint32_t>(tree_.nodes().size());
    const Vec<N> slack = tree_.rounding();
    for (std::uint32_t k = 0; k < count; ++k) {
      starts_.push_back(lists_.size());
      if (tree_.is_leaf(k))
        tree_.for_each_leaf_near(tree_.nodes()[k].bounds, radius, slack,
                                 [&](std::uint32_t leaf) { lists_.push_back(leaf); });
    }
    starts_.push_back(lists_.size());
    starts_.shrink_to_fit();
    lists_.shrink_to_fit();
  }

  void find(const Vec<N>& x, double radius, std::vector<std::uint32_t>& found) const override {
    found.clear();
    const Vec<N> at = tree_.place(x);
    const auto append = [&](std::uint32_t leaf) { tree_.append_near(leaf, x, radius, found); };
    const std::uint32_t own = tree_.leaf_at(at);
    if (own < tree_.nodes().size() && radius <= radius_ && tree_.within_magnitude(x)) {
      for (std::size_t k = starts_[own]; k < starts_[own + 1]; ++k) append(lists_[k]);
    } else {  // in no leaf, or too far for the lists
      tree_.for_each_leaf_near({at, at}, radius, tree_.rounding(x), append);
    }
    if (!std::is_sorted(found.begin(), found.end())) std::sort(found.begin(), found.end());
  }

  std::size_t bytes() const override {
    return tree_.bytes() + starts_.capacity() * sizeof(std::size_t) + lists_.capacity() * sizeof(std::uint32_t);
  }

 private:
  Tree<N> tree_;
  double radius_ = 0;
  std::vector<std::size_t> starts_;   ///< where in lists_ the list of each node begins, and the end
  std::vector<std::uint32_t> lists_;  ///< leaves
};

}  // namespace undine
