#include "app/version.h"

#include "viewer/kernels/trace.h"

namespace volumen {

std::string versionText() {
  return std::string("volumen " VOLUMEN_VERSION " (revision ") + revision + ", CPU target " + kernelTarget() +
         ")";
}

}  // namespace volumen
