#include <algorithm>

#include <fmt/format.h>

#include "undine/io/hdf5_handle.hpp"

namespace undine {

using hdf5::attribute_label;
using hdf5::Handle;
using hdf5::largest_text;
using hdf5::memory_type;
using hdf5::reason;

namespace {

constexpr hsize_t chunk_rows = 65536;
constexpr std::size_t smallest_compressed = 4096;  // bytes

/// A text type of that many bytes (at least one), padded with zeros.
Handle text_type(std::string_view text) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), std::max<std::size_t>(text.size(), 1));
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  const bool ascii = std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 128; });
  H5Tset_cset(type.get(), ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8);
  return type;
}

void set_compression(hid_t properties, int rank, const hsize_t* sizes, int compression) {
  const hsize_t chunk[2] = {std::min(sizes[0], chunk_rows), sizes[1]};
  H5Pset_chunk(properties, rank, chunk);
  H5Pset_shuffle(properties);
  H5Pset_deflate(properties, static_cast<unsigned>(std::min(compression, 9)));
}

}  // namespace

void Hdf5File::create_group(const std::string& name) {
  Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_link_creation_order(properties.get(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_obj_track_times(properties.get(), false);
  const Handle group(H5Gcreate2(id_, name.c_str(), H5P_DEFAULT, properties.get(), H5P_DEFAULT), H5Gclose);
  if (!group) fail(name, reason());
}

template <Hdf5Number T>
void Hdf5File::write(const std::string& name, std::span<const T> values, Hdf5Extent extent, int compression) {
  if (values.size() != extent.size())
    fail(name, fmt::format("{} values for {} x {}", values.size(), extent.rows, extent.columns));
  const int rank = extent.columns == 0 ? 1 : 2;
  const hsize_t sizes[2] = {extent.rows, extent.columns};
  const Handle space(H5Screate_simple(rank, sizes, nullptr), H5Sclose);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  if (compression > 0 && values.size_bytes() >= smallest_compressed)
    set_compression(properties.get(), rank, sizes, compression);
  const hid_t type = memory_type<T>();
  const Handle set(H5Dcreate2(id_, name.c_str(), type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                   H5Dclose);
  if (!set) fail(name, reason());
  if (values.empty()) return;
  if (H5Dwrite(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) fail(name, reason());
  check_written(name);
}

void Hdf5File::write_text(const std::string& name, const std::string& text) {
  if (text.find('\0') != text.npos) fail(name, "the text holds a zero byte");
  if (text.size() > largest_text) fail(name, fmt::format("the text is longer than {} bytes", largest_text));
  const Handle type = text_type(text);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  const Handle set(H5Dcreate2(id_, name.c_str(), type.get(), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                   H5Dclose);
  if (!set || H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) < 0) fail(name, reason());
}

template <Hdf5Number T>
void Hdf5File::write_attribute(const std::string& object, const std::string& name, std::span<const T> values) {
  const hsize_t size = values.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const hid_t type = memory_type<T>();
  const Handle attribute(
      H5Acreate_by_name(id_, object.c_str(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (!attribute || H5Awrite(attribute.get(), type, values.data()) < 0) fail(attribute_label(object, name), reason());
}

template <Hdf5Number T>
void Hdf5File::write_attribute(const std::string& object, const std::string& name, T value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const hid_t type = memory_type<T>();
  const Handle attribute(
      H5Acreate_by_name(id_, object.c_str(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (!attribute || H5Awrite(attribute.get(), type, &value) < 0) fail(attribute_label(object, name), reason());
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name, std::string_view text) {
  const std::string padded(text);
  const Handle type = text_type(text);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate_by_name(id_, object.c_str(), name.c_str(), type.get(), space.get(), H5P_DEFAULT,
                                           H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (!attribute || H5Awrite(attribute.get(), type.get(), padded.c_str()) < 0)
    fail(attribute_label(object, name), reason());
}

#define UNDINE_HDF5_NUMBER(T)                                                                             \
  template void Hdf5File::write<T>(const std::string&, std::span<const T>, Hdf5Extent, int);              \
  template void Hdf5File::write_attribute<T>(const std::string&, const std::string&, std::span<const T>); \
  template void Hdf5File::write_attribute<T>(const std::string&, const std::string&, T);

UNDINE_HDF5_NUMBER(double)
UNDINE_HDF5_NUMBER(float)
UNDINE_HDF5_NUMBER(std::int64_t)
UNDINE_HDF5_NUMBER(std::int32_t)
UNDINE_HDF5_NUMBER(std::uint8_t)
#undef UNDINE_HDF5_NUMBER

}  // namespace undine
