#pragma once
#include <filesystem>
#include <string>

namespace undine {

/// A file that appears under its name only when it is whole. Write to temporary(), in the same folder, then commit();
/// without commit the temporary is removed and an older file of that name is left as it was.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }

  /// Forces the temporary to the disk and gives it its name. Throws Error with the system's reason (such as a full
  /// disk).
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/// Replaces the file at `path` by `text`, whole or not at all. Throws Error.
void write_text_atomically(const std::filesystem::path& path, const std::string& text);

/// The whole file. Throws InputError if it cannot be read, or is larger than 1 GiB.
std::string read_text(const std::filesystem::path& path);

}  // namespace undine
