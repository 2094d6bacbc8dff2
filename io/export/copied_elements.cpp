#include "io/export/copied_elements.h"

#include <algorithm>

namespace volumen {

namespace {

struct TagRange {
  std::uint32_t first, last;
};

// These attributes hold for any slice with the same content. Most are from PS3.3 C.7.1 to C.7.5 and
// acquisition (C.8).
constexpr TagRange copiedTags[] = {
    {0x00080008, 0x00080008},  // ImageType
    {0x00080020, 0x00080023},  // dates of study, series, acquisition, content
    {0x0008002a, 0x0008002a},  // AcquisitionDateTime
    {0x00080030, 0x00080033},  // times
    {0x00080050, 0x00080051},  // AccessionNumber and its issuer
    {0x00080070, 0x0008009d},  // manufacturer, institution, referring and consulting physicians
    {0x00080201, 0x00080201},  // TimezoneOffsetFromUTC
    {0x00081010, 0x00081110},  // station, descriptions, physicians, admission, model, referenced study
    {0x00081120, 0x00081120},  // ReferencedPatientSequence
    {0x00082218, 0x00082220},  // anatomic region
    {0x00100010, 0x0010ffff},  // patient
    {0x00120010, 0x0012ffff},  // clinical trial, de-identification
    {0x00180010, 0x00180087},  // contrast agent ... MagneticFieldStrength, SliceThickness
    {0x00180089, 0x00181163},  // acquisition, except SpacingBetweenSlices ...
    {0x00181165, 0x00185fff},  // ... and ImagerPixelSpacing
    {0x00189087, 0x00189087},  // DiffusionBValue
    {0x00189089, 0x00189089},  // DiffusionGradientOrientation
    {0x0018a001, 0x0018a001},  // ContributingEquipmentSequence
    {0x0020000d, 0x0020000d},  // StudyInstanceUID
    {0x00200010, 0x00200012},  // StudyID, numbers of series and acquisition
    {0x00200052, 0x00200052},  // FrameOfReferenceUID
    {0x00200060, 0x00200062},  // laterality
    {0x00200100, 0x00200110},  // temporal position
    {0x00201040, 0x00201040},  // PositionReferenceIndicator
    {0x00204000, 0x00204000},  // ImageComments
    {0x00280051, 0x00280051},  // CorrectedImage
    {0x00280301, 0x00280303},  // burned-in annotation, longitudinal information
    {0x00281050, 0x00281051},  // windows
    {0x00281054, 0x00281056},  // RescaleType, explanation and function of windows
    {0x00282110, 0x00282114},  // lossy compression
    {0x00321000, 0x003210ff},  // request
    {0x00380000, 0x0038ffff},  // visit
    {0x00400241, 0x00400280},  // performed procedure step, RequestAttributesSequence
    {0x00401012, 0x00401012},  // ReasonForPerformedProcedureCodeSequence
    {0x00540012, 0x00540018},  // energy windows, RadiopharmaceuticalInformationSequence
    {0x00540220, 0x00540222},  // view
    {0x00540300, 0x00540500},  // codes of radionuclide, route, orientation
    {0x00541000, 0x00541324},  // PET: series type, units, corrections, frame times
};

constexpr RenamedElement renamedTags[] = {
    {0x00089007, 0x00080008},  // FrameType
    {0x00189074, 0x0008002a},  // FrameAcquisitionDateTime
    {0x00189079, 0x00180082},  // InversionTimes
    {0x00189082, 0x00180081},  // EffectiveEchoTime
    {0x00189241, 0x00180091},  // GradientEchoTrainLength
    {0x00189240, 0x00180091},  // RFEchoTrainLength
    {0x00189328, 0x00181150},  // ExposureTimeInms
    {0x00189330, 0x00181151},  // XRayTubeCurrentInmA
    {0x00189332, 0x00181152},  // ExposureInmAs
};

}  // namespace

bool isCopied(std::uint32_t tag) {
  return std::ranges::any_of(copiedTags, [&](const TagRange& t) { return tag >= t.first && tag <= t.last; });
}

std::span<const RenamedElement> renamedElements() { return renamedTags; }

}  // namespace volumen
