#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

#include "undine/core/error.hpp"

// What the fuzz targets share. A reader may accept an input or throw an Error that says why not. Anything else (another
// exception, a signal, a sanitizer's report, a hang, too much memory) ends the process, and libFuzzer keeps the input.

namespace undine::fuzz {

/// Calls f, which may refuse the input; whether it did not. A refusal without words counts as a crash.
template <class F>
bool accepted(F&& f) {
  try {
    f();
    return true;
  } catch (const Error& error) {
    if (error.parts().what.empty()) std::abort();
    return false;
  }
}

/// Ends the process where a promise is broken.
inline void require(bool kept) {
  if (!kept) std::abort();
}

/// A folder of this process, removed at its end.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("undine_fuzz_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// The file of that name, which now holds these bytes.
  std::filesystem::path file(const std::string& name, std::string_view bytes) const {
    const auto path = path_ / name;
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    return path;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline const Folder& folder() {
  static const Folder here;
  return here;
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace undine::fuzz
