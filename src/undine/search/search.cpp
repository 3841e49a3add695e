#include "undine/search/search.hpp"

#include "undine/core/error.hpp"
#include "undine/search/all_pairs.hpp"
#include "undine/search/cell_grid.hpp"
#include "undine/search/kd_tree.hpp"
#include "undine/search/octree.hpp"
#include "undine/search/tree_searches.hpp"

namespace undine {
namespace {

template <int N, class Axis, class Place>
using KdTree = BallDescent<N, KdTreeRule<Axis, Place>>;

/// The one list of searches.
// clang-format off
template <int N>
using Searches = std::tuple<
    CellGrid<N>,
    BallDescent<N, OctreeRule>,
    LeafLists<N, OctreeRule>,
    KdTree<N, kd_axis::Rotate, kd_place::Mid>,
    KdTree<N, kd_axis::Rotate, kd_place::Centre>,
    KdTree<N, kd_axis::Rotate, kd_place::Median>,
    KdTree<N, kd_axis::Extent, kd_place::Mid>,
    KdTree<N, kd_axis::Extent, kd_place::Centre>,
    KdTree<N, kd_axis::Extent, kd_place::Median>,
    KdTree<N, kd_axis::Spread, kd_place::Mid>,
    KdTree<N, kd_axis::Spread, kd_place::Centre>,
    KdTree<N, kd_axis::Spread, kd_place::Median>,
    AllPairs<N>>;
// clang-format on

template <int N, class F>
void for_each_search(F&& f) {
  [&]<class... S>(std::tuple<S...>*) { (f.template operator()<S>(), ...); }(static_cast<Searches<N>*>(nullptr));
}

}  // namespace

std::vector<Info> search_infos() {
  std::vector<Info> infos;
  for_each_search<3>([&]<class S>() { infos.push_back(S::info); });
  return infos;
}

template <int N>
std::unique_ptr<NeighbourSearch<N>> make_search(const std::string& name) {
  std::unique_ptr<NeighbourSearch<N>> search;
  for_each_search<N>([&]<class S>() {
    if (S::info.name == name) search = std::make_unique<S>();
  });
  if (!search)
    throw InputError(
        {.what = "there is no neighbour search named '" + name + "'", .fix = "see `undine list searches`"});
  return search;
}

template std::unique_ptr<NeighbourSearch<1>> make_search<1>(const std::string&);
template std::unique_ptr<NeighbourSearch<2>> make_search<2>(const std::string&);
template std::unique_ptr<NeighbourSearch<3>> make_search<3>(const std::string&);

}  // namespace undine
