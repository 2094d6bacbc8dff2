// Fuzzes image files. The first byte selects the format.
#include <array>

#include "io/load.h"
#include "io/open.h"
#include "tests/fuzz/input_file.h"

using namespace volumen;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static std::array<fuzz::InputFile, 12> files{
      {fuzz::InputFile(".nrrd"), fuzz::InputFile(".nhdr"), fuzz::InputFile(".nii"),
       fuzz::InputFile(".nii.gz"), fuzz::InputFile(".mha"), fuzz::InputFile(".mhd"), fuzz::InputFile(".hdr"),
       fuzz::InputFile(".mgh"), fuzz::InputFile(".mgz"), fuzz::InputFile(".gipl"), fuzz::InputFile(".vtk"),
       fuzz::InputFile(".mrc")}};
  if (size == 0) return 0;
  const Result<Study> study = openStudy(files[bytes[0] % files.size()].holding(bytes + 1, size - 1));
  if (!study) return 0;
  for (const Series& series : study->volumes)
    if (std::int64_t(series.acquired.voxelCount()) <= fuzz::mostPixels) (void)loadSeries(series);
  return 0;
}
