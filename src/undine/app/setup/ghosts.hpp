#pragma once
#include <memory>
#include <string>
#include <vector>

#include "undine/geometry/faces.hpp"
#include "undine/geometry/shape.hpp"
#include "undine/io/case/table.hpp"
#include "undine/walls/mirrors.hpp"

namespace undine {

/// The walls of a case with ghost particles, as flat solids.
template <int N>
class GhostWalls {
 public:
  /// Takes a [[wall]] with its shape and the faces that are open. Throws InputError at its place where the shape has no
  /// flat faces, or the fluid lies in a notch of it.
  void add(const Table& wall, const std::string& name, const Shape& shape, Side fluid, const FaceSet& open);

  /// `reach` of the fluid's sight, in m. Throws InputError where walls meet or stand so that ghosts cannot serve.
  std::shared_ptr<const walls::Mirrors<N>> mirrors(walls::Slip slip, double reach, const Domain<N>& domain) const;

 private:
  std::vector<walls::Solid<N>> solids_;
  std::vector<Table> tables_;
};

extern template class GhostWalls<1>;
extern template class GhostWalls<2>;
extern template class GhostWalls<3>;

}  // namespace undine
