#pragma once
#include <hdf5.h>

namespace undine::hdf5 {

/// Makes files created with this access list be written by a driver of our own. HDF5 1.10 crashes at the end of the
/// program if a write fails, say on a full disk. This driver tells HDF5 that all is well, writes nothing more, and
/// leaves the system's error number in `error`, which must outlive the file. Returns a negative number on failure.
herr_t set_writer(hid_t access, int* error);

}  // namespace undine::hdf5
