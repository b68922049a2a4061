// In place of the reader where libsdformat was not found.
#include "convert/sdf/read_sdf.hpp"

namespace plumb::harness {

Imported read_sdf(const ModelFolders& folders) {
  throw UsageError(
      folders.file.string() +
      ": this program was built without libsdformat, which reads SDF and URDF; install libsdformat-dev and "
      "build it again");
}

}  // namespace plumb::harness
