#pragma once
#include <stdexcept>
#include <string>

namespace undine {

/// Where in an input an error was found. Line and column count from 1; 0 means "not known".
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;

  /// "file:line:column", leaving out what is not known.
  std::string text() const;
};

/// An error that a user can act on: what went wrong, where, why, and how to fix it.
/// Libraries throw it; only the program prints it.
class Error : public std::runtime_error {
 public:
  struct Parts {
    std::string what;           ///< one clause: what is wrong
    SourceLocation where = {};  ///< file, line and column, as far as known
    std::string why = {};       ///< the rule that was broken, with the numbers
    std::string fix = {};       ///< what to change
  };

  explicit Error(Parts parts);
  const Parts& parts() const { return parts_; }

 private:
  Parts parts_;
};

/// The user's input is at fault (exit code 2).
class InputError : public Error {
 public:
  using Error::Error;
};

/// The run went bad: not finite, escaped, step collapsed (exit code 3).
class RunError : public Error {
 public:
  using Error::Error;
};

}  // namespace undine
