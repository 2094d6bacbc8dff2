#include "io/export/dicom_series.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <glm/geometric.hpp>
#include <span>

#include "io/export/dicom_uid.h"
#include "io/files/aside.h"
#include "io/files/output_file.h"

namespace volumen {

namespace {

namespace fs = std::filesystem;

// The samples of a slice, as 16-bit words; signed ones as their bits.
struct Pixels {
  std::vector<std::uint16_t> words;
  bool isSigned = false;
};

struct Attribute {
  DcmTagKey tag;
  DcmEVR vr;
  std::string value;
};

// The decimal string (VR DS, at most 16 characters) nearest to a number, as short as says the same.
// + 0.0 takes the sign off a zero.
std::string decimal(double value) {
  constexpr std::ptrdiff_t longest = 16;
  char text[32];
  const auto print = [&](auto... precision) {
    return std::to_chars(text, std::end(text), value + 0.0, precision...).ptr - text;
  };
  std::ptrdiff_t length = print();
  for (int digits = 16; length > longest; --digits) length = print(std::chars_format::general, digits);
  return std::string(text, std::size_t(length));
}

// One more value of a DICOM string of several.
void append(std::string& values, const std::string& value) {
  if (!values.empty()) values += '\\';
  values += value;
}

std::string decimals(std::initializer_list<double> values) {
  std::string text;
  for (double v : values) append(text, decimal(v));
  return text;
}

const char* sopClass(const Volume& volume) {
  if (volume.attributes().modality == "CT") return UID_CTImageStorage;
  if (volume.attributes().modality == "MR") return UID_MRImageStorage;
  return UID_SecondaryCaptureImageStorage;
}

Status checkRepresentable(const Volume& volume) {
  const std::string& name = volume.attributes().name;
  const VoxelGeometry& g = volume.geometry();
  if (!g.calibrated)
    return Error{name + " is not calibrated: a DICOM series needs positions in mm; write .nrrd instead."};
  if (g.size.x > 65535 || g.size.y > 65535)
    return Error{name + ": DICOM slices have at most 65535 rows and columns."};
  const glm::dvec3 i = glm::normalize(g.patientFromVoxelStep[0]),
                   j = glm::normalize(g.patientFromVoxelStep[1]);
  if (std::abs(glm::dot(i, j)) > 1e-4)
    return Error{name +
                 ": the rows and columns of its slices are not perpendicular, which DICOM cannot say; "
                 "write .nrrd instead."};
  if (const auto* reals = std::get_if<std::vector<float>>(&volume.stored()))
    for (float v : *reals)
      if (v != std::floor(v) || v < -32768 || v > 32767)
        return Error{name +
                     " holds real values that are not whole numbers within 16 bits, which DICOM pixels "
                     "cannot keep exactly; write .nrrd instead."};
  return {};
}

Pixels slicePixels(const Volume& volume, int k) {
  const std::size_t count = std::size_t(volume.size().x) * std::size_t(volume.size().y);
  return std::visit(
      [&](const auto& values) {
        using Sample = typename std::decay_t<decltype(values)>::value_type;
        Pixels pixels;
        pixels.isSigned = std::is_signed_v<Sample>;
        pixels.words.reserve(count);
        for (const Sample v : std::span(values).subspan(std::size_t(k) * count, count))
          pixels.words.push_back(std::uint16_t(std::int32_t(v)));
        return pixels;
      },
      volume.stored());
}

void addWindows(const Volume& volume, const DicomSeriesTags& tags, std::vector<Attribute>& out) {
  std::string centres, widths, names;
  for (const Window& w : volume.attributes().windows) {
    append(centres, decimal(w.centre));
    append(widths, decimal(w.width));
  }
  if (centres.empty()) return;
  for (const std::string& name : tags.windowNames) append(names, name);
  out.push_back({DCM_WindowCenter, EVR_DS, centres});
  out.push_back({DCM_WindowWidth, EVR_DS, widths});
  if (tags.windowNames.size() == volume.attributes().windows.size())
    out.push_back({DCM_WindowCenterWidthExplanation, EVR_LO, names});
}

// PS3.3 A.3, A.4, A.8: what CT, MR and Secondary Capture images ask for beyond what all have.
void addModality(const Volume& volume, const DicomSeriesTags& tags, std::vector<Attribute>& out) {
  const std::string& modality = volume.attributes().modality;
  const bool ct = modality == "CT", mr = modality == "MR";
  out.push_back({DCM_Modality, EVR_CS, ct || mr ? modality : "OT"});
  out.push_back({DCM_ImageType, EVR_CS,
                 ct   ? "DERIVED\\SECONDARY\\AXIAL"
                 : mr ? "DERIVED\\SECONDARY\\OTHER"
                      : "DERIVED\\SECONDARY"});
  if (!ct && !mr) out.push_back({DCM_ConversionType, EVR_CS, "WSD"});
  if (ct) out.push_back({DCM_KVP, EVR_DS, tags.kvp});
  if (mr) {
    out.push_back({DCM_ScanningSequence, EVR_CS, "RM"});
    out.push_back({DCM_SequenceVariant, EVR_CS, "NONE"});
    out.push_back({DCM_ScanOptions, EVR_CS, ""});
    out.push_back({DCM_MRAcquisitionType, EVR_CS, "3D"});
    out.push_back({DCM_EchoTime, EVR_DS, ""});
    out.push_back({DCM_EchoTrainLength, EVR_IS, ""});
  }
  // MR Image Storage has no rescale of its own; it is written all the same where it does something.
  if (!mr || volume.slope() != 1 || volume.intercept() != 0) {
    out.push_back({DCM_RescaleSlope, EVR_DS, decimal(volume.slope())});
    out.push_back({DCM_RescaleIntercept, EVR_DS, decimal(volume.intercept())});
    out.push_back({DCM_RescaleType, EVR_LO, ct ? "HU" : "US"});
  }
}

// What all slices share.
std::vector<Attribute> seriesAttributes(const Volume& volume, const DicomSeriesTags& tags,
                                        const DicomUids& uids) {
  const VoxelGeometry& g = volume.geometry();
  const glm::dvec3 spacing = g.spacing();
  const glm::dvec3 row = g.patientFromVoxelStep[0] / spacing.x,
                   column = g.patientFromVoxelStep[1] / spacing.y;
  const double between = std::abs(glm::dot(glm::cross(row, column), g.patientFromVoxelStep[2]));
  std::vector<Attribute> all = {
      {DCM_SpecificCharacterSet, EVR_CS, "ISO_IR 192"},
      {DCM_SOPClassUID, EVR_UI, sopClass(volume)},
      {DCM_StudyDate, EVR_DA, tags.studyDate},
      {DCM_StudyTime, EVR_TM, ""},
      {DCM_AccessionNumber, EVR_SH, ""},
      {DCM_Manufacturer, EVR_LO, "volumen"},
      {DCM_SoftwareVersions, EVR_LO, "volumen " VOLUMEN_VERSION},
      {DCM_ReferringPhysicianName, EVR_PN, ""},
      {DCM_StudyDescription, EVR_LO, tags.studyDescription},
      {DCM_SeriesDescription, EVR_LO, tags.seriesDescription},
      {DCM_PatientName, EVR_PN, tags.patientName},
      {DCM_PatientID, EVR_LO, tags.patientId},
      {DCM_PatientBirthDate, EVR_DA, ""},
      {DCM_PatientSex, EVR_CS, ""},
      {DCM_SliceThickness, EVR_DS, decimal(between)},
      {DCM_SpacingBetweenSlices, EVR_DS, decimal(between)},
      {DCM_PatientPosition, EVR_CS, tags.patientPosition},
      {DCM_StudyInstanceUID, EVR_UI, tags.studyUid.empty() ? uids.of("study") : tags.studyUid},
      {DCM_SeriesInstanceUID, EVR_UI, uids.of("series")},
      {DCM_StudyID, EVR_SH, "1"},
      {DCM_SeriesNumber, EVR_IS, "1"},
      {DCM_AcquisitionNumber, EVR_IS, "1"},
      {DCM_FrameOfReferenceUID, EVR_UI, uids.of("frame of reference")},
      {DCM_PositionReferenceIndicator, EVR_LO, ""},
      {DCM_ImageOrientationPatient, EVR_DS, decimals({row.x, row.y, row.z, column.x, column.y, column.z})},
      {DCM_PixelSpacing, EVR_DS, decimals({spacing.y, spacing.x})},
      {DCM_PhotometricInterpretation, EVR_CS, "MONOCHROME2"},
  };
  if (!tags.bodyPart.empty()) all.push_back({DCM_BodyPartExamined, EVR_CS, tags.bodyPart});
  if (tags.synthetic) {
    all.push_back({DCM_PatientIdentityRemoved, EVR_CS, "YES"});
    all.push_back({DCM_DeidentificationMethod, EVR_LO, "Synthetic: computed, of no patient"});
    all.push_back({DCM_ManufacturerModelName, EVR_LO, "Synthetic phantom"});
    all.push_back(
        {DCM_ImageComments, EVR_LT, "Synthetic data, computed. Not a patient. Not for clinical use."});
  }
  addModality(volume, tags, all);
  addWindows(volume, tags, all);
  return all;
}

std::vector<Attribute> sliceAttributes(const Volume& volume, int k, const DicomUids& uids) {
  const VoxelGeometry& g = volume.geometry();
  const glm::dvec3 p = g.patientFromVoxel({0, 0, k});
  const glm::dvec3 normal = glm::normalize(glm::cross(g.patientFromVoxelStep[0], g.patientFromVoxelStep[1]));
  return {
      {DCM_SOPInstanceUID, EVR_UI, uids.of(std::to_string(k + 1))},
      {DCM_InstanceNumber, EVR_IS, std::to_string(k + 1)},
      {DCM_ImagePositionPatient, EVR_DS, decimals({p.x, p.y, p.z})},
      {DCM_SliceLocation, EVR_DS, decimal(glm::dot(p, normal))},
  };
}

// DCMTK copies what it is given; it fails only for lack of memory or a wrong VR.
OFCondition fill(DcmDataset& data, const Volume& volume, std::span<const Attribute> series,
                 std::span<const Attribute> slice, const Pixels& pixels) {
  OFCondition done = EC_Normal;
  for (const auto& attributes : {series, slice})
    for (const Attribute& a : attributes)
      if (done.good()) done = data.putAndInsertString(DcmTag(a.tag, a.vr), a.value.c_str());
  const std::pair<DcmTagKey, int> numbers[] = {{DCM_SamplesPerPixel, 1},
                                               {DCM_Rows, volume.size().y},
                                               {DCM_Columns, volume.size().x},
                                               {DCM_BitsAllocated, 16},
                                               {DCM_BitsStored, 16},
                                               {DCM_HighBit, 15},
                                               {DCM_PixelRepresentation, pixels.isSigned ? 1 : 0}};
  for (const auto& [tag, number] : numbers)
    if (done.good()) done = data.putAndInsertUint16(DcmTag(tag, EVR_US), Uint16(number));
  if (done.good())
    done = data.putAndInsertUint16Array(DcmTag(DCM_PixelData, EVR_OW), pixels.words.data(),
                                        static_cast<unsigned long>(pixels.words.size()));
  return done;
}

Status writeSlices(const Volume& volume, const DicomSeriesTags& tags, const fs::path& folder,
                   const Progress& progress, const CancelToken& cancel) {
  const DicomUids uids(volume, tags.patientId + tags.seriesDescription);
  const std::vector<Attribute> series = seriesAttributes(volume, tags, uids);
  for (int k = 0; k < volume.size().z; ++k) {
    if (cancel.cancelled()) return Error{"Interrupted; nothing was written."};
    if (progress) progress("writing slices", std::size_t(k), std::size_t(volume.size().z));
    DcmFileFormat file;
    OFCondition done =
        fill(*file.getDataset(), volume, series, sliceAttributes(volume, k, uids), slicePixels(volume, k));
    char name[32];
    std::snprintf(name, sizeof name, "slice-%05d.dcm", k + 1);
    const std::string path = (folder / name).string();
    errno = 0;
    if (done.good()) done = file.saveFile(OFFilename(path.c_str()), EXS_LittleEndianExplicit);
    if (done.bad())
      return Error{"Cannot write " + std::string(name) +
                   " of the series: " + (errno ? std::strerror(errno) : done.text()) + "."};
  }
  return {};
}

// "out/" and "out" alike.
fs::path targetOf(const std::string& folder) {
  const fs::path target = fs::path(folder).lexically_normal();
  return target.has_filename() ? target : target.parent_path();
}

fs::path parentOf(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

// As long as this lives nobody takes the folder for one that was left behind.
class Claimed {
 public:
  explicit Claimed(const std::string& folder)
      : fd_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    claimAside(fd_);
  }
  ~Claimed() {
    if (fd_ >= 0) ::close(fd_);
  }
  Claimed(const Claimed&) = delete;
  Claimed& operator=(const Claimed&) = delete;

 private:
  int fd_;
};

bool isEmptyOrMissing(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return true;
  return fs::is_directory(folder, error) && fs::is_empty(folder, error);
}

}  // namespace

Status checkDicomFolder(const std::string& folder) {
  const fs::path target = targetOf(folder);
  if (!isEmptyOrMissing(target))
    return Error{folder + " exists and is not an empty folder; name a new one for the DICOM series."};
  const auto probe = OutputFile::create((parentOf(target) / "slice.dcm").string());
  if (probe) return {};
  return Error{"Cannot make the folder " + folder + ": " + parentOf(target).string() +
               " is missing or cannot be written."};
}

DicomSeriesTags dicomTags(const Series& series) {
  DicomSeriesTags tags;
  if (series.format != "phantom") {
    tags.patientName = series.patientName;
    tags.patientId = series.patientId;
    tags.studyUid = series.studyUid;
    tags.studyDate = series.studyDate;
    tags.studyDescription = series.studyDescription;
    tags.seriesDescription = series.description;
    return tags;
  }
  tags.synthetic = true;
  tags.patientName = "Volumen^Sample";
  tags.patientId = "VOLUMEN-SAMPLE";
  tags.studyDescription = "Synthetic phantom";
  tags.seriesDescription = series.description + " (synthetic)";
  if (series.modality == "CT") {
    tags.studyDescription = "Synthetic head CT with contrast";
    tags.bodyPart = "HEAD";
    tags.patientPosition = "HFS";
    tags.kvp = "120";
    tags.windowNames = {"SOFT TISSUE", "BRAIN", "BONE"};
  }
  return tags;
}

Status writeDicomSeries(const Volume& volume, const DicomSeriesTags& tags, const std::string& folder,
                        const Progress& progress, const CancelToken& cancel) {
  if (Status s = checkRepresentable(volume); !s) return s;
  if (Status s = checkDicomFolder(folder); !s) return s;
  const fs::path target = targetOf(folder), parent = parentOf(target);
  sweepAside(parent.string());
  std::string aside = (parent / asideName).string();
  if (!::mkdtemp(aside.data()))
    return Error{"Cannot make the folder " + folder + ": " + std::strerror(errno) + "."};
  const Claimed claimed(aside);
  Status status = writeSlices(volume, tags, aside, progress, cancel);
  std::error_code error;
  if (status) {
    fs::permissions(aside, fs::perms(0777 & ~rightsKept()), error);
    fs::rename(aside, target, error);
    if (error) status = Error{"Cannot make the folder " + folder + ": " + error.message() + "."};
  }
  if (!status) fs::remove_all(aside, error);
  return status;
}

}  // namespace volumen
