#include "tests/bench/scale_data.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>

#include "io/load.h"
#include "io/open.h"
#include "tests/unit/io/dicom_writer.h"

namespace volumen::bench {

namespace {

using tests::DicomPicture;

std::vector<std::uint16_t> noise(std::size_t count, unsigned values) {
  std::mt19937 random(20261129);
  std::vector<std::uint16_t> all(count);
  for (std::uint16_t& value : all) value = std::uint16_t(random() % values);
  return all;
}

// Appends an item to `sequence` that holds a sequence of one item.
DcmItem* itemIn(DcmItem& frame, const DcmTagKey& sequence) {
  auto* item = new DcmItem;
  auto* made = new DcmSequenceOfItems(sequence);
  made->append(item);
  frame.insert(made);
  return item;
}

void addFrames(DcmDataset& data, int slices, int timePoints) {
  auto* frames = new DcmSequenceOfItems(DCM_PerFrameFunctionalGroupsSequence);
  for (int time = 0; time < timePoints; ++time)
    for (int k = 0; k < slices; ++k) {
      auto* frame = new DcmItem;
      itemIn(*frame, DCM_PlanePositionSequence)
          ->putAndInsertString(DCM_ImagePositionPatient, ("0\\0\\" + std::to_string(3 * k)).c_str());
      itemIn(*frame, DCM_FrameContentSequence)
          ->putAndInsertUint32(DCM_TemporalPositionIndex, Uint32(1 + time));
      frames->append(frame);
    }
  data.insert(frames);
  DcmItem* shared = nullptr;
  data.findOrCreateSequenceItem(DCM_SharedFunctionalGroupsSequence, shared);
  itemIn(*shared, DCM_PlaneOrientationSequence)
      ->putAndInsertString(DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
  itemIn(*shared, DCM_PixelMeasuresSequence)->putAndInsertString(DCM_PixelSpacing, "3\\3");
  data.putAndInsertString(DCM_NumberOfFrames, std::to_string(slices * timePoints).c_str());
}

// Replaces `from` wherever it stands by a text that is as long.
void replace(std::vector<std::uint8_t>& bytes, const std::string& from, const std::string& to) {
  if (from.size() != to.size()) throw std::logic_error(to + " is not as long as " + from);
  for (auto at = bytes.begin(); at != bytes.end();) {
    at = std::search(at, bytes.end(), from.begin(), from.end());
    if (at != bytes.end()) at = std::copy(to.begin(), to.end(), at);
  }
}

// `digits` digits of `number`, with zeros in front.
std::string digits(int number, std::size_t digits) {
  const std::string text = std::to_string(number);
  return std::string(digits - text.size(), '0') + text;
}

// Writes a volume of voxels of 1 mm, int16.
void writeRaw(const std::string& path, glm::ivec3 size, const std::vector<std::int16_t>& slices,
              const std::function<int(int)>& sliceAt) {
  std::ofstream out(path, std::ios::binary);
  out << "NRRD0004\ntype: short\ndimension: 3\nsizes: " << size.x << ' ' << size.y << ' ' << size.z
      << "\nendian: little\nencoding: raw\nspace: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) "
         "(0,0,1)\nspace origin: (0,0,0)\n\n";
  const std::size_t voxels = std::size_t(size.x) * std::size_t(size.y);
  for (int k = 0; k < size.z; ++k)
    out.write(reinterpret_cast<const char*>(slices.data() + std::size_t(sliceAt(k)) * voxels),
              std::streamsize(2 * voxels));
  if (!out) throw std::runtime_error("cannot write " + path);
}

}  // namespace

void writeEnhanced(const std::string& path, int timePoints) {
  constexpr int edge = 64, slices = 40;
  DicomPicture picture{
      .seriesUid = enhancedUid, .columns = edge, .rows = edge, .orientation = "", .spacing = ""};
  picture.pixels = noise(std::size_t(edge * edge * slices) * std::size_t(timePoints), 1000);
  picture.edit = [&](DcmDataset& data) {
    data.putAndInsertString(DCM_SOPClassUID, UID_EnhancedMRImageStorage);
    data.putAndInsertString(DCM_Modality, "MR");
    data.findAndDeleteElement(DCM_ImagePositionPatient);
    addFrames(data, slices, timePoints);
  };
  tests::writeDicom(path, picture);
}

void writeSlices(const std::string& folder, int files, int aSeries) {
  const std::string series = "1.2.3.4.700000000", instance = "1.2.3.4.800000000", place = "10\\20\\900000";
  DicomPicture picture{.seriesUid = series, .columns = 8, .rows = 8, .position = {10, 20, 900000}};
  picture.edit = [&](DcmDataset& data) {
    data.putAndInsertString(DCM_SOPInstanceUID, instance.c_str());
    data.putAndInsertString(DCM_Manufacturer, "A manufacturer of scanners");
    data.putAndInsertString(DCM_SeriesDescription, "Thorax 1.0 mm, kernel B70f");
    data.putAndInsertString(DCM_StudyDescription, "CT of thorax and abdomen");
    data.putAndInsertString(DCM_FrameOfReferenceUID, "1.2.3.4.5.6.7.8.9.10");
    data.putAndInsertString(DCM_ConvolutionKernel, "B70f");
    data.putAndInsertString(DCM_ImageType, "ORIGINAL\\PRIMARY\\AXIAL");
    data.putAndInsertString(DCM_AcquisitionTime, "120000.5");
    data.putAndInsertString(DCM_WindowCenter, "40");
    data.putAndInsertString(DCM_WindowWidth, "400");
  };
  const std::string first = folder + "/first.dcm";
  tests::writeDicom(first, picture);
  const std::vector<std::uint8_t> pattern = tests::readAll(first);
  std::filesystem::remove(first);
  for (int n = 0; n < files; ++n) {
    const std::string in = folder + "/series" + digits(n / aSeries, 4);
    if (n % aSeries == 0) std::filesystem::create_directory(in);
    std::vector<std::uint8_t> bytes = pattern;
    replace(bytes, series, "1.2.3.4.7" + digits(n / aSeries, 8));
    replace(bytes, instance, "1.2.3.4.8" + digits(n, 8));
    replace(bytes, place, "10\\20\\" + digits(n % aSeries, 6));
    tests::writeAll(in + "/slice" + digits(n % aSeries, 6) + ".dcm", bytes);
  }
}

void writeRadiograph(const std::string& path, int edge) {
  DicomPicture picture{.columns = edge, .rows = edge, .orientation = ""};
  picture.pixels = noise(std::size_t(edge) * std::size_t(edge), 4096);
  picture.bitsStored = 12;
  picture.edit = [](DcmDataset& data) {
    data.putAndInsertString(DCM_SOPClassUID, UID_DigitalXRayImageStorageForPresentation);
    data.putAndInsertString(DCM_Modality, "DX");
    data.findAndDeleteElement(DCM_ImagePositionPatient);
  };
  tests::writeDicom(path, picture);
}

void writeHead(const std::string& path, int slices) {
  const auto study = openStudy("phantom:ct-head:512");
  const auto loaded = study ? loadSeries(study->volumes.front()) : Result<Loaded>(study.error());
  if (!loaded) throw std::runtime_error(loaded.message());
  const Volume& head = *loaded->drawn;
  std::vector<std::int16_t> values(std::size_t(head.geometry().voxelCount()));
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = std::int16_t(head.valueAt(n));
  const glm::ivec3 size = head.size();
  writeRaw(path, {size.x, size.y, slices}, values, [&](int k) {
    const int at = k % (2 * size.z);
    return at < size.z ? at : 2 * size.z - 1 - at;
  });
}

void writeNoise(const std::string& path) {
  const glm::ivec3 size{512, 512, 138};
  const std::vector<std::uint16_t> values =
      noise(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z), 1000);
  writeRaw(path, size, {values.begin(), values.end()}, [](int k) { return k; });
}

void writeNoiseRecipe(const std::string& path, int segments) {
  std::ofstream out(path);
  out << R"({"volumenRecipe": 1, "name": "Noise", "segments": [)";
  for (int n = 0; n < segments; ++n) out << (n ? ", " : "") << R"({"name": "Part )" << n << "\"}";
  out << R"(], "steps": [)";
  for (int n = 0; n < segments; ++n)
    out << (n ? ", " : "") << R"({"step": "range", "segment": "Part )" << n
        << "\", \"low\": " << 1000 * n / segments << ", \"high\": " << 1000 * (n + 1) / segments - 1 << '}';
  out << "]}\n";
  if (!out) throw std::runtime_error("cannot write " + path);
}

}  // namespace volumen::bench
