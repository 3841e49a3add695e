// Files that the HDF5 library accepts but whose objects are not what they should be: each is refused with an InputError
// that names the object, before memory is taken for what it claims. Fuzzing (tests/fuzz) looks for more of them.
#include <algorithm>
#include <functional>
#include <limits>

#include "io_test.hpp"
#include "undine/io/checkpoint.hpp"
#include "undine/io/checksum.hpp"
#include "undine/io/hdf5_handle.hpp"
#include "undine/io/snapshot.hpp"

namespace undine {
namespace {

using hdf5::Handle;
using test::error_of;
using test::read_bytes;
using test::sample_frame;
using test::TemporaryFolder;
using test::write_bytes;

constexpr hsize_t tera = hsize_t{1} << 40;

Handle space_of(std::vector<hsize_t> sizes) {
  return {
      sizes.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr),
      H5Sclose};
}

struct Shape {
  std::vector<hsize_t> sizes = {};
  bool chunked = false;
};

/// A data set that is claimed, and filled where `values` has something.
void put(hid_t file, const char* name, hid_t type, const Shape& shape, const void* values = nullptr) {
  const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (shape.chunked) {
    std::vector<hsize_t> chunk;
    for (const hsize_t size : shape.sizes) chunk.push_back(std::min<hsize_t>(size, 4));
    H5Pset_chunk(layout.get(), static_cast<int>(chunk.size()), chunk.data());
    H5Pset_deflate(layout.get(), 1);
  }
  const Handle space = space_of(shape.sizes);
  const Handle set(H5Dcreate2(file, name, type, space.get(), H5P_DEFAULT, layout.get(), H5P_DEFAULT), H5Dclose);
  ASSERT_TRUE(set) << name;
  if (values == nullptr) return;
  ASSERT_GE(H5Dwrite(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), 0) << name;
}

void put_attribute(hid_t file, const char* object, const char* name, hid_t type, const std::vector<hsize_t>& sizes,
                   const void* values) {
  if (H5Aexists_by_name(file, object, name, H5P_DEFAULT) > 0) H5Adelete_by_name(file, object, name, H5P_DEFAULT);
  const Handle space = space_of(sizes);
  const Handle at(H5Acreate_by_name(file, object, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                  H5Aclose);
  ASSERT_TRUE(at) << name;
  ASSERT_GE(H5Awrite(at.get(), type, values), 0) << name;
}

/// A file made, or changed, by the library itself.
void with_file(const std::filesystem::path& path, const std::function<void(hid_t)>& change) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const bool old = std::filesystem::exists(path);
  const Handle file(old ? H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)
                        : H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                    H5Fclose);
  ASSERT_TRUE(file);
  change(file.get());
}

/// What reading says; empty where it does not complain.
template <class T>
std::string complaint(const std::filesystem::path& path, const std::string& name) {
  std::string text;
  try {
    Hdf5File::open(path).read<T>(name);
  } catch (const InputError& error) {
    text = error.what();
    EXPECT_NE(text.find(name), text.npos) << text;
  }
  return text;
}

// Criterion: what a data set claims beyond the size of its file, with deflate at its best, is refused; that is said of
// a terabyte within the time of a test, so that no memory was filled.
TEST(HostileHdf5, ClaimsBeyondTheFileAreRefused) {
  const TemporaryFolder folder;
  const auto path = folder / "a.h5";
  const std::vector<double> few(8, 1.0);
  with_file(path, [&](hid_t file) {
    put(file, "never written", H5T_IEEE_F64LE, {{tera}, true});
    put(file, "squared", H5T_IEEE_F64LE, {{tera, tera}, true});
    put(file, "wide", H5T_IEEE_F64LE, {{8, tera}, true});
    put(file, "late", H5T_IEEE_F64LE, {{1000}});
    put(file, "sound", H5T_IEEE_F64LE, {{8}, true}, few.data());
  });
  EXPECT_NE(complaint<double>(path, "never written").find("claims"), std::string::npos);
  EXPECT_NE(complaint<double>(path, "squared").find("claims"), std::string::npos);
  EXPECT_NE(complaint<double>(path, "wide").find("claims"), std::string::npos);
  EXPECT_NE(complaint<double>(path, "late").find("claims"), std::string::npos);
  EXPECT_EQ(complaint<double>(path, "sound"), "");
}

