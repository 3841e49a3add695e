#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "undine/app/case_scheme.hpp"
#include "undine/geometry/surface.hpp"
#include "undine/io/case/document.hpp"
#include "undine/schemes/flow.hpp"

namespace undine {

/// Everything that a case file says of particles and scheme, ready to run.
template <int N>
struct CaseSetup {
  std::string title;
  double spacing = 0;  ///< m
  Domain<N> domain;
  Store<N> store;
  SchemeOptions<N> scheme;
  SchemeChoice choice;
  std::map<std::string, int> bodies;               ///< name and number of each wall of particles
  std::vector<int> body_of_id;                     ///< body of each particle, by its id
  Vec<N> potential_origin{};                       ///< where E_pot is zero
  double expected_speed = 0;                       ///< m/s
  std::shared_ptr<const ReflectingSurface> walls;  ///< the surfaces of all walls, also of those that do not reflect
  Bounds container;                                ///< of all walls with the fluid inside, m; empty if there are none
  std::vector<std::string> warnings;

  FlowOptions<N>& options() {
    return std::visit([](FlowOptions<N>& common) -> FlowOptions<N>& { return common; }, scheme);
  }
  const FlowOptions<N>& options() const { return const_cast<CaseSetup&>(*this).options(); }
};

/// The flow of that scheme, before its `start`.
template <int N>
std::unique_ptr<Flow<N>> make_flow(Store<N> store, const Domain<N>& domain, const SchemeOptions<N>& options);

/// Reads a case of N dimensions. Throws InputError with file, line and column.
template <int N>
CaseSetup<N> read_case(const Table& root);

extern template std::unique_ptr<Flow<1>> make_flow<1>(Store<1>, const Domain<1>&, const SchemeOptions<1>&);
extern template std::unique_ptr<Flow<2>> make_flow<2>(Store<2>, const Domain<2>&, const SchemeOptions<2>&);
extern template std::unique_ptr<Flow<3>> make_flow<3>(Store<3>, const Domain<3>&, const SchemeOptions<3>&);

extern template CaseSetup<1> read_case<1>(const Table&);
extern template CaseSetup<2> read_case<2>(const Table&);
extern template CaseSetup<3> read_case<3>(const Table&);

}  // namespace undine
