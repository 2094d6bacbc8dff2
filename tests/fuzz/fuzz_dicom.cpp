// Fuzzes DICOM files: headers, volumes, frames, objects that refer to pictures, lists of attributes, and
// copies without identity.
#include "io/contours.h"
#include "io/deidentify/deidentify_file.h"
#include "io/dicom/attribute_list.h"
#include "io/frames.h"
#include "io/load.h"
#include "io/open.h"
#include "io/presentation.h"
#include "io/report.h"
#include "io/segmentation.h"
#include "tests/fuzz/input_file.h"

using namespace volumen;

namespace {

void readFrames(const Image& image) {
  if (std::int64_t(image.rows) * image.columns > fuzz::mostPixels) return;
  for (int frame = 0; frame < std::min(image.frames, 3); ++frame) (void)loadFrame(image, frame);
}

void readVolume(const Series& series) {
  if (std::int64_t(series.acquired.voxelCount()) > fuzz::mostPixels) return;
  (void)loadSeries(series);
  (void)loadFrame(series, 0);
}

void readObject(const DerivedObject& object) {
  switch (object.kind) {
    case DerivedKind::presentation:
      return void(loadPresentation(object.path));
    case DerivedKind::keyObjects:
      return void(loadKeyObjects(object.path));
    case DerivedKind::report:
      return void(loadReport(object.path));
    case DerivedKind::contours:
      return void(loadContours(object.path));
    case DerivedKind::segmentation:
      return void(loadSegmentation(object.path));
  }
}

// A copy can be read, and de-identified again.
void readWithoutIdentity(const std::string& path) {
  const std::string copy = path + ".copy", key = "0123456789abcdef";
  const auto file = deidentifiedFile(path, {{.shiftDays = 3}, key}, {});
  if (!file) return;
  if (!writeDeidentified(*file, path, copy) || !isWrittenAt(*file, path, copy)) std::abort();
  if (!deidentifiedFile(copy, {{}, key}, {})) std::abort();
  std::remove(copy.c_str());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static fuzz::InputFile file(".dcm");
  const std::string& path = file.holding(bytes, size);
  const Result<Study> study = openStudy(path);
  if (!study) return 0;
  for (const Series& series : study->volumes) readVolume(series);
  for (const Image& image : study->images) readFrames(image);
  for (const DerivedObject& object : study->derived) readObject(object);
  (void)dicom::listAttributes(path);
  readWithoutIdentity(path);
  return 0;
}
