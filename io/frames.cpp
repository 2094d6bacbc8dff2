#include "io/frames.h"

#include "io/dicom/import.h"

namespace volumen {

Result<Frame> loadFrame(const Image& image, int index) { return dicom::loadFrame(image.path, index); }

Result<Frame> loadFrame(const Series& series, int index) {
  if (series.format != "DICOM") return Error{series.path + ": only DICOM pictures have frames as acquired."};
  if (index < 0 || std::size_t(index) >= series.files.size())
    return Error{series.path + ": there is no slice " + std::to_string(index) + " in " +
                 std::to_string(series.files.size()) + "."};
  return dicom::loadFrame(series.files[std::size_t(index)], series.frames[std::size_t(index)]);
}

}  // namespace volumen
