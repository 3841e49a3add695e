#include <algorithm>
#include <cstring>
#include <limits>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/io/hdf5_handle.hpp"
#include "undine/io/hdf5_writer.hpp"

namespace undine {
namespace hdf5 {

std::string reason() {
  std::string text;
  const auto first = [](unsigned depth, const H5E_error2_t* entry, void* out) -> herr_t {
    if (depth == 0 && entry->desc != nullptr) *static_cast<std::string*>(out) = entry->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, first, &text);
  const std::string key = "error message = '";
  if (const auto start = text.find(key); start != text.npos) {
    const auto end = text.find('\'', start + key.size());
    text = text.substr(start + key.size(), end == text.npos ? end : end - start - key.size());
  }
  return text.empty() ? "HDF5 gave no reason" : text;
}

std::string attribute_label(const std::string& object, const std::string& name) {
  return fmt::format("{}: attribute '{}'", object, name);
}

}  // namespace hdf5

using hdf5::attribute_label;
using hdf5::Handle;
using hdf5::largest_text;
using hdf5::memory_type;
using hdf5::reason;

namespace {

void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

std::string system_reason(int error) { return std::generic_category().message(error); }

Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110);  // its metadata carries checksums
  H5Pset_file_locking(access.get(), 0, 1);                               // some network file systems have no locks
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  return access;
}

}  // namespace

void Hdf5File::fail(const std::string& object, std::string why) const {
  if (writing())
    throw Error({.what = fmt::format("cannot write {} to '{}'", object, path_.string()), .why = std::move(why)});
  throw InputError({.what = fmt::format("cannot read {} from '{}'", object, path_.string()), .why = std::move(why)});
}

Hdf5File Hdf5File::create(const std::filesystem::path& path, std::size_t user_block) {
  silence();
  Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_userblock(creation.get(), user_block);
  H5Pset_link_creation_order(creation.get(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_obj_track_times(creation.get(), false);
  const Handle access = file_access();
  auto error = std::make_unique<int>(0);
  hid_t id = -1;
  if (hdf5::set_writer(access.get(), error.get()) >= 0)
    id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get());
  if (id < 0)
    throw Error({.what = fmt::format("cannot create '{}'", path.string()),
                 .why = *error != 0 ? system_reason(*error) : reason(),
                 .fix = "check that the folder exists, that you may write to it, and that its disk is not full"});
  return Hdf5File(path, id, std::move(error));
}

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
  silence();
  const Handle access = file_access();
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get());
  if (id < 0) throw InputError({.what = fmt::format("cannot read '{}'", path.string()), .why = reason()});
  return Hdf5File(path, id, nullptr);
}

Hdf5File::Hdf5File(std::filesystem::path path, Id id, std::unique_ptr<int> write_error)
    : path_(std::move(path)), id_(id), write_error_(std::move(write_error)) {}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : path_(std::move(other.path_)), id_(std::exchange(other.id_, -1)), write_error_(std::move(other.write_error_)) {}

Hdf5File& Hdf5File::operator=(Hdf5File&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(id_, other.id_);
  std::swap(write_error_, other.write_error_);
  return *this;
}

Hdf5File::~Hdf5File() {
  if (id_ >= 0) H5Fclose(id_);
}

void Hdf5File::close() {
  if (id_ < 0) return;
  if (H5Fclose(std::exchange(id_, -1)) < 0) fail("the last data", reason());
  check_written("the last data");
}

void Hdf5File::check_written(const std::string& object) const {
  if (!writing() || *write_error_ == 0) return;
  throw Error({.what = fmt::format("cannot write {} to '{}'", object, path_.string()),
               .why = system_reason(*write_error_),
               .fix = "free some space, or write to another folder with --out"});
}

