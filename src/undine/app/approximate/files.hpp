#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "undine/approximation/approximation.hpp"
#include "undine/io/frame.hpp"

namespace undine {

/// Points with their columns from a CSV file (named x, y, z as far as it has dimensions, and others) or from a
/// snapshot. Throws InputError.
OwnedFrame read_scattered(const std::filesystem::path& file);

/// The positions of a frame of N dimensions.
template <int N>
std::vector<Vec<N>> positions(const OwnedFrame& frame) {
  const auto& x = frame.find(frame.position)->data;
  std::vector<Vec<N>> points(frame.particles);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int k = 0; k < N; ++k) points[i][k] = x[i * N + static_cast<std::size_t>(k)];
  return points;
}

/// Query points with, of each source column, values, gradient, Hessian and Laplacian as far as given, and neighbours,
/// condition and status. `estimates` holds one field per component of the sources, in order.
template <int N>
OwnedFrame result_frame(const OwnedFrame& points, const std::vector<const OwnedColumn*>& sources,
                        std::span<const Vec<N>> queries, const approximation::Estimates<N>& estimates,
                        approximation::Degrees degrees);

/// Writes a result as CSV or, by the ending .vtkhdf, as a snapshot. Returns the names of the columns. Throws Error.
std::vector<std::string> write_result(const std::filesystem::path& file, const OwnedFrame& result,
                                      const std::vector<std::string>& comments);

}  // namespace undine
