#include "undine/schemes/ghosts.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/engine/update.hpp"

namespace undine {

using namespace field;

namespace {

/// Gives the wall group n particles, keeping what is there of them; what they hold is to be overwritten.
template <int N>
void resize_walls(Store<N>& store, std::size_t n) {
  const IndexRange walls = store.range(Group::wall);
  if (n > walls.size()) store.append(Group::wall, n - walls.size(), 0);
  if (n >= walls.size()) return;
  std::vector<char> gone(store.size(), 0);
  std::fill(gone.begin() + static_cast<std::ptrdiff_t>(walls.begin + n), gone.end(), 1);
  store.remove(gone);
}

}  // namespace

template <int N>
Ghosts<N>::Ghosts(std::shared_ptr<const walls::Mirrors<N>> mirrors, const Domain<N>& domain)
    : mirrors_(std::move(mirrors)), domain_(domain) {
  if (mirrors_->count() > most_mirrors)
    throw InputError({.what = fmt::format("walls with ghosts have {} faces, edges and corners", mirrors_->count()),
                      .why = fmt::format("at most {} can be told apart", most_mirrors),
                      .fix = "simplify the walls, or choose another treatment"});
}

/// Where a parent is, on that side of the period on which it was when its ghosts were made.
template <int N>
Vec<N> Ghosts<N>::parent_place(const Store<N>& store, std::size_t parent) const {
  const Vec<N> then = store.template get<x_list>()[parent];
  return then + domain_.nearest_image(store.template get<x>()[parent] - then);
}

template <int N>
void Ghosts<N>::make(Store<N>& store, double reach) const {
  struct Ghost {
    std::size_t parent;
    typename walls::Mirrors<N>::Image image;
  };
  const IndexRange fluid = store.range(Group::fluid);
  const auto at = store.template get<x>();
  // As the build that follows will: mirrors are chosen for the places that it remembers.
  for_each_particle(store, Group::fluid, [&](std::size_t i) { at[i] = domain_.wrapped(at[i]); });
  const std::size_t blocks = (fluid.size() + particles_per_block - 1) / particles_per_block;
  std::vector<std::vector<Ghost>> parts(blocks);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t block = 0; block < blocks; ++block) {
    std::vector<typename walls::Mirrors<N>::Image> found;
    const std::size_t last = std::min(fluid.end, fluid.begin + (block + 1) * particles_per_block);
    for (std::size_t i = fluid.begin + block * particles_per_block; i < last; ++i) {
      found.clear();
      mirrors_->images(at[i], reach, found);
      for (const auto& image : found) parts[block].push_back({i, image});
    }
  }
  std::size_t count = 0;
  for (const auto& part : parts) count += part.size();
  resize_walls(store, count);

  const std::size_t first = store.range(Group::wall).begin;
  std::size_t next = first;
  for (const auto& part : parts)
    for (const auto& [its_parent, image] : part) {
      const std::size_t parent = its_parent;  // clang 14 lets no lambda capture a structured binding
      store.ids()[next] = id_of(store.ids()[parent], image.mirror);
      store.materials()[next] = store.materials()[parent];
      for (int f = 0; f < FieldId::count; ++f) {
        if (!store.fields()[f]) continue;
        const auto width = static_cast<std::size_t>(all_fields[f].components(N));
        std::fill_n(store.raw(f).begin() + static_cast<std::ptrdiff_t>(next * width), width, 0.0);
      }
      Fields<m, rho_0, rho_wall, mu, h, rho, p, c>::for_each([&]<class F>(F) {
        if (store.fields()[F::id]) store.template get<F>()[next] = store.template get<F>()[parent];
      });
      store.template get<x>()[next] = image.x;
      store.template get<v>()[next] =
          mirrors_->mirror(image.mirror).velocity(store.template get<v>()[parent], mirrors_->slip());
      ++next;
    }
}

