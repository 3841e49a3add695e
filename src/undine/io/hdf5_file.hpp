#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace undine {

/// The number types that are stored.
template <class T>
concept Hdf5Number = std::same_as<T, double> || std::same_as<T, float> || std::same_as<T, std::int64_t> ||
    std::same_as<T, std::int32_t> || std::same_as<T, std::uint8_t>;

/// Sizes of a data set: `rows` values (columns == 0: rank one), or a table of rows * columns.
struct Hdf5Extent {
  std::size_t rows = 0;
  std::size_t columns = 0;

  std::size_t size() const { return columns == 0 ? rows : rows * columns; }
  bool operator==(const Hdf5Extent&) const = default;
};

/// An HDF5 file, with its objects named by paths such as "VTKHDF/PointData/rho". Every failure is an Error that names
/// the file, the object and the reason; in reading, an InputError. Sizes and types are checked against the file before
/// any memory is taken. HDF5 prints nothing. For one thread at a time, over all files.
class Hdf5File {
 public:
  /// Creates or replaces a file. The first `user_block` bytes (0, 512, 1024, ...) are left to the caller.
  static Hdf5File create(const std::filesystem::path& path, std::size_t user_block = 0);
  /// Opens a file for reading.
  static Hdf5File open(const std::filesystem::path& path);

  Hdf5File(Hdf5File&& other) noexcept;
  Hdf5File& operator=(Hdf5File&& other) noexcept;
  /// Closes without a word; a writer calls close() to learn of a full disk.
  ~Hdf5File();
  void close();

  // Writing. Parents must exist.
  void create_group(const std::string& name);
  /// `compression`: 0 none, 1 (fast) to 9 (small), with bytes shuffled first; zlib's checksum then guards the data.
  template <Hdf5Number T>
  void write(const std::string& name, std::span<const T> values, Hdf5Extent extent, int compression = 0);
  template <Hdf5Number T>
  void write(const std::string& name, const std::vector<T>& values) {
    write<T>(name, std::span<const T>(values), {values.size(), 0});
  }
  /// One text without zero bytes.
  void write_text(const std::string& name, const std::string& text);
  template <Hdf5Number T>
  void write_attribute(const std::string& object, const std::string& name, std::span<const T> values);
  /// A scalar attribute.
  template <Hdf5Number T>
  void write_attribute(const std::string& object, const std::string& name, T value);
  /// A scalar attribute: fixed-length ASCII (UTF-8 where the text is not ASCII).
  void write_attribute(const std::string& object, const std::string& name, std::string_view text);

  // Reading.
  bool has(const std::string& name) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  /// Names in a group, in the order of creation where the file keeps it, else by name.
  std::vector<std::string> names(const std::string& group) const;
  Hdf5Extent extent(const std::string& name) const;
  /// Bytes of one stored value; negative if whole numbers are stored, positive if real ones, 0 if neither.
  int stored_type(const std::string& name) const;
  /// All values. Real types read real data, whole types whole data that surely fits; anything else is refused.
  template <Hdf5Number T>
  std::vector<T> read(const std::string& name) const;
  /// The same, refusing any other size.
  template <Hdf5Number T>
  std::vector<T> read(const std::string& name, Hdf5Extent expected) const;
  std::string read_text(const std::string& name) const;
  template <Hdf5Number T>
  std::vector<T> read_attributes(const std::string& object, const std::string& name) const;
  /// The only value of an attribute.
  template <Hdf5Number T>
  T read_attribute(const std::string& object, const std::string& name) const;
  std::string read_attribute_text(const std::string& object, const std::string& name) const;

  const std::filesystem::path& path() const { return path_; }

 private:
  using Id = std::int64_t;  // hid_t
  Hdf5File(std::filesystem::path path, Id id, std::unique_ptr<int> write_error);

  bool writing() const { return write_error_ != nullptr; }
  /// After each piece: throws what went wrong in the system since, if anything.
  void check_written(const std::string& object) const;

  [[noreturn]] void fail(const std::string& object, std::string why) const;
  Hdf5Extent extent_of(Id space, const std::string& object) const;
  void check_number_type(Id type, Id wanted, const std::string& object) const;
  std::size_t check_text(Id type, Id space, const std::string& object) const;

  std::filesystem::path path_;
  Id id_ = -1;
  std::unique_ptr<int> write_error_;  // an errno, where the file is being written
};

}  // namespace undine
