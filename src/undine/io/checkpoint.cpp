#include "undine/io/checkpoint.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <span>
#include <system_error>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/io/atomic_file.hpp"
#include "undine/io/checksum.hpp"
#include "undine/io/hdf5_file.hpp"
#include "undine/io/run_record.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t header_size = 512;  // the smallest user block of HDF5
constexpr int format = 1;
constexpr std::string_view magic = "undine checkpoint\nformat ";

[[noreturn]] void refuse(const fs::path& path, std::string why) {
  throw InputError({.what = fmt::format("'{}' is not a usable checkpoint", path.string()),
                    .why = std::move(why),
                    .fix = "resume from an older checkpoint, or run again from the start"});
}

[[noreturn]] void refuse_name(const std::string& name) {
  throw Error(
      {.what = fmt::format("cannot write '{}' to a checkpoint", name), .why = "a name must hold text without '/'"});
}

std::string header(std::uint64_t size, const std::string& hash) {
  std::string text = fmt::format("{}{}\nbytes {:020}\nxxh64 {}\n", magic, format, size, hash);
  text.resize(header_size, '\0');
  return text;
}

struct Content {
  std::uint64_t size = 0;  // of the whole file
  std::string header;      // the first bytes
  std::string hash;        // of what follows
};

/// `fail` says what it means that the file cannot be read.
template <class Fail>
Content read_content(const fs::path& path, Fail fail) {
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail(std::generic_category().message(errno));
  Content content;
  content.header.resize(header_size);
  stream.read(content.header.data(), header_size);
  content.header.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  content.size = content.header.size();
  Hash64 hash;
  std::vector<char> block(1 << 20);
  while (stream) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto count = static_cast<std::size_t>(stream.gcount());
    hash.add_values(std::span<const char>(block).first(count));
    content.size += count;
  }
  if (stream.bad()) fail("reading it failed part of the way");
  content.hash = hash.text();
  return content;
}

/// Puts the header before what was written. A file that is gone by then could not be written: nobody is to blame for
/// what they asked to read.
void seal(const fs::path& path) {
  const auto fail = [&](const std::string& why) {
    throw Error({.what = fmt::format("cannot write '{}'", path.string()),
                 .why = why,
                 .fix = "check that the folder exists and that you may write to it, and that the disk is not full"});
  };
  const Content content = read_content(path, fail);
  const std::string text = header(content.size, content.hash);
  errno = 0;
  std::fstream stream(path, std::ios::binary | std::ios::in | std::ios::out);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  if (!stream) fail(std::generic_category().message(errno));
}

void verify(const fs::path& path) {
  const Content content = read_content(path, [&](const std::string& why) { refuse(path, why); });
  if (content.size == 0) refuse(path, "it is empty");
  const std::string_view found(content.header);
  if (!found.starts_with(magic)) {
    if (magic.starts_with(found)) refuse(path, fmt::format("it is cut short after {} bytes", content.size));
    refuse(path, "it is not a checkpoint, or its first bytes are damaged");
  }
  const auto rest = found.substr(magic.size());
  if (const auto end = rest.find('\n'); end != rest.npos && rest.substr(0, end) != fmt::format("{}", format))
    refuse(path, fmt::format("its format is {}; this version reads {}", rest.substr(0, end), format));
  const std::string expected = header(content.size, content.hash);
  if (content.header == expected) return;
  const auto size_end = expected.find("\nxxh64");
  if (found.substr(0, size_end) != std::string_view(expected).substr(0, size_end))
    refuse(path, fmt::format("it has {} bytes, which is not the size that was written", content.size));
  refuse(path, "its content does not match its checksum: the file is damaged");
}

