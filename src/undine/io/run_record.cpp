#include "undine/io/run_record.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "undine/core/error.hpp"

namespace undine {

std::string_view program_version() { return UNDINE_VERSION; }

std::string to_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

std::string to_line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

void write_json(const std::filesystem::path& path, const Json& json) { write_text_atomically(path, to_text(json)); }

Json read_json(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(text.size(), error.byte));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw InputError(
        {.what = "this is not JSON", .where = {path.string(), static_cast<int>(line)}, .why = error.what()});
  }
}

}  // namespace undine
