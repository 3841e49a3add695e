#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace undine {

struct Colour {
  double red = 0, green = 0, blue = 0;  ///< 0 to 1, sRGB
};

/// Colours for numbers from 0 to 1.
class ColourMap {
 public:
  /// One of viewer/colour_maps.json, the table that the page of reports has too. Throws InputError naming them.
  static ColourMap find(const std::string& name);
  static std::vector<std::string> names();

  /// Whether it is for values of both signs, with 0 in its middle.
  bool is_signed() const { return signed_; }
  Colour at(double share) const;

 private:
  std::vector<Colour> nodes_;
  bool signed_ = false;
};

}  // namespace undine
