#include "undine/io/case/document.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "undine/core/nearest.hpp"
#include "undine/io/case/case_state.hpp"
#include "undine/io/checksum.hpp"

namespace undine {
namespace {

constexpr std::uintmax_t largest_file = 64u << 20;  // bytes
constexpr int longest_dotted_key = 1000;            // toml++ recurses over the tables that one makes

[[noreturn]] void refuse(SourceLocation where, std::string what, std::string why, std::string fix) {
  Error::Parts parts;
  parts.what = std::move(what);
  parts.where = std::move(where);
  parts.why = std::move(why);
  parts.fix = std::move(fix);
  throw InputError(std::move(parts));
}

/// Refuses a run of dots that only a very deeply nested key can have.
void check_dots(std::string_view source, const std::string& file) {
  int dots = 0, line = 1;
  for (const char c : source) {
    if (c == '.' && ++dots > longest_dotted_key)
      refuse({.file = file, .line = line}, fmt::format("more than {} dots in a row of words", longest_dotted_key),
             "a dotted key makes one table for each dot", "use fewer dots");
    if (std::string_view(",=[]{}#\n").find(c) != std::string_view::npos) dots = 0;
    line += c == '\n';
  }
}

/// One step of the path of an override: a key, or an index if the key is empty.
struct PathStep {
  std::string key;
  std::size_t index = 0;
};

[[noreturn]] void bad_override(std::string_view path, std::string what, std::string fix) {
  refuse({.file = fmt::format("{}{}", override_prefix, path)}, std::move(what), {}, std::move(fix));
}

/// "fluid[0].spacing" as key, index, key.
std::vector<PathStep> split(std::string_view path) {
  const auto not_a_key = [&] {
    bad_override(path, fmt::format("'{}' is not a key", path), "write it like fluid[0].spacing=0.01");
  };
  std::vector<PathStep> steps;
  for (std::size_t at = 0; at <= path.size(); ++at) {
    auto end = std::min(path.find('.', at), path.size());
    auto part = path.substr(at, end - at);
    const auto bracket = std::min(part.find('['), part.size());
    if (bracket == 0) not_a_key();
    steps.push_back({std::string(part.substr(0, bracket))});
    for (part.remove_prefix(bracket); !part.empty();) {
      std::size_t index = 0;
      const auto [stop, error] = std::from_chars(part.data() + 1, part.data() + part.size(), index);
      if (part[0] != '[' || error != std::errc() || stop == part.data() + part.size() || *stop != ']') not_a_key();
      steps.push_back({{}, index});
      part.remove_prefix(static_cast<std::size_t>(stop + 1 - part.data()));
    }
    at = end;
  }
  if (steps.size() > 64) not_a_key();
  return steps;
}

/// `text` as a node that says it came from that override.
toml::table wrapped(std::string_view text, std::string_view path) {
  return toml::parse(fmt::format("v = {}", text), fmt::format("{}{}", override_prefix, path));
}

toml::table override_value(std::string_view text, std::string_view path) {
  check_dots(text, fmt::format("{}{}", override_prefix, path));
  try {
    if (auto table = wrapped(text, path); table.size() == 1) return table;
  } catch (const toml::parse_error&) {  // not TOML: a plain string
  }
  auto table = wrapped("''", path);
  *table["v"].as_string() = std::string(text);
  return table;
}

/// The node at that step, which is made (as a table) if a key is missing.
toml::node& descend(toml::node& from, const PathStep& step, std::string_view path) {
  if (step.key.empty()) {
    if (from.is_table() && step.index == 0) return from;  // a single table counts as an array of one
    auto* array = from.as_array();
    if (!array)
      bad_override(path, fmt::format("there is no array for [{}], but {}", step.index, found(from)),
                   "leave out the index");
    if (step.index >= array->size())
      bad_override(path, fmt::format("[{}] does not exist: the array has {} elements", step.index, array->size()),
                   "count from 0, and add elements in the case file");
    return (*array)[step.index];
  }
  auto* table = from.as_table();
  if (!table)
    bad_override(path, fmt::format("'{}' cannot be set inside {}", step.key, found(from)),
                 from.is_array() ? "say which element: name[0]." + step.key : "check the path");
  if (auto* node = table->get(step.key)) return *node;
  auto made = wrapped("{}", path);
  return table->insert_or_assign(step.key, std::move(*made["v"].as_table())).first->second;
}

void assign(toml::node& parent, const PathStep& step, toml::node& value, std::string_view path) {
  descend(parent, step, path);  // checks the step
  value.visit([&](auto& typed) {
    if (auto* table = parent.as_table()) {
      if (step.key.empty()) bad_override(path, "a whole table cannot be replaced by index", "set its keys one by one");
      table->insert_or_assign(step.key, std::move(typed));
    } else {
      auto& array = *parent.as_array();
      array.replace(array.cbegin() + static_cast<std::ptrdiff_t>(step.index), std::move(typed));
    }
  });
}

/// Removes the value at the end of the path, if it is there.
void remove(toml::node& root, const std::vector<PathStep>& steps) {
  toml::node* node = &root;
  for (std::size_t k = 0; k + 1 < steps.size() && node; ++k) {
    const PathStep& step = steps[k];
    if (!step.key.empty()) {
      node = node->is_table() ? node->as_table()->get(step.key) : nullptr;
    } else if (node->is_array()) {
      node = node->as_array()->get(step.index);
    } else if (step.index != 0) {
      node = nullptr;
    }
  }
  if (node && node->is_table()) node->as_table()->erase(steps.back().key);
}

struct Unknown {
  SourceLocation where;
  std::string what;
  std::string fix;
};

/// Collects what nobody has read.
class Audit {
 public:
  explicit Audit(const CaseState& state) : state_(state) {}