void write_frame(Hdf5File& file, const Frame& frame) {
  file.create_group("frame");
  file.write_attribute<double>("frame", "time", frame.time);
  file.write_attribute<std::int64_t>("frame", "step", frame.step);
  file.write_attribute<std::int64_t>("frame", "dimensions", frame.dimensions);
  file.write_attribute<std::int64_t>("frame", "particles", static_cast<std::int64_t>(frame.particles));
  file.write_attribute("frame", "position", frame.position);
  file.create_group("columns");
  for (const Column& column : frame.columns) {
    const std::string name = "columns/" + column.name;
    const auto components = static_cast<std::size_t>(column.components);
    const std::span<const double> values(column.data, frame.particles * components);
    file.write<double>(name, values, {frame.particles, components});
    file.write_attribute(name, "unit", column.unit);
  }
  file.create_group("integers");
  for (const IntColumn& column : frame.integers) {
    const auto write = [&]<class T>(const T* values) {
      file.write<T>("integers/" + column.name, std::span<const T>(values, frame.particles), {frame.particles});
    };
    std::visit(write, column.data);
  }
}

OwnedFrame read_frame(const Hdf5File& file) {
  OwnedFrame frame;
  frame.time = file.read_attribute<double>("frame", "time");
  frame.step = file.read_attribute<std::int64_t>("frame", "step");
  frame.dimensions = static_cast<int>(file.read_attribute<std::int64_t>("frame", "dimensions"));
  frame.particles = static_cast<std::size_t>(file.read_attribute<std::int64_t>("frame", "particles"));
  frame.position = file.read_attribute_text("frame", "position");
  for (const std::string& name : file.names("columns")) {
    const std::string place = "columns/" + name;
    const std::size_t components = file.extent(place).columns;
    frame.columns.push_back({name, file.read_attribute_text(place, "unit"), static_cast<int>(components),
                             file.read<double>(place, {frame.particles, components})});
  }
  for (const std::string& name : file.names("integers")) {
    const std::string place = "integers/" + name;
    OwnedIntColumn column{.name = name, .data = {}};
    if (file.stored_type(place) == -4)
      column.data = file.read<std::int32_t>(place, {frame.particles, 0});
    else
      column.data = file.read<std::int64_t>(place, {frame.particles, 0});
    frame.integers.push_back(std::move(column));
  }
  check(frame.view());
  return frame;
}

template <class Map, class Write>
void write_named(Hdf5File& file, const std::string& group, const Map& map, Write write) {
  file.create_group(group);
  for (const auto& [name, value] : map) {
    if (name.empty() || name == "." || name.find('/') != name.npos || name.find('\0') != name.npos) refuse_name(name);
    write(group + "/" + name, value);
  }
}

void write_state(Hdf5File& file, const CheckpointState& state) {
  file.create_group("state");
  write_named(file, "state/reals", state.reals,
              [&](const std::string& name, double value) { file.write<double>(name, {value}); });
  write_named(file, "state/integers", state.integers,
              [&](const std::string& name, std::int64_t value) { file.write<std::int64_t>(name, {value}); });
  write_named(file, "state/lists", state.lists,
              [&](const std::string& name, const std::vector<double>& values) { file.write<double>(name, values); });
  write_named(file, "state/texts", state.texts,
              [&](const std::string& name, const std::string& text) { file.write_text(name, text); });
}

CheckpointState read_state(const Hdf5File& file) {
  CheckpointState state;
  for (const auto& name : file.names("state/reals"))
    state.reals[name] = file.read<double>("state/reals/" + name, {1, 0})[0];
  for (const auto& name : file.names("state/integers"))
    state.integers[name] = file.read<std::int64_t>("state/integers/" + name, {1, 0})[0];
  for (const auto& name : file.names("state/lists")) state.lists[name] = file.read<double>("state/lists/" + name);
  for (const auto& name : file.names("state/texts")) state.texts[name] = file.read_text("state/texts/" + name);
  return state;
}

}  // namespace

void write_checkpoint(const fs::path& path, const CheckpointData& data) {
  check(data.frame);
  AtomicFile target(path);
  Hdf5File file = Hdf5File::create(target.temporary(), header_size);
  file.write_attribute("/", "program_version", program_version());
  write_frame(file, data.frame);
  write_state(file, data.state);
  file.close();
  seal(target.temporary());
  target.commit();
}

OwnedCheckpoint read_checkpoint(const fs::path& path) {
  verify(path);
  const Hdf5File file = Hdf5File::open(path);
  return {.frame = read_frame(file), .state = read_state(file)};
}

bool is_checkpoint(const fs::path& path) {
  std::string start(magic.size(), '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  return stream && start == magic;
}

}  // namespace undine