template <int N>
void Ghosts<N>::find_parents(const Store<N>& store) {
  const IndexRange fluid = store.range(Group::fluid), ghosts = store.range(Group::wall);
  const auto ids = store.ids();
  std::int64_t most = -1;
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) most = std::max(most, ids[i]);
  index_of_id_.resize(static_cast<std::size_t>(most + 1));
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) index_of_id_[ids[i]] = static_cast<std::uint32_t>(i);
  parents_.resize(ghosts.size());
  for (std::size_t k = 0; k < ghosts.size(); ++k)
    parents_[k] = index_of_id_[static_cast<std::size_t>(parent_of(ids[ghosts.begin + k]))];
}

template <int N>
void Ghosts<N>::follow(Store<N>& store) const {
  const std::size_t first = store.range(Group::wall).begin;
  const auto ids = store.ids();
  const auto at = store.template get<x>();
  const auto u = store.template get<v>();
  const auto support = store.template get<h>();
  for_each_particle(store, Group::wall, [&](std::size_t i) {
    const std::size_t parent = parents_[i - first];
    const auto& mirror = mirrors_->mirror(mirror_of(ids[i]));
    at[i] = mirror.image(parent_place(store, parent));
    u[i] = mirror.velocity(u[parent], mirrors_->slip());
    if (!support.empty()) support[i] = support[parent];
  });
}

template <int N>
void Ghosts<N>::answer(Store<N>& store, const Vec<N>& gravity, bool pulls,
                       const std::vector<materials::Material>& materials) const {
  const std::size_t first = store.range(Group::wall).begin;
  const auto ids = store.ids();
  const auto density = store.template get<rho>();
  const auto pressure = store.template get<p>();
  const auto sound = store.template get<c>();
  for_each_particle(store, Group::wall, [&](std::size_t i) {
    const std::size_t parent = parents_[i - first];
    const auto& material = materials[store.materials()[i]];
    // The difference is taken from the mirror, not from the places, which may be a period apart.
    const auto& mirror = mirrors_->mirror(mirror_of(ids[i]));
    const Vec<N> place = parent_place(store, parent);
    const double carried = density[parent] * dot(gravity, mirror.image(place) - place);
    double answer = pressure[parent] + carried;
    if (!pulls) answer = std::max(answer, material.pressure(material.rho_0));
    pressure[i] = answer;
    const bool same = answer == pressure[parent];
    density[i] = same ? density[parent] : material.density(answer);
    sound[i] = same ? sound[parent] : material.sound_speed(density[i]);
  });
}

template <int N>
void Ghosts<N>::mirror(Store<N>& store, const FieldSet& fields) const {
  const std::size_t first = store.range(Group::wall).begin;
  const auto ids = store.ids();
  const auto turned = [&](const walls::Mirror<N>& mirror, const Vec<N>& v) {
    return mirrors_->slip() == walls::Slip::none ? Vec<N>{} - v : mirror.turned(v);
  };
  for (int f = 0; f < FieldId::count; ++f) {
    if (!fields[static_cast<std::size_t>(f)]) continue;
    const auto values = store.raw(f);
    const Rank rank = all_fields[f].rank;
    for_each_particle(store, Group::wall, [&](std::size_t i) {
      const std::size_t parent = parents_[i - first];
      const auto& mirror = mirrors_->mirror(mirror_of(ids[i]));
      if (rank == Rank::scalar) {
        values[i] = values[parent];
      } else if (rank == Rank::vector) {
        auto* const vectors = reinterpret_cast<Vec<N>*>(values.data());
        vectors[i] = turned(mirror, vectors[parent]);
      } else {
        auto* const tensors = reinterpret_cast<Vec<N, Vec<N>>*>(values.data());
        Vec<N, Vec<N>> rows, columns;
        for (int j = 0; j < N; ++j) rows[j] = mirror.turned(tensors[parent][j]);
        for (int j = 0; j < N; ++j)
          for (int k = 0; k < N; ++k) columns[k][j] = rows[j][k];
        for (int j = 0; j < N; ++j) tensors[i][j] = mirror.turned(columns[j]);
      }
    });
  }
}

template class Ghosts<1>;
template class Ghosts<2>;
template class Ghosts<3>;

}  // namespace undine
