#pragma once
#include <cstddef>
#include <span>

#include "undine/core/aligned.hpp"

namespace undine {

/// Memory for one job at a time, kept from job to job because fresh memory is slow: a sort, the records of a sweep.
class Workspace {
 public:
  /// Room for n numbers, of any content; what was taken before is gone.
  template <class T>
  std::span<T> take(std::size_t n) {
    if (bytes_.size() < n * sizeof(T)) bytes_ = AlignedVector<std::byte>(n * sizeof(T));
    return {reinterpret_cast<T*>(bytes_.data()), n};
  }
  std::size_t bytes() const { return bytes_.capacity(); }

 private:
  AlignedVector<std::byte> bytes_;
};

}  // namespace undine
