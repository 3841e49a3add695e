#include "undine/core/error.hpp"

#include <utility>

#include <fmt/format.h>

namespace undine {
namespace {

std::string compose(const Error::Parts& parts) {
  std::string text;
  if (const auto where = parts.where.text(); !where.empty()) text += where + ": ";
  text += parts.what;
  if (!parts.why.empty()) text += "\n  why: " + parts.why;
  if (!parts.fix.empty()) text += "\n  fix: " + parts.fix;
  return text;
}

}  // namespace

std::string SourceLocation::text() const {
  if (file.empty() || line <= 0) return file;
  if (column <= 0) return fmt::format("{}:{}", file, line);
  return fmt::format("{}:{}:{}", file, line, column);
}

Error::Error(Parts parts) : std::runtime_error(compose(parts)), parts_(std::move(parts)) {}

}  // namespace undine
