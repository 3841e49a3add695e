#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "undine/app/case_scheme.hpp"
#include "undine/geometry/surface.hpp"
#include "undine/io/case/document.hpp"
#include "undine/schemes/weakly_compressible_options.hpp"

namespace undine {

/// Everything that a case file says of particles and scheme, ready to run.
template <int N>
struct CaseSetup {
  std::string title;
  double spacing = 0;  ///< m
  Domain<N> domain;
  Store<N> store;
  WeaklyCompressibleOptions<N> options;
  SchemeChoice choice;
  std::map<std::string, int> bodies;               ///< name and number of each wall of particles
  std::vector<int> body_of_id;                     ///< body of each particle, by its id
  Vec<N> potential_origin{};                       ///< where E_pot is zero
  double expected_speed = 0;                       ///< m/s
  std::shared_ptr<const ReflectingSurface> walls;  ///< the surfaces of all walls, also of those that do not reflect
  Bounds container;                                ///< of all walls with the fluid inside, m; empty if there are none
  std::vector<std::string> warnings;
};

/// Reads a case of N dimensions. Throws InputError with file, line and column.
template <int N>
CaseSetup<N> read_case(const Table& root);

extern template CaseSetup<1> read_case<1>(const Table&);
extern template CaseSetup<2> read_case<2>(const Table&);
extern template CaseSetup<3> read_case<3>(const Table&);

}  // namespace undine
