#pragma once
#include <cstdint>
#include <utility>

#include "undine/core/error.hpp"

namespace undine {

/// What is wrong with a state that the moves cannot go on from.
enum class Trouble {
  not_finite,  ///< a number is none
  outside,     ///< fluid left the domain
  energy,      ///< an internal energy below zero, or a density that is not above it
  support      ///< no support radius H serves: none fits the density, or there is no room for it
};

/// A state that the moves cannot go on from, with the particle that it was met at.
class StateError : public RunError {
 public:
  StateError(Trouble trouble, std::int64_t particle, Parts parts)
      : RunError(std::move(parts)), trouble_(trouble), particle_(particle) {}
  Trouble trouble() const { return trouble_; }
  std::int64_t particle() const { return particle_; }  ///< its id

 private:
  Trouble trouble_;
  std::int64_t particle_;
};

}  // namespace undine
