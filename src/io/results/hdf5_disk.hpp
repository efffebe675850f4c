#pragma once

#include <hdf5.h>

namespace holdfast::internal::h5 {

/// What befell the file on disk; must outlive the open file.
struct DiskState {
  int error_number = 0;  ///< `errno` of the first call that failed; 0 when all went well
};

/// Makes files created with the list `access` go to disk by a driver of our own. HDF5 cannot close a file whose last
/// writes fail, and then crashes when the program ends. This driver keeps a failure to itself: it notes the first
/// one in `state`, writes nothing more, and lets HDF5 close in peace. The caller looks at `state`.
void use_disk_driver(hid_t access, DiskState* state);

}  // namespace holdfast::internal::h5
