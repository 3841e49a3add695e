#include "undine/io/time_series.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/io/atomic_file.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

std::string label(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

std::string header_line(const std::vector<SeriesColumn>& columns) {
  std::string line;
  for (const SeriesColumn& column : columns) {
    const std::string text = label(column.name, column.unit);
    if (column.name.empty() || column.name.find_first_of("[]#") != text.npos ||
        text.find_first_of(",\"\r\n") != text.npos)
      throw Error({.what = fmt::format("'{}' cannot head a column of a table", text),
                   .why = "names hold text without brackets, '#', commas, quotes and line breaks"});
    line += (line.empty() ? "" : ",") + text;
  }
  return line + "\n";
}

std::string head(const std::vector<SeriesColumn>& columns, const std::vector<std::string>& comments) {
  std::string text;
  for (const std::string& comment : comments) {
    text += "# ";
    for (const char c : comment) text += c == '\n' ? std::string("\n# ") : std::string(1, c);
    text += "\n";
  }
  return text + header_line(columns);
}

std::string_view trim(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const auto start = text.find_first_not_of(blank);
  return start == text.npos ? std::string_view() : text.substr(start, text.find_last_not_of(blank) - start + 1);
}

/// Splits a text at every separator; "a,,b" has three parts.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == text.npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// Without the byte order mark that some programs put before a text.
std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

/// Whether a cell is a number; an empty one is NaN.
bool parse_number(std::string_view cell, double& value) {
  value = std::numeric_limits<double>::quiet_NaN();
  cell = trim(cell);
  if (cell.empty()) return true;
  if (cell.front() == '+' && cell.size() > 1 && cell[1] != '-') cell.remove_prefix(1);
  const auto [end, reason] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (end != cell.data() + cell.size() || reason == std::errc::invalid_argument) return false;
  if (reason != std::errc::result_out_of_range) return true;
  value = std::strtod(std::string(cell).c_str(), nullptr);  // too small counts as zero, too large is refused
  return std::abs(value) < 1;
}

CsvColumn parse_label(std::string_view cell) {
  cell = trim(cell);
  const auto open = cell.rfind('[');
  if (open == cell.npos || cell.back() != ']') return {std::string(cell), {}, {}};
  return {
      std::string(trim(cell.substr(0, open))), std::string(trim(cell.substr(open + 1, cell.size() - open - 2))), {}};
}

std::vector<CsvColumn> parse_header(std::string_view line, const SourceLocation& where) {
  std::vector<CsvColumn> columns;
  for (const std::string_view cell : split(line, ',')) {
    CsvColumn column = parse_label(cell);
    const auto number = std::to_string(columns.size() + 1);
    double value = 0;
    if (column.name.empty()) throw InputError({.what = "column " + number + " has no name", .where = where});
    if (parse_number(column.name, value))
      throw InputError({.what = "a line with the names of the columns is missing",
                        .where = where,
                        .why = fmt::format("the first line starts with the number {}", column.name),
                        .fix = "put a line such as 'time [s],height [m]' before the numbers"});
    if (std::ranges::find(columns, column.name, &CsvColumn::name) != columns.end())
      throw InputError({.what = fmt::format("two columns are called '{}'", column.name), .where = where});
    columns.push_back(std::move(column));
  }
  return columns;
}

void parse_row(std::string_view line, CsvTable& table, SourceLocation where) {
  const auto cells = split(line, ',');
  if (cells.size() != table.columns.size())
    throw InputError({.what = fmt::format("this line has {} cells", cells.size()),
                      .where = where,
                      .why = fmt::format("the first line names {} columns", table.columns.size())});
  for (std::size_t k = 0; k < cells.size(); ++k) {
    double value = 0;
    where.column = static_cast<int>(cells[k].data() - line.data()) + 1;
    if (!parse_number(cells[k], value))
      throw InputError({.what = fmt::format("'{}' is not a number", trim(cells[k])),
                        .where = where,
                        .why = fmt::format("column '{}' holds numbers", table.columns[k].name)});
    table.columns[k].values.push_back(value);
  }
  ++table.rows;
}

bool same_columns(const std::vector<CsvColumn>& found, const std::vector<SeriesColumn>& wanted) {
  return std::ranges::equal(found, wanted,
                            [](const auto& a, const auto& b) { return a.name == b.name && a.unit == b.unit; });
}

/// What is kept of an older file: its comments, its header, and the whole rows up to the time.
std::string kept_text(const fs::path& path, const std::vector<SeriesColumn>& columns, double last_time) {
  std::string text = read_text(path);
  text.resize(text.rfind('\n') == text.npos ? 0 : text.rfind('\n') + 1);  // the last line may be cut short
  const CsvTable table = parse_csv(text, path);
  if (!same_columns(table.columns, columns))
    throw InputError({.what = fmt::format("cannot go on with '{}'", path.string()),
                      .why = fmt::format("its columns differ from '{}'", trim(split(header_line(columns), '\n')[0])),
                      .fix = "resume with the outputs of the earlier run, or write to a new folder"});
  std::string kept;
  bool in_rows = false;
  std::size_t row = 0;
  for (std::string_view line : split(without_mark(text), '\n')) {
    if (line.empty()) continue;
    const bool counts = !trim(line).empty() && trim(line).front() != '#';
    if (counts && in_rows && !(table.columns[0].values[row++] <= last_time)) continue;
    if (counts) in_rows = true;
    kept.append(line).append("\n");
  }
  return kept;
}

}  // namespace

