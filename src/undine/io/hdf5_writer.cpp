#include "undine/io/hdf5_writer.hpp"

#include <algorithm>
#include <cerrno>
#include <compare>
#include <cstring>
#include <limits>
#include <memory>
#include <tuple>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

namespace undine::hdf5 {
namespace {

/// HDF5 hands out pointers to the first member.
struct Writer {
  H5FD_t base = {};
  int descriptor = -1;
  int* error = nullptr;
  haddr_t eoa = 0;  // end of what HDF5 has taken
  haddr_t eof = 0;  // end of what it believes to be written
  dev_t device = 0;
  ino_t node = 0;
};

Writer& self(H5FD_t* file) { return *reinterpret_cast<Writer*>(file); }
const Writer& self(const H5FD_t* file) { return *reinterpret_cast<const Writer*>(file); }

H5FD_t* open_file(const char* name, unsigned flags, hid_t access, haddr_t /*largest*/) {
  const auto* info = static_cast<int* const*>(H5Pget_driver_info(access));
  if (info == nullptr || (flags & H5F_ACC_CREAT) == 0) return nullptr;
  auto writer = std::make_unique<Writer>();
  writer->error = *info;
  writer->descriptor = ::open(name, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  struct stat status = {};
  if (writer->descriptor < 0 || ::fstat(writer->descriptor, &status) != 0) {
    *writer->error = errno;
    if (writer->descriptor >= 0) ::close(writer->descriptor);
    return nullptr;
  }
  writer->device = status.st_dev;
  writer->node = status.st_ino;
  return &writer.release()->base;
}

herr_t close_file(H5FD_t* file) {
  const std::unique_ptr<Writer> writer(&self(file));
  if (::close(writer->descriptor) != 0 && *writer->error == 0) *writer->error = errno;
  return 0;
}

int compare_files(const H5FD_t* a, const H5FD_t* b) {
  const auto order = std::tie(self(a).device, self(a).node) <=> std::tie(self(b).device, self(b).node);
  return order < 0 ? -1 : order > 0 ? 1 : 0;
}

herr_t query(const H5FD_t* /*file*/, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t get_eoa(const H5FD_t* file, H5FD_mem_t /*type*/) { return self(file).eoa; }
haddr_t get_eof(const H5FD_t* file, H5FD_mem_t /*type*/) { return self(file).eof; }

herr_t set_eoa(H5FD_t* file, H5FD_mem_t /*type*/, haddr_t address) {
  self(file).eoa = address;
  return 0;
}

/// Reads back what was written; zeros where there is nothing.
herr_t read(H5FD_t* file, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t address, size_t size, void* buffer) {
  auto* to = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t count = ::pread(self(file).descriptor, to, size, static_cast<off_t>(address));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && *self(file).error == 0) *self(file).error = errno;
    if (count <= 0) break;
    to += count;
    address += static_cast<haddr_t>(count);
    size -= static_cast<size_t>(count);
  }
  std::memset(to, 0, size);
  return 0;
}

herr_t write(H5FD_t* file, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t address, size_t size, const void* buffer) {
  Writer& writer = self(file);
  writer.eof = std::max(writer.eof, address + size);
  const auto* from = static_cast<const char*>(buffer);
  while (size > 0 && *writer.error == 0) {
    const ssize_t count = ::pwrite(writer.descriptor, from, size, static_cast<off_t>(address));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      *writer.error = count < 0 ? errno : ENOSPC;
      break;
    }
    from += count;
    address += static_cast<haddr_t>(count);
    size -= static_cast<size_t>(count);
  }
  return 0;
}

herr_t truncate(H5FD_t* file, hid_t /*transfer*/, hbool_t /*closing*/) {
  Writer& writer = self(file);
  if (*writer.error == 0 && writer.eoa != writer.eof &&
      ::ftruncate(writer.descriptor, static_cast<off_t>(writer.eoa)) != 0)
    *writer.error = errno;
  writer.eof = writer.eoa;
  return 0;
}

H5FD_class_t describe() {
  H5FD_class_t driver = {};
  driver.name = "undine_writer";
  driver.maxaddr = static_cast<haddr_t>(std::numeric_limits<off_t>::max());
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(int*);
  driver.open = open_file;
  driver.close = close_file;
  driver.cmp = compare_files;
  driver.query = query;
  driver.get_eoa = get_eoa;
  driver.set_eoa = set_eoa;
  driver.get_eof = get_eof;
  driver.read = read;
  driver.write = write;
  driver.truncate = truncate;
  return driver;
}

}  // namespace

herr_t set_writer(hid_t access, int* error) {
  static const H5FD_class_t driver = describe();
  static const hid_t id = H5FDregister(&driver);
  return id < 0 ? -1 : H5Pset_driver(access, id, &error);
}

}  // namespace undine::hdf5
