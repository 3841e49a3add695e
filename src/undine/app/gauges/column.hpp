#pragma once
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "undine/core/nearest.hpp"
#include "undine/io/case/table.hpp"
#include "undine/io/time_series.hpp"

namespace undine::gauges {

/// A column of published data, by the name that the key gives, or else column number k. Throws InputError.
inline const CsvColumn& find_column(const Table& table, std::string_view key, const CsvTable& data,
                                    std::size_t k = std::numeric_limits<std::size_t>::max()) {
  std::vector<std::string> names;
  for (const CsvColumn& column : data.columns) names.push_back(column.name);
  const std::string name = k < names.size() ? table.text(key, names[k]) : table.text(key);
  if (const CsvColumn* found = data.find(name)) return *found;
  table.fail(key, fmt::format("'{}' has no column '{}'", data.path.string(), name),
             fmt::format("its columns are: {}", listed(names)), did_you_mean(name, names));
}

}  // namespace undine::gauges
