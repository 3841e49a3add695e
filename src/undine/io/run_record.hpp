#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "undine/io/atomic_file.hpp"

namespace undine {

/// JSON with its keys in the order in which they were set. Include <nlohmann/json.hpp> where one is made.
using Json = nlohmann::ordered_json;

/// Version of this program, such as "0.1.0".
std::string_view program_version();

/// Indented text that ends in a newline. A number that is not finite becomes null; bytes that are not UTF-8 become
/// U+FFFD.
std::string to_text(const Json& json);
/// The same on one line without the newline, for one message of a stream.
std::string to_line(const Json& json);

/// Replaces the file at `path`, whole or not at all. Throws Error.
void write_json(const std::filesystem::path& path, const Json& json);

/// Throws InputError naming the file (and the line of a mistake).
Json read_json(const std::filesystem::path& path);

}  // namespace undine
