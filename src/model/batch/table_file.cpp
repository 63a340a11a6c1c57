// Tables in files, by their names.
#include <algorithm>

#include "io/file/bytes.h"
#include "io/hdf5/hdf5_objects.h"
#include "model/batch/table_bytes.h"
#include "rholm/error.h"
#include "rholm/file.h"

namespace rholm {

void write_batch(const BatchTable& table, const std::filesystem::path& path, bool with_coefficients,
                 bool raw_cells) {
  if (path.extension() == ".h5") return write_table_hdf5(table, path);
  if (path != "-" && path.extension() != ".csv") {
    throw Error(ErrorCode::kInvalidInput,
                path.string() + ": a table is written as .h5 (HDF5) or .csv");
  }
  write_file(path, table_csv(table, with_coefficients, raw_cells));
}

BatchTable read_batch(const std::filesystem::path& path) {
  const Bytes file = read_bytes(path);
  const std::string_view bytes(file.view().data(), file.view().size());
  return hdf5::has_signature(bytes) ? parse_table_hdf5(file.view(), path.string())
                                    : parse_table_csv(file.view(), path.string());
}

}  // namespace rholm