  std::vector<Unknown> run() {
    table("", state_.root);
    std::stable_sort(unknown_.begin(), unknown_.end(), [](const Unknown& a, const Unknown& b) {
      return std::tie(a.where.line, a.where.column) < std::tie(b.where.line, b.where.column);
    });
    return std::move(unknown_);
  }

 private:
  void table(const std::string& name, const toml::table& node) {
    const auto id = state_.ids.find(name);
    const OpenedTable none;
    const auto& opened = id == state_.ids.end() ? none : state_.opened[id->second];
    for (const auto& [key, value] : node) {
      const auto path = dotted(name, key.str());
      if (!opened.read.contains(key.str())) {
        report(opened.known, name, key, value);
      } else if (const auto* inner = value.as_table()) {
        table(state_.ids.contains(path) ? path : path + "[0]", *inner);
      } else if (const auto* array = value.as_array()) {
        elements(path, *array);
      }
    }
  }

  void elements(const std::string& path, const toml::array& array) {
    for (std::size_t k = 0; k < array.size(); ++k)
      if (const auto* inner = array[k].as_table()) table(fmt::format("{}[{}]", path, k), *inner);
  }

  void report(const std::vector<std::string>& known, const std::string& name, const toml::key& key,
              const toml::node& value) {
    const bool overridden = value.source().path && value.source().path->starts_with(override_prefix);
    const auto where = state_.where(overridden ? value.source() : key.source());
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) {
      const auto what = fmt::format("key '{}' {} is not used with these choices", key.str(), placed(name));
      unknown_.push_back({where, what, "remove it"});
      return;
    }
    const auto best = did_you_mean(key.str(), known);
    const auto valid =
        known.empty() ? std::string("remove it: nothing is read here") : "known keys here: " + listed(known);
    unknown_.push_back({where, fmt::format("unknown key '{}' {}", key.str(), placed(name)),
                        best.empty() ? valid : best + " " + valid});
  }

  const CaseState& state_;
  std::vector<Unknown> unknown_;
};

}  // namespace

Document Document::load(const std::filesystem::path& file) {
  const auto unreadable = [&](std::string why, std::string fix) {
    refuse({.file = file.string()}, "cannot read the case file", std::move(why), std::move(fix));
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) unreadable("there is no such file", "check the path");
  if (std::filesystem::is_directory(status)) unreadable("it is a folder", "name the .toml file in it");
  if (!std::filesystem::is_regular_file(status)) unreadable("it is not an ordinary file", "name a .toml file");
  if (std::filesystem::file_size(file, error) > largest_file)
    unreadable("it is larger than 64 MiB", "keep particle lists in a file of their own");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) unreadable("it cannot be opened", "check its permissions");
  const std::string source{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) unreadable("reading failed", "check the disk");
  return parse(source, file);
}

Document Document::parse(std::string_view source, const std::filesystem::path& name) {
  auto state = std::make_shared<CaseState>();
  state->file = name.string();
  state->folder = name.parent_path();
  check_dots(source, state->file);
  try {
    state->root = toml::parse(source, state->file);
  } catch (const toml::parse_error& error) {
    throw InputError({.what = "this is not valid TOML",
                      .where = state->where(error.source()),
                      .why = std::string(error.description())});
  }
  return Document(std::move(state));
}

void Document::set(std::string_view assignment) {
  if (!state_->opened.empty()) throw std::logic_error("Document::set after Document::root");
  const auto trim = [](std::string_view text) {
    const auto begin = std::min(text.find_first_not_of(" \t"), text.size());
    return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
  };
  const auto equals = assignment.find('=');
  if (equals == std::string_view::npos)
    bad_override(assignment, "an override needs a key and a value", "write --set key=value");
  const auto path = trim(assignment.substr(0, equals));
  const auto steps = split(path);
  if (trim(assignment.substr(equals + 1)).empty()) return remove(state_->root, steps);
  auto value = override_value(trim(assignment.substr(equals + 1)), path);
  toml::node* node = &state_->root;
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) node = &descend(*node, steps[k], path);
  assign(*node, steps.back(), *value.get("v"), path);
}

Table Document::root() const {
  state_->open("", &state_->root, 0, "");
  return {state_, 0};
}

void Document::finish() const {
  const auto unknown = Audit(*state_).run();
  if (unknown.empty()) return;
  std::string others;
  for (std::size_t k = 1; k < unknown.size(); ++k)
    others +=
        fmt::format("{}{}: {} ({})", k == 1 ? "also " : "; ", unknown[k].where.text(), unknown[k].what, unknown[k].fix);
  const auto& first = unknown.front();
  throw InputError({.what = first.what, .where = first.where, .why = others, .fix = first.fix});
}

std::vector<Document::Resolved> Document::resolved() const { return state_->resolved; }

std::string Document::hash() const {
  Hash64 hash;
  for (const auto& [key, value] : resolved()) {
    const std::string line = key + "=" + value + "\n";
    hash.add_values(std::span<const char>(line));
  }
  return hash.text();
}

}  // namespace undine
