#include "fuzz/hdf5_maker.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fuzzer/FuzzedDataProvider.h>

#include "undine/io/hdf5_handle.hpp"

namespace undine::fuzz {
namespace {

using Choices = FuzzedDataProvider;
using hdf5::Handle;

constexpr std::uint64_t most_values = 4096;  // that are written; more are claimed and left out

/// How an object departs from what it should be.
enum class Change { none, gone, type, shape, value, layout, kMaxValue = layout };

struct Made {
  Handle type;
  std::vector<hsize_t> sizes;  ///< empty: one value
  std::int64_t value;
  bool is_compact = false, is_chunked = false, is_empty = false;
};

Handle other_type(Choices& choices) {
  const hid_t plain[] = {H5T_IEEE_F64LE, H5T_IEEE_F32BE, H5T_NATIVE_LDOUBLE, H5T_STD_I64LE,
                         H5T_STD_U64LE,  H5T_STD_I32BE,  H5T_STD_U8LE,       H5T_STD_REF_OBJ};
  const auto which = choices.ConsumeIntegralInRange<std::size_t>(0, std::size(plain) + 3);
  if (which < std::size(plain)) return {H5Tcopy(plain[which]), H5Tclose};
  const hsize_t three = 3;
  switch (which - std::size(plain)) {
    case 0: {
      Handle text(H5Tcopy(H5T_C_S1), H5Tclose);
      H5Tset_size(text.get(),
                  choices.PickValueInArray({std::size_t{1}, std::size_t{16}, std::size_t{70000}, H5T_VARIABLE}));
      return text;
    }
    case 1: {
      Handle pair(H5Tcreate(H5T_COMPOUND, 16), H5Tclose);
      H5Tinsert(pair.get(), "a", 0, H5T_NATIVE_DOUBLE);
      return pair;
    }
    case 2:
      return {H5Tvlen_create(H5T_NATIVE_DOUBLE), H5Tclose};
    default:
      return {H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, &three), H5Tclose};
  }
}

std::vector<hsize_t> other_shape(Choices& choices) {
  std::vector<hsize_t> sizes(choices.ConsumeIntegralInRange<std::size_t>(0, 3));
  for (auto& size : sizes)
    size = choices.ConsumeBool() ? choices.ConsumeIntegralInRange<hsize_t>(0, 20)
                                 : hsize_t{1} << choices.ConsumeIntegralInRange<int>(8, 62);
  return sizes;
}

Handle usual_type(const Hdf5Object& object) {
  if (object.kind == Hdf5Kind::real) return {H5Tcopy(H5T_IEEE_F64LE), H5Tclose};
  if (object.kind == Hdf5Kind::whole) return {H5Tcopy(H5T_STD_I64LE), H5Tclose};
  Handle text(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(text.get(), std::max<std::size_t>(object.text.size(), 1));
  return text;
}

std::vector<hsize_t> usual_shape(const Hdf5Object& object) {
  std::vector<hsize_t> sizes;
  if (object.rows > 0) sizes.push_back(object.rows);
  if (object.columns > 0) sizes.push_back(object.columns);
  return sizes;
}

Handle space_of(const Made& made) {
  if (made.is_empty) return {H5Screate(H5S_NULL), H5Sclose};
  if (made.sizes.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  return {H5Screate_simple(static_cast<int>(made.sizes.size()), made.sizes.data(), nullptr), H5Sclose};
}

/// How many values it claims, but no more than one beyond those that are written.
std::uint64_t count_of(const Made& made) {
  std::uint64_t count = made.is_empty ? 0 : 1;
  for (const auto size : made.sizes)
    count = std::min(count * std::min<std::uint64_t>(size, most_values + 1), most_values + 1);
  return count;
}

/// The bytes of that many values: of numbers or of text, zero where they are something else.
std::vector<char> bytes_of(const Made& made, const Hdf5Object& object, std::uint64_t count) {
  std::vector<char> bytes(count * H5Tget_size(made.type.get()), '\0');
  const auto repeat = [&](const char* from, std::size_t size) {
    for (std::size_t at = 0; size > 0 && at + size <= bytes.size(); at += size)
      std::copy_n(from, size, bytes.data() + at);
  };
  const auto real = static_cast<double>(made.value);
  if (H5Tget_class(made.type.get()) == H5T_STRING) repeat(object.text.data(), object.text.size());
  if (H5Tequal(made.type.get(), H5T_IEEE_F64LE) > 0) repeat(reinterpret_cast<const char*>(&real), sizeof real);
  if (H5Tequal(made.type.get(), H5T_STD_I64LE) > 0)
    repeat(reinterpret_cast<const char*>(&made.value), sizeof made.value);
  return bytes;
}

bool can_be_written(hid_t type) {
  return H5Tget_size(type) <= 1024 && H5Tdetect_class(type, H5T_VLEN) <= 0 && H5Tis_variable_str(type) <= 0 &&
         H5Tget_class(type) != H5T_REFERENCE;
}

void write(hid_t file, const Hdf5Object& object, const Made& made) {
  const Handle space = space_of(made);
  const hid_t type = made.type.get();
  const auto count = count_of(made);
  const bool filled = count <= most_values && can_be_written(type);
  if (!object.attribute.empty()) {
    if (count > most_values) return;
    const Handle at(H5Acreate_by_name(file, object.name.c_str(), object.attribute.c_str(), type, space.get(),
                                      H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                    H5Aclose);
    if (at && filled) H5Awrite(at.get(), type, bytes_of(made, object, count).data());
    return;
  }
  const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (made.is_compact) H5Pset_layout(layout.get(), H5D_COMPACT);
  const std::vector<hsize_t> chunk(made.sizes.size(), 4);
  if ((made.is_chunked || count > most_values) && !chunk.empty()) {
    H5Pset_chunk(layout.get(), static_cast<int>(chunk.size()), chunk.data());
    H5Pset_deflate(layout.get(), 1);
  }
  const Handle set(H5Dcreate2(file, object.name.c_str(), type, space.get(), H5P_DEFAULT, layout.get(), H5P_DEFAULT),
                   H5Dclose);
  if (set && filled) H5Dwrite(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes_of(made, object, count).data());
}

}  // namespace

bool make_hdf5(const std::filesystem::path& path, std::size_t user_block, const std::vector<Hdf5Object>& objects,
               const std::uint8_t* data, std::size_t size) {
  constexpr std::string_view mark = "made";
  if (size < mark.size() || !std::equal(mark.begin(), mark.end(), data)) return false;
  Choices choices(data + mark.size(), size - mark.size());
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose), access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_userblock(creation.get(), user_block);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  const Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
  for (const Hdf5Object& object : objects) {
    const auto change = choices.ConsumeEnum<Change>();
    if (change == Change::gone) continue;
    if (object.kind == Hdf5Kind::group) {
      const Handle group(H5Gcreate2(file.get(), object.name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
      continue;
    }
    Made made{.type = change == Change::type ? other_type(choices) : usual_type(object),
              .sizes = change == Change::shape ? other_shape(choices) : usual_shape(object),
              .value = change == Change::value ? choices.ConsumeIntegral<std::int64_t>() : object.value};
    if (change == Change::layout) {
      made.is_compact = choices.ConsumeBool();
      made.is_chunked = choices.ConsumeBool();
      made.is_empty = choices.ConsumeBool();
    }
    write(file.get(), object, made);
  }
  return true;
}

}  // namespace undine::fuzz
