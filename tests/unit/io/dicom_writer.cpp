#include "tests/unit/io/dicom_writer.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcrleerg.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djencode.h>
#include <dcmtk/dcmjpls/djencode.h>

#include <QString>
#include <atomic>
#include <fstream>
#include <iterator>
#include <mutex>

namespace volumen::tests {
namespace {

void registerEncoders() {
  static std::once_flag once;
  std::call_once(once, [] {
    OFLog::configure(OFLogger::OFF_LOG_LEVEL);
    DcmRLEEncoderRegistration::registerCodecs();
    DJEncoderRegistration::registerCodecs();
    DJLSEncoderRegistration::registerCodecs(0, 0, 0, 0,
                                            OFFalse);  // raw, as the other mode asserts on signed values
  });
}

void put(DcmDataset& data, const DcmTagKey& tag, const std::string& value) {
  if (!value.empty()) data.putAndInsertOFStringArray(tag, value.c_str());
}

/// Adds slope 1 and intercept 0 to a CT that does not say what its values are.
void addRescale(DcmDataset& data) {
  OFString modality;
  const auto says = [&](const DcmTagKey& tag) { return bool(data.tagExists(tag, OFTrue)); };
  if (data.findAndGetOFString(DCM_Modality, modality).bad() || modality != "CT") return;
  if (says(DCM_RescaleSlope) || says(DCM_RescaleIntercept) || says(DCM_ModalityLUTSequence) ||
      says(DCM_RealWorldValueMappingSequence))
    return;
  put(data, DCM_RescaleSlope, "1");
  put(data, DCM_RescaleIntercept, "0");
}

}  // namespace

std::string newUid() {
  static std::atomic<int> given = 0;
  return "1.2.3.4.6." + std::to_string(++given);
}

void writeDicom(const std::string& path, const DicomPicture& p, const char* transferSyntaxUid) {
  registerEncoders();
  DcmFileFormat file;
  DcmDataset& data = *file.getDataset();
  put(data, DCM_SOPClassUID, UID_CTImageStorage);
  put(data, DCM_SOPInstanceUID, newUid());
  put(data, DCM_StudyInstanceUID, "1.2.3.4");
  put(data, DCM_SeriesInstanceUID, p.seriesUid);
  put(data, DCM_Modality, "CT");
  put(data, DCM_PatientName, "Test^Patient");
  put(data, DCM_InstanceNumber, std::to_string(p.instance));
  const auto number = [](double x) { return QString::number(x, 'g', 12).toStdString(); };
  put(data, DCM_ImagePositionPatient,
      number(p.position.x) + "\\" + number(p.position.y) + "\\" + number(p.position.z));
  put(data, DCM_ImageOrientationPatient, p.orientation);
  put(data, DCM_PixelSpacing, p.spacing);
  put(data, DCM_PhotometricInterpretation, "MONOCHROME2");
  data.putAndInsertUint16(DCM_SamplesPerPixel, 1);
  data.putAndInsertUint16(DCM_Rows, Uint16(p.rows));
  data.putAndInsertUint16(DCM_Columns, Uint16(p.columns));
  data.putAndInsertUint16(DCM_BitsAllocated, 16);
  data.putAndInsertUint16(DCM_BitsStored, Uint16(p.bitsStored));
  data.putAndInsertUint16(DCM_HighBit, Uint16(p.bitsStored - 1));
  data.putAndInsertUint16(DCM_PixelRepresentation, p.isSigned ? 1 : 0);
  std::vector<std::uint16_t> pixels = p.pixels;
  if (pixels.size() < 2) pixels.assign(std::size_t(p.rows * p.columns), pixels.empty() ? 0 : pixels[0]);
  data.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
  if (p.edit) p.edit(data);
  if (p.isRescaled) addRescale(data);
  const E_TransferSyntax syntax = DcmXfer(transferSyntaxUid).getXfer();
  if (data.chooseRepresentation(syntax, nullptr).bad() || file.saveFile(path.c_str(), syntax).bad())
    qFatal("cannot write %s", path.c_str());
}

std::vector<std::uint8_t> readAll(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void writeAll(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

}  // namespace volumen::tests
