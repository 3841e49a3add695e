#pragma once
#include <string_view>
#include <vector>

#include "undine/app/case_setup.hpp"
#include "undine/app/setup/body.hpp"

namespace undine {

/// The velocities with which the particles of a body begin, m/s: of a list, or by the fluid's formula; 0 of walls.
template <int N>
class StartVelocity {
 public:
  explicit StartVelocity(const Body& body);
  /// Throws InputError where it is not finite.
  Vec<N> operator()(std::size_t particle) const;

 private:
  const Body& body_;
  std::vector<Expression> formulas_;
};

/// Puts the particles of all bodies into the set-up's store, each with its state at the start. Throws InputError where
/// there is none.
template <int N>
void fill_store(const std::vector<Body>& bodies, CaseSetup<N>& setup);

/// Refuses a formula, called `name`, that has no value where a particle begins (m).
[[noreturn]] void refuse_not_finite(const Table& table, std::string_view key, std::string_view name, const Vec3& at);

}  // namespace undine
