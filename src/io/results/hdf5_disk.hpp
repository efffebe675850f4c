#pragma once

#include <hdf5.h>

namespace holdfast::internal::h5 {

/// The state of the file on disk; must outlive the open file.
struct DiskState {
  int error_number = 0;  ///< `errno` of the first call that failed; 0 if there was none
};

/// Makes HDF5 write files created with the property list `access` through a driver of this project. HDF5 cannot close a
/// file whose last writes fail, and then crashes when the program ends. This driver hides failures from HDF5: it stores
/// the first one in `state`, writes nothing more, and HDF5 closes the file normally. The caller checks `state`.
void use_disk_driver(hid_t access, DiskState* state);

}  // namespace holdfast::internal::h5