TEST(HostileHdf5, DataInOtherFilesIsNotFollowed) {
  const TemporaryFolder folder;
  const auto path = folder / "a.h5";
  write_bytes(folder / "secret", std::string(64, 'x'));
  with_file(path, [&](hid_t file) {
    const Handle space = space_of({8});
    const Handle outside(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), joined(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_external(outside.get(), (folder / "secret").c_str(), 0, 64);
    H5Pset_virtual(joined.get(), space.get(), (folder / "b.h5").c_str(), "real", space.get());
    for (const auto& [name, properties] : {std::pair("external", outside.get()), std::pair("virtual", joined.get())}) {
      const Handle set(H5Dcreate2(file, name, H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, properties, H5P_DEFAULT),
                       H5Dclose);
      ASSERT_TRUE(set) << name;
    }
    H5Lcreate_external((folder / "b.h5").c_str(), "real", file, "link to elsewhere", H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_NE(complaint<double>(path, "external").find("other files"), std::string::npos);
  EXPECT_NE(complaint<double>(path, "virtual").find("other files"), std::string::npos);
  EXPECT_NE(complaint<double>(path, "link to elsewhere"), "");
}

TEST(HostileHdf5, TypesThatAreNoNumbersOrDoNotFitAreRefused) {
  const TemporaryFolder folder;
  const auto path = folder / "a.h5";
  const std::vector<long double> wide(4, 1.0L);
  const std::vector<std::uint64_t> unsigned_ones(4, 1);
  const std::int32_t big_endian[] = {0x01000000, 0x02000000};
  const hsize_t three = 3;
  with_file(path, [&](hid_t file) {
    const Handle pair(H5Tcreate(H5T_COMPOUND, 16), H5Tclose), list(H5Tvlen_create(H5T_NATIVE_DOUBLE), H5Tclose),
        array(H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, &three), H5Tclose);
    H5Tinsert(pair.get(), "a", 0, H5T_NATIVE_DOUBLE);
    put(file, "wide", H5T_NATIVE_LDOUBLE, {{4}}, wide.data());
    put(file, "unsigned", H5T_STD_U64LE, {{4}}, unsigned_ones.data());
    put(file, "pair", pair.get(), {{4}});
    put(file, "list", list.get(), {{4}});
    put(file, "array", array.get(), {{4}});
    put(file, "reference", H5T_STD_REF_OBJ, {{4}});
    put(file, "big endian", H5T_STD_I32BE, {{2}}, big_endian);
  });
  for (const char* name : {"wide", "pair", "list", "array", "reference"}) {
    EXPECT_NE(complaint<double>(path, name), "") << name;
    EXPECT_NE(complaint<std::int64_t>(path, name), "") << name;
  }
  EXPECT_NE(complaint<std::int64_t>(path, "unsigned").find("may not fit"), std::string::npos);
  EXPECT_EQ(Hdf5File::open(path).read<std::int64_t>("big endian"), (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(Hdf5File::open(path).stored_type("pair"), 0);
}

TEST(HostileHdf5, RanksAndEmptySpaces) {
  const TemporaryFolder folder;
  const auto path = folder / "a.h5";
  const std::vector<double> values(8, 2.5);
  with_file(path, [&](hid_t file) {
    put(file, "cube", H5T_IEEE_F64LE, {{2, 2, 2}}, values.data());
    put(file, "single", H5T_IEEE_F64LE, {}, values.data());
    put(file, "no columns", H5T_IEEE_F64LE, {{5, 0}});
    const Handle nothing(H5Screate(H5S_NULL), H5Sclose);
    const Handle set(H5Dcreate2(file, "null", H5T_IEEE_F64LE, nothing.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                     H5Dclose);
  });
  EXPECT_NE(complaint<double>(path, "cube").find("rank is 3"), std::string::npos);
  const Hdf5File file = Hdf5File::open(path);
  EXPECT_EQ(file.read<double>("single"), (std::vector<double>{2.5}));
  EXPECT_TRUE(file.read<double>("no columns").empty());
  EXPECT_TRUE(file.read<double>("null").empty());
}

TEST(HostileHdf5, TextsAndNamesHaveBounds) {
  const TemporaryFolder folder;
  const auto path = folder / "a.h5";
  const std::string long_name(1500, 'n');
  const double two[] = {1, 2};
  with_file(path, [&](hid_t file) {
    const Handle huge(H5Tcopy(H5T_C_S1), H5Tclose), variable(H5Tcopy(H5T_C_S1), H5Tclose),
        short_one(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(huge.get(), std::size_t{128} << 20);
    H5Tset_size(variable.get(), H5T_VARIABLE);
    H5Tset_size(short_one.get(), 4);
    put(file, "huge", huge.get(), {});
    put(file, "variable", variable.get(), {});
    put(file, "two texts", short_one.get(), {{2}}, "abcdefgh");
    put(file, "no end", short_one.get(), {}, "abcd");
    const Handle group(H5Gcreate2(file, "group", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    put(group.get(), long_name.c_str(), H5T_IEEE_F64LE, {{2}}, two);
    put_attribute(file, "group", "two", H5T_IEEE_F64LE, {2}, two);
    H5Lcreate_soft("nowhere", file, "dangling", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("loop", file, "loop", H5P_DEFAULT, H5P_DEFAULT);
  });
  const Hdf5File file = Hdf5File::open(path);
  EXPECT_NE(error_of([&] { file.read_text("huge"); }).find("claims 134217728 bytes"), std::string::npos);
  EXPECT_NE(error_of([&] { file.read_text("variable"); }).find("fixed length"), std::string::npos);
  EXPECT_NE(error_of([&] { file.read_text("two texts"); }).find("not one text"), std::string::npos);
  EXPECT_EQ(file.read_text("no end"), "abcd");
  EXPECT_NE(error_of([&] { file.names("group"); }).find("too long"), std::string::npos);
  EXPECT_NE(error_of([&] { file.read_attribute<double>("group", "two"); }).find("holds 2 values"), std::string::npos);
  for (const char* link : {"dangling", "loop"}) {
    EXPECT_THROW(file.read<double>(link), InputError);
    EXPECT_THROW(file.names(link), InputError);
    EXPECT_THROW(file.read_attribute<double>(link, "a"), InputError);
  }
}

// Criterion: a checkpoint whose header and checksum are right but whose content is not is refused, or read as a frame
// that does not contradict itself.
class HostileCheckpoint : public testing::Test {
 protected:
  std::string outcome(const std::function<void(hid_t)>& change) {
    const auto path = folder_ / "a.checkpoint";
    write_checkpoint(path, {sample_frame(4, 2).view(), {.lists = {{"memory", {1, 2}}}}});
    with_file(path, change);
    const std::string content = read_bytes(path).substr(512);
    Hash64 hash;
    hash.add_values(std::span<const char>(content));
    std::string header =
        "undine checkpoint\nformat 1\nbytes " + padded(512 + content.size()) + "\nxxh64 " + hash.text() + "\n";
    header.resize(512, '\0');
    write_bytes(path, header + content);
    std::string text;
    try {
      check(read_checkpoint(path).frame.view());
    } catch (const Error& error) {
      text = error.what();
    }
    return text;
  }

  TemporaryFolder folder_;

 private:
  static std::string padded(std::size_t size) {
    const std::string digits = std::to_string(size);
    return std::string(20 - digits.size(), '0') + digits;
  }
};

TEST_F(HostileCheckpoint, WhatItSaysOfItselfMustBeTrue) {
  EXPECT_EQ(outcome([](hid_t) {}), "");  // it is the header that lets the file through
  const auto says = [&](const char* name, std::int64_t value) {
    return outcome([&](hid_t file) { put_attribute(file, "frame", name, H5T_STD_I64LE, {}, &value); });
  };
  for (const std::int64_t particles : {std::int64_t{-1}, std::int64_t{3}, std::int64_t{5}, std::int64_t{1} << 62,
                                       std::numeric_limits<std::int64_t>::min()})
    EXPECT_NE(says("particles", particles), "") << particles;
  for (const std::int64_t dimensions : {0, -2, 1, 3, 4, 1 << 30})
    EXPECT_NE(says("dimensions", dimensions), "") << dimensions;
  EXPECT_NE(says("position", 7), "");
}

TEST_F(HostileCheckpoint, ItsPiecesMustBeThereAndBeWhatTheyAre) {
  for (const char* name : {"frame", "columns", "integers", "state", "columns/x", "state/lists"})
    EXPECT_NE(outcome([&](hid_t file) { H5Ldelete(file, name, H5P_DEFAULT); }), "") << name;
  const auto replaced = [&](const char* name, hid_t type, const Shape& shape) {
    return outcome([&](hid_t file) {
      H5Ldelete(file, name, H5P_DEFAULT);
      put(file, name, type, shape);
    });
  };
  EXPECT_NE(replaced("columns/x", H5T_IEEE_F64LE, {{4}}), "");  // no table
  EXPECT_NE(replaced("columns/x", H5T_IEEE_F64LE, {{tera, 2}, true}), "");
  EXPECT_NE(replaced("columns/x", H5T_STD_I64LE, {{4, 2}}), "");
  EXPECT_NE(replaced("columns", H5T_IEEE_F64LE, {{4}}), "");  // a group that is none
  EXPECT_NE(replaced("integers/id", H5T_IEEE_F64LE, {{4}}), "");
  EXPECT_NE(replaced("integers/id", H5T_STD_I64LE, {{5}}), "");
  EXPECT_NE(replaced("state/lists/memory", H5T_IEEE_F64LE, {{tera}, true}), "");
}

TEST(HostileSnapshot, ItsPiecesMustAgree) {
  const TemporaryFolder folder;
  const auto path = folder / "a.vtkhdf";
  const auto outcome = [&](const std::function<void(hid_t)>& change) {
    write_snapshot(path, sample_frame(4, 2).view());
    with_file(path, change);
    std::string text;
    try {
      check(read_snapshot(path).view());
    } catch (const Error& error) {
      text = error.what();
    }
    return text;
  };
  const auto attribute = [&](const char* object, const char* name, std::int64_t value) {
    return outcome([&](hid_t file) { put_attribute(file, object, name, H5T_STD_I64LE, {}, &value); });
  };
  const auto replaced = [&](const char* name, hid_t type, const Shape& shape, const void* values = nullptr) {
    return outcome([&](hid_t file) {
      H5Ldelete(file, name, H5P_DEFAULT);
      put(file, name, type, shape, values);
    });
  };
  EXPECT_EQ(outcome([](hid_t) {}), "");
  for (const std::int64_t dimensions : {0, 4, -1}) EXPECT_NE(attribute("VTKHDF", "dimensions", dimensions), "");
  EXPECT_NE(attribute("VTKHDF", "dimensions", 3), "");  // its points have two components
  for (const std::int64_t components : {std::int64_t{0}, std::int64_t{4}, std::int64_t{-1}, std::int64_t{1} << 40})
    EXPECT_NE(attribute("VTKHDF/PointData/v", "components", components), "") << components;
  EXPECT_NE(attribute("VTKHDF", "Type", 1), "");
  const std::int64_t five = 5;
  const std::vector<double> values(12, 0.0);
  EXPECT_NE(replaced("VTKHDF/NumberOfPoints", H5T_STD_I64LE, {{1}}, &five), "");
  EXPECT_NE(replaced("VTKHDF/Points", H5T_IEEE_F64LE, {{4, 2}}, values.data()), "");
  EXPECT_NE(replaced("VTKHDF/Points", H5T_IEEE_F64LE, {{tera, 3}, true}), "");
  EXPECT_NE(replaced("VTKHDF/PointData/rho", H5T_IEEE_F64LE, {{5}}, values.data()), "");
  EXPECT_NE(replaced("VTKHDF/PointData/rho", H5T_C_S1, {{4}}, "abcd"), "");
  EXPECT_NE(replaced("VTKHDF/PointData/rho", H5T_IEEE_F64LE, {{4, tera}, true}), "");
  EXPECT_NE(replaced("VTKHDF/PointData/id", H5T_STD_I64LE, {{4, 2}}), "");
  EXPECT_NE(outcome([](hid_t file) { H5Ldelete(file, "VTKHDF/Points", H5P_DEFAULT); }), "");
}

}  // namespace
}  // namespace undine
