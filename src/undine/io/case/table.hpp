#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "undine/core/error.hpp"
#include "undine/core/units.hpp"
#include "undine/io/case/expression.hpp"

namespace undine {

struct CaseState;  // the parsed file and what was asked of it; io/case/case_state.hpp

/// Bounds that a value may also equal, in SI units.
struct Range {
  double low;
  double high;
};

/// One table of a case file: a cheap handle that records every key it is asked for, so that Document::finish can report
/// keys that nobody reads, and Document::resolved can list the values. A table that the file lacks is an empty one:
/// every key takes its default.
///
/// Every reader throws InputError with file, line and column if the value has the wrong type or dimension, is not
/// finite, or is missing without a fallback. Values are in SI units. A fallback is not checked against a range.
class Table {
 public:
  /// Whether the file has this key. Makes the key a known one, but does not count as reading it.
  bool has(std::string_view key) const;
  /// Whether the key holds text, where a list of texts may stand too.
  bool is_text(std::string_view key) const;
  /// Whether the file has this table at all.
  bool exists() const;
  /// The keys in the file, in alphabetical order.
  std::vector<std::string> keys() const;
  /// Dotted path, "fluid[0].shape"; empty for the top of the file.
  std::string name() const;

  /// A plain number without unit.
  double number(std::string_view key, std::optional<double> fallback = {}) const;
  /// A bare number in SI units, or a string with a unit of that dimension ("20 ms").
  double quantity(std::string_view key, Dimension dimension, std::optional<double> fallback = {}) const;
  double positive(std::string_view key, Dimension dimension, std::optional<double> fallback = {}) const;
  double non_negative(std::string_view key, Dimension dimension, std::optional<double> fallback = {}) const;
  double in_range(std::string_view key, Dimension dimension, Range range, std::optional<double> fallback = {}) const;
  /// A whole number; 1e6 is one too.
  std::int64_t integer(std::string_view key, std::optional<std::int64_t> fallback = {}) const;
  bool flag(std::string_view key, std::optional<bool> fallback = {}) const;
  std::string text(std::string_view key, std::optional<std::string> fallback = {}) const;
  /// One of the words in `valid`.
  std::string choice(std::string_view key, const std::vector<std::string>& valid,
                     std::optional<std::string> fallback = {}) const;
  /// A file name, relative to the case file's folder unless absolute. Nothing is opened. The fallback is resolved
  /// likewise.
  std::filesystem::path path(std::string_view key, std::optional<std::string> fallback = {}) const;
  /// A number or a string with a formula of x, y, z, t and the constants. A formula without variables must be finite.
  Expression expression(std::string_view key, const Expression::Constants& constants = {}) const;
  Expression expression(std::string_view key, std::optional<Expression> fallback,
                        const Expression::Constants& constants = {}) const;

  /// Arrays. `count` is the number of elements wanted; -1 takes any number, also none.
  std::vector<double> quantities(std::string_view key, Dimension dimension, int count) const;
  std::vector<double> quantities(std::string_view key, Dimension dimension, int count,
                                 const std::vector<double>& fallback) const;
  std::vector<std::int64_t> integers(std::string_view key, int count) const;
  std::vector<std::int64_t> integers(std::string_view key, int count, const std::vector<std::int64_t>& fallback) const;
  /// Words out of `valid`, each at most once.
  std::vector<std::string> choices(std::string_view key, const std::vector<std::string>& valid) const;
  std::vector<std::string> choices(std::string_view key, const std::vector<std::string>& valid,
                                   const std::vector<std::string>& fallback) const;
  std::vector<Expression> expressions(std::string_view key, int count,
                                      const Expression::Constants& constants = {}) const;
  std::vector<Expression> expressions(std::string_view key, int count, const std::vector<Expression>& fallback,
                                      const Expression::Constants& constants = {}) const;

  /// A formula of the given variables instead of x, y, z and t.
  Expression formula(std::string_view key, const Expression::Variables& variables) const;

  /// Strings of any kind.
  std::vector<std::string> texts(std::string_view key) const;
  std::vector<std::string> texts(std::string_view key, const std::vector<std::string>& fallback) const;

  /// A value on its way into another document, as TOML on one line: Document::set takes "path=text".
  struct Literal {
    std::string path;  ///< dotted key in the other document; empty for an element of an array
    std::string text;  ///< "0.02", "'5 ms'", "[0, 1]"; empty for an empty string, which takes the key out
    SourceLocation where;
  };
  /// The elements of an array, whatever they are.
  std::vector<Literal> literals(std::string_view key) const;
  /// Every value within the table `key`, by its path in there; none if the file lacks it.
  std::vector<Literal> leaves(std::string_view key) const;

  /// A table within this one; an empty one if the file lacks it.
  Table table(std::string_view key) const;
  /// An array of tables ([[key]] or inline); a single table counts as one, a missing key as none.
  std::vector<Table> tables(std::string_view key) const;

  SourceLocation where() const;
  /// The value's location, or this table's if the file lacks the key.
  SourceLocation where(std::string_view key) const;
  /// Refuses the value of a key, for rules that only the caller knows.
  [[noreturn]] void fail(std::string_view key, std::string what, std::string why = {}, std::string fix = {}) const;

 private:
  friend class Document;
  Table(std::shared_ptr<CaseState> state, std::size_t id) : state_(std::move(state)), id_(id) {}

  std::shared_ptr<CaseState> state_;
  std::size_t id_;  ///< of the opened table in the state
};

}  // namespace undine
