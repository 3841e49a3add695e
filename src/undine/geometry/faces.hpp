#pragma once
#include <array>
#include <string>
#include <vector>

namespace undine {

/// A set of the six faces of a box.
class FaceSet {
 public:
  /// `axis` 0..2; `end` 0 for the lower face, 1 for the upper one.
  bool has(int axis, int end) const { return face_[2 * axis + end]; }
  void add(int axis, int end) { face_[2 * axis + end] = true; }

 private:
  std::array<bool, 6> face_{};
};

/// From the names "x-", "x+", "y-", "y+", "z-", "z+". InputError on any other name.
FaceSet parse_faces(const std::vector<std::string>& names);

}  // namespace undine
