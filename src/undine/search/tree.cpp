#include "undine/search/tree.hpp"

namespace undine {

template <int N>
void Tree<N>::take(std::span<const Vec<N>> points, const Domain<N>& domain) {
  domain_ = domain;
  for (int k = 0; k < N; ++k)
    magnitude_[k] = domain.periodic[k] ? std::max(std::abs(domain.low[k]), std::abs(domain.high[k])) : 0.0;
  elements_.resize(points.size());
  nodes_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    elements_[i] = {place(points[i]), static_cast<std::uint32_t>(i)};
    for (int k = 0; k < N; ++k)
      if (domain.periodic[k] && std::isfinite(points[i][k]))
        magnitude_[k] = std::max(magnitude_[k], std::abs(points[i][k]));
  }
}

template <int N>
Box<N> Tree<N>::bounds_of(const TreePart<N>& part) const {
  Box<N> bounds{elements_[part.begin].x, elements_[part.begin].x};
  for (std::uint32_t i = part.begin + 1; i < part.end; ++i)
    for (int k = 0; k < N; ++k) {
      bounds.low[k] = std::min(bounds.low[k], elements_[i].x[k]);
      bounds.high[k] = std::max(bounds.high[k], elements_[i].x[k]);
    }
  return bounds;
}

/// Says where each node's descendants end, and puts the points' own positions back: distances are of those.
template <int N>
void Tree<N>::finish(std::span<const Vec<N>> points) {
  nodes_.shrink_to_fit();
  for (auto k = static_cast<std::uint32_t>(nodes_.size()); k-- > 0;) {
    std::uint32_t next = k + 1;
    while (next < nodes_.size() && nodes_[next].level > nodes_[k].level) next = nodes_[next].next;
    nodes_[k].next = next;
  }
  for (TreeElement<N>& element : elements_) element.x = points[element.point];
}

template <int N>
std::uint32_t Tree<N>::leaf_at(const Vec<N>& place) const {
  const auto holds = [&](const Box<N>& box) {
    bool inside = true;
    for (int k = 0; k < N; ++k) inside = inside && box.low[k] <= place[k] && place[k] <= box.high[k];
    return inside;
  };
  std::uint32_t k = 0;
  while (k < nodes_.size()) {
    if (!holds(nodes_[k].bounds)) {
      k = nodes_[k].next;
    } else if (is_leaf(k)) {
      return k;
    } else {
      ++k;
    }
  }
  return k;
}

template <int N>
void Tree<N>::append_near(std::uint32_t leaf, const Vec<N>& x, double radius, std::vector<std::uint32_t>& found) const {
  const std::uint32_t begin = nodes_[leaf].begin, end = nodes_[leaf].end;
  const double radius_sq = sq(radius);
  const bool periodic = domain_.any_periodic();
  std::size_t count = found.size();
  found.resize(count + end - begin);
  for (std::uint32_t i = begin; i < end; ++i) {
    const Vec<N> d = x - elements_[i].x;
    found[count] = elements_[i].point;  // kept only if the count moves on: no branch to mispredict
    count += norm_sq(periodic ? domain_.nearest_image(d) : d) < radius_sq;
  }
  found.resize(count);
}

template <int N>
std::size_t Tree<N>::bytes() const {
  return elements_.capacity() * sizeof(TreeElement<N>) + nodes_.capacity() * sizeof(Node);
}

template class Tree<1>;
template class Tree<2>;
template class Tree<3>;

}  // namespace undine