bool Hdf5File::has(const std::string& name) const {
  for (std::size_t end = name.find('/');; end = name.find('/', end + 1)) {
    const std::string part = name.substr(0, end);
    if (!part.empty() && H5Lexists(id_, part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == name.npos) return true;
  }
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
  return H5Aexists_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5File::names(const std::string& group) const {
  constexpr hsize_t most = 100'000;
  const Handle opened(H5Gopen2(id_, group.c_str(), H5P_DEFAULT), H5Gclose);
  H5G_info_t info;
  if (!opened || H5Gget_info(opened.get(), &info) < 0) fail(group, reason());
  if (info.nlinks > most) fail(group, fmt::format("it claims {} entries", info.nlinks));
  const Handle properties(H5Gget_create_plist(opened.get()), H5Pclose);
  unsigned order = 0;
  if (properties) H5Pget_link_creation_order(properties.get(), &order);
  const H5_index_t index = (order & H5P_CRT_ORDER_INDEXED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
  std::vector<std::string> found;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    char name[1024];
    const ssize_t size = H5Lget_name_by_idx(opened.get(), ".", index, H5_ITER_INC, k, name, sizeof name, H5P_DEFAULT);
    if (size < 0) fail(group, reason());
    if (static_cast<std::size_t>(size) >= sizeof name) fail(group, "a name in it is too long");
    found.emplace_back(name);
  }
  return found;
}

Hdf5Extent Hdf5File::extent_of(Id space, const std::string& object) const {
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0 || rank > 2) fail(object, fmt::format("its rank is {}; expected at most 2", rank));
  hsize_t sizes[2] = {1, 1};
  if (rank > 0 && H5Sget_simple_extent_dims(space, sizes, nullptr) < 0) fail(object, reason());
  if (H5Sget_simple_extent_type(space) == H5S_NULL) sizes[0] = 0;
  if (sizes[1] != 0 && sizes[0] > std::numeric_limits<hsize_t>::max() / sizes[1] / sizeof(double))
    fail(object, fmt::format("it claims {} x {} values", sizes[0], sizes[1]));
  if (sizes[1] == 0) return {};
  return {sizes[0], rank == 2 ? sizes[1] : 0};
}

Hdf5Extent Hdf5File::extent(const std::string& name) const {
  const Handle set(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set) fail(name, reason());
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  return extent_of(space.get(), name);
}

int Hdf5File::stored_type(const std::string& name) const {
  const Handle set(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set) fail(name, reason());
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  const int size = static_cast<int>(H5Tget_size(type.get()));
  const H5T_class_t kind = H5Tget_class(type.get());
  return kind == H5T_FLOAT ? size : kind == H5T_INTEGER ? -size : 0;
}

void Hdf5File::check_number_type(Id type, Id wanted, const std::string& object) const {
  const H5T_class_t kind = H5Tget_class(type);
  const std::size_t size = H5Tget_size(type);
  const std::size_t room = H5Tget_size(wanted);
  if (H5Tget_class(wanted) == H5T_FLOAT) {
    if (kind != H5T_FLOAT) fail(object, "it does not hold real numbers");
    if (size > room) fail(object, fmt::format("its numbers have {} bytes; expected {} at most", size, room));
    return;
  }
  if (kind != H5T_INTEGER) fail(object, "it does not hold whole numbers");
  const bool has_sign = H5Tget_sign(type) != H5T_SGN_NONE;
  const bool wants_sign = H5Tget_sign(wanted) != H5T_SGN_NONE;
  const bool fits = wants_sign ? (has_sign ? size <= room : size < room) : (!has_sign && size <= room);
  if (!fits) fail(object, fmt::format("its {}-byte whole numbers may not fit", size));
}

template <Hdf5Number T>
std::vector<T> Hdf5File::read(const std::string& name) const {
  const Handle set(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set) fail(name, reason());
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  check_number_type(type.get(), memory_type<T>(), name);
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  const std::size_t count = extent_of(space.get(), name).size();
  if (count == 0) return {};
  const Handle properties(H5Dget_create_plist(set.get()), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(properties.get());
  if (layout == H5D_VIRTUAL || H5Pget_external_count(properties.get()) > 0) fail(name, "its data is in other files");
  // Deflate cannot shrink data more than 1032 times, and no data takes more room than the file: what claims more was
  // never written, or is damaged.
  hsize_t file_size = 0;
  H5Fget_filesize(id_, &file_size);
  const hsize_t stored = std::min<hsize_t>(H5Dget_storage_size(set.get()), file_size);
  if (stored == 0 || count > (65536 + 1040 * std::min<hsize_t>(stored, std::numeric_limits<hsize_t>::max() / 2080)) /
                                 std::max<std::size_t>(H5Tget_size(type.get()), 1))
    fail(name, fmt::format("it claims {} values in {} bytes of a file of {}", count, stored, file_size));
  std::vector<T> values(count);
  if (H5Dread(set.get(), memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) fail(name, reason());
  return values;
}

template <Hdf5Number T>
std::vector<T> Hdf5File::read(const std::string& name, Hdf5Extent expected) const {
  if (const Hdf5Extent found = extent(name); found != expected)
    fail(name, fmt::format("its size is {} x {}; expected {} x {} (0: a plain list)", found.rows, found.columns,
                           expected.rows, expected.columns));
  return read<T>(name);
}

std::size_t Hdf5File::check_text(Id type, Id space, const std::string& object) const {
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0)
    fail(object, "it is not a text of fixed length");
  if (H5Sget_simple_extent_npoints(space) != 1) fail(object, "it is not one text");
  const std::size_t size = H5Tget_size(type);
  if (size > largest_text) fail(object, fmt::format("it claims {} bytes", size));
  return size;
}

std::string Hdf5File::read_text(const std::string& name) const {
  const Handle set(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set) fail(name, reason());
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  std::string text(check_text(type.get(), space.get(), name), '\0');
  if (H5Dread(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0) fail(name, reason());
  text.resize(std::strlen(text.c_str()));
  return text;
}

template <Hdf5Number T>
std::vector<T> Hdf5File::read_attributes(const std::string& object, const std::string& name) const {
  const std::string label = attribute_label(object, name);
  const Handle attribute(H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute) fail(label, reason());
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  check_number_type(type.get(), memory_type<T>(), label);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  const std::size_t count = extent_of(space.get(), label).size();
  if (count * sizeof(T) > largest_text) fail(label, fmt::format("it claims {} values", count));
  std::vector<T> values(count);
  if (count > 0 && H5Aread(attribute.get(), memory_type<T>(), values.data()) < 0) fail(label, reason());
  return values;
}

template <Hdf5Number T>
T Hdf5File::read_attribute(const std::string& object, const std::string& name) const {
  const std::vector<T> values = read_attributes<T>(object, name);
  if (values.size() != 1)
    fail(attribute_label(object, name), fmt::format("it holds {} values; expected one", values.size()));
  return values[0];
}

std::string Hdf5File::read_attribute_text(const std::string& object, const std::string& name) const {
  const std::string label = attribute_label(object, name);
  const Handle attribute(H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute) fail(label, reason());
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  std::string text(check_text(type.get(), space.get(), label), '\0');
  if (H5Aread(attribute.get(), type.get(), text.data()) < 0) fail(label, reason());
  text.resize(std::strlen(text.c_str()));
  return text;
}

#define UNDINE_HDF5_NUMBER(T)                                                                         \
  template std::vector<T> Hdf5File::read<T>(const std::string&) const;                                \
  template std::vector<T> Hdf5File::read<T>(const std::string&, Hdf5Extent) const;                    \
  template std::vector<T> Hdf5File::read_attributes<T>(const std::string&, const std::string&) const; \
  template T Hdf5File::read_attribute<T>(const std::string&, const std::string&) const;

UNDINE_HDF5_NUMBER(double)
UNDINE_HDF5_NUMBER(float)
UNDINE_HDF5_NUMBER(std::int64_t)
UNDINE_HDF5_NUMBER(std::int32_t)
UNDINE_HDF5_NUMBER(std::uint8_t)
#undef UNDINE_HDF5_NUMBER

}  // namespace undine