TimeSeries::TimeSeries(fs::path path, std::size_t width) : path_(std::move(path)), width_(width) {
  errno = 0;
  stream_.open(path_, std::ios::binary | std::ios::app);
  if (!stream_)
    throw Error(
        {.what = fmt::format("cannot write '{}'", path_.string()), .why = std::generic_category().message(errno)});
}

TimeSeries TimeSeries::create(const fs::path& path, std::vector<SeriesColumn> columns,
                              const std::vector<std::string>& comments) {
  write_text_atomically(path, head(columns, comments));
  return TimeSeries(path, columns.size());
}

TimeSeries TimeSeries::resume(const fs::path& path, std::vector<SeriesColumn> columns, double last_time,
                              const std::vector<std::string>& comments) {
  if (!fs::exists(path)) return create(path, std::move(columns), comments);
  write_text_atomically(path, kept_text(path, columns, last_time));
  return TimeSeries(path, columns.size());
}

void TimeSeries::add(std::span<const double> row) {
  if (row.size() != width_)
    throw Error({.what = fmt::format("cannot add a row to '{}'", path_.string()),
                 .why = fmt::format("it has {} values for {} columns", row.size(), width_)});
  std::string line = fmt::format("{}\n", fmt::join(row, ","));
  if (std::error_code ignored; !fs::exists(path_, ignored))
    throw Error({.what = fmt::format("'{}' is gone", path_.string()),
                 .why = "it was removed or moved while the run was writing to it; rows would be lost",
                 .fix = "put it back and go on from the last checkpoint with --resume"});
  errno = 0;
  if (!stream_.write(line.data(), static_cast<std::streamsize>(line.size())).flush())
    throw Error({.what = fmt::format("cannot write '{}'", path_.string()),
                 .why = std::generic_category().message(errno),
                 .fix = "check that the disk is not full"});
}

const CsvColumn* CsvTable::find(std::string_view name) const {
  const auto found = std::ranges::find(columns, name, &CsvColumn::name);
  return found == columns.end() ? nullptr : &*found;
}

const CsvColumn& CsvTable::column(std::string_view name) const {
  if (const CsvColumn* found = find(name)) return *found;
  std::string names;
  for (const CsvColumn& each : columns) names += (names.empty() ? "" : ", ") + each.name;
  throw InputError({.what = fmt::format("there is no column '{}'", name),
                    .where = {path.string()},
                    .why = fmt::format("its columns are: {}", names)});
}

CsvTable read_csv(const fs::path& path) { return parse_csv(read_text(path), path); }

CsvTable parse_csv(const std::string& text, const fs::path& name) {
  CsvTable table;
  table.path = name;
  SourceLocation where{.file = name.string()};
  for (const std::string_view line : split(without_mark(text), '\n')) {
    ++where.line;
    const std::string_view content = trim(line);
    if (content.empty() || content.front() == '#') continue;
    if (table.columns.empty())
      table.columns = parse_header(content, where);
    else
      parse_row(line, table, where);
  }
  if (table.columns.empty())
    throw InputError({.what = "this table is empty", .where = {name.string()}, .why = "no line names its columns"});
  return table;
}

}  // namespace undine
