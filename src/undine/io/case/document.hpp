#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "undine/io/case/table.hpp"

namespace undine {

/// A case file (TOML). Use: load it, apply the --set overrides, read everything through root(), then call finish().
/// Copies share one state; not for use from several threads.
class Document {
 public:
  /// A dotted key and the value that was read there, defaults included.
  struct Resolved {
    std::string key;
    std::string value;
  };

  /// @throws InputError if the file is missing, too large, or not TOML (with line and column).
  static Document load(const std::filesystem::path& file);
  /// The same for a text; `name` stands for the file in messages, and its folder is where relative paths begin.
  static Document parse(std::string_view source, const std::filesystem::path& name);

  /// One override, "a.b=value" or "fluid[0].spacing=5 mm": the value is TOML, or else a plain string. Makes tables on
  /// the way as needed. Without a value, "a.b=", it takes the key out of the file. Errors on its value are reported at
  /// "--set a.b". Only before the first call of root().
  /// @throws InputError if it has no '=', or an element of an array is asked for that does not exist.
  void set(std::string_view assignment);

  Table root() const;

  /// @throws InputError that names every key of the file that nobody has read, with the nearest known key.
  void finish() const;

  /// Everything that was read, in the order of first reading: values in SI units with their unit, strings as they are.
  std::vector<Resolved> resolved() const;
  /// A hash of all of it: equal where two documents ask for the same.
  std::string hash() const;

 private:
  explicit Document(std::shared_ptr<CaseState> state) : state_(std::move(state)) {}

  std::shared_ptr<CaseState> state_;
};

}  // namespace undine
