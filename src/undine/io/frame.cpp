#include "undine/io/frame.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "undine/core/error.hpp"

namespace undine {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw Error({.what = "this particle set cannot be written", .why = why});
}

}  // namespace

void check(const Frame& frame) {
  if (frame.dimensions < 1 || frame.dimensions > 3) refuse(fmt::format("it has {} dimensions", frame.dimensions));
  std::set<std::string> seen;
  const auto check_name = [&](const std::string& name) {
    if (name.empty() || name == "." || name.find('/') != name.npos || name.find('\0') != name.npos)
      refuse(fmt::format("'{}' cannot be the name of a column", name));
    if (!seen.insert(name).second) refuse(fmt::format("two columns are called '{}'", name));
  };
  for (const Column& column : frame.columns) {
    check_name(column.name);
    if (column.components < 1) refuse(fmt::format("'{}' has {} components", column.name, column.components));
    if (column.data == nullptr && frame.particles > 0) refuse(fmt::format("'{}' has no data", column.name));
  }
  for (const IntColumn& column : frame.integers) {
    check_name(column.name);
    const bool empty = std::visit([](auto values) { return values == nullptr; }, column.data);
    if (empty && frame.particles > 0) refuse(fmt::format("'{}' has no data", column.name));
  }
  const auto position = std::ranges::find(frame.columns, frame.position, &Column::name);
  if (position == frame.columns.end()) refuse(fmt::format("it has no position column '{}'", frame.position));
  if (position->components != frame.dimensions)
    refuse(
        fmt::format("'{}' has {} components in {} dimensions", frame.position, position->components, frame.dimensions));
}

Frame OwnedFrame::view() const {
  Frame frame{.time = time, .step = step, .dimensions = dimensions, .particles = particles, .position = position};
  for (const OwnedColumn& column : columns)
    frame.columns.push_back({column.name, column.unit, column.components, column.data.data()});
  for (const OwnedIntColumn& column : integers) {
    IntColumn view{.name = column.name, .data = {}};
    std::visit([&](const auto& values) { view.data = values.data(); }, column.data);
    frame.integers.push_back(std::move(view));
  }
  return frame;
}

const OwnedColumn* OwnedFrame::find(std::string_view name) const {
  const auto found = std::ranges::find(columns, name, &OwnedColumn::name);
  return found == columns.end() ? nullptr : &*found;
}

const OwnedIntColumn* OwnedFrame::find_integers(std::string_view name) const {
  const auto found = std::ranges::find(integers, name, &OwnedIntColumn::name);
  return found == integers.end() ? nullptr : &*found;
}

OwnedFrame copy(const Frame& frame) {
  check(frame);
  OwnedFrame owned{.time = frame.time,
                   .step = frame.step,
                   .dimensions = frame.dimensions,
                   .particles = frame.particles,
                   .position = frame.position};
  for (const Column& column : frame.columns) {
    const std::size_t count = frame.particles * static_cast<std::size_t>(column.components);
    owned.columns.push_back({column.name, column.unit, column.components, {column.data, column.data + count}});
  }
  for (const IntColumn& column : frame.integers) {
    OwnedIntColumn made{.name = column.name, .data = {}};
    std::visit([&](auto values) { made.data = std::vector(values, values + frame.particles); }, column.data);
    owned.integers.push_back(std::move(made));
  }
  return owned;
}

}  // namespace undine
