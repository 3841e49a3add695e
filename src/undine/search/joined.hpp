#pragma once
#include <algorithm>
#include <array>
#include <string_view>

namespace undine {

/// Texts put together when the program is compiled, for the infos of entries that are combinations.
template <const std::string_view&... parts>
class Joined {
  static constexpr auto letters = [] {
    std::array<char, (parts.size() + ... + 0)> all{};
    auto* next = all.data();
    ((next = std::copy(parts.begin(), parts.end(), next)), ...);
    return all;
  }();

 public:
  static constexpr std::string_view text{letters.data(), letters.size()};
};

}  // namespace undine
