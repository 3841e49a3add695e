#pragma once
// Internal to io/case: the only header that knows toml++.
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "undine/core/error.hpp"
#include "undine/io/case/document.hpp"

namespace undine {

/// How the source of an override is named; such locations have no line.
inline constexpr std::string_view override_prefix = "--set ";

/// A table that was opened through a handle; it may be absent from the file.
struct OpenedTable {
  std::string name;                   ///< dotted path; empty for the top
  const toml::table* node = nullptr;  ///< null: the file lacks it
  std::size_t parent = 0;             ///< id of the table it was asked of
  std::string key;                    ///< its key there
  std::vector<std::string> known;     ///< keys that were asked for, in that order
  std::set<std::string, std::less<>> read;
};

struct CaseState {
  std::string file;              ///< as given, for messages
  std::filesystem::path folder;  ///< where relative paths begin
  toml::table root;
  std::vector<OpenedTable> opened;  ///< [0] is the top
  std::map<std::string, std::size_t, std::less<>> ids;
  std::vector<Document::Resolved> resolved;
  std::set<std::string, std::less<>> resolved_keys;

  std::size_t open(std::string name, const toml::table* node, std::size_t parent, std::string_view key);
  void know(std::size_t id, std::string_view key);
  void resolve(std::size_t id, std::string_view key, std::string value);

  SourceLocation where(const toml::source_region& source) const;
  SourceLocation where(std::size_t id) const;
};

/// "fluid.spacing"
std::string dotted(std::string_view table, std::string_view key);
/// "in [fluid]", or "at the top of the file"
std::string placed(std::string_view table);
/// "the string 'abc'", "an array of 3", for messages
std::string found(const toml::node& node);

}  // namespace undine
