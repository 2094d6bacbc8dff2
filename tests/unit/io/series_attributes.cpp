#include "tests/unit/io/series_attributes.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QByteArray>

namespace volumen::tests {
namespace {

using May = SeriesAttribute::May;

void text(DcmItem& data, const DcmTag& tag, const QByteArray& value) {
  data.putAndInsertString(tag, value.constData());
}

void direction(DcmItem& data, const DcmTag& tag, int n) {
  const Float64 units[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  data.putAndInsertFloat64Array(tag, units[n], 3);
}

void number(DcmItem& data, const DcmTag& tag, int value) { text(data, tag, QByteArray::number(value)); }

/// Writes one of four words separated by bars.
void word(DcmItem& data, const DcmTag& tag, const char* words, int n) {
  text(data, tag, QByteArray(words).split('|')[n]);
}

const SeriesAttribute attributes[] = {
    {"EchoTime", [](DcmItem& d, int n) { text(d, DCM_EchoTime, QByteArray::number(2.5 * (n + 1))); }},
    {"EchoNumbers", [](DcmItem& d, int n) { number(d, DCM_EchoNumbers, 1 + 1 * n); }},
    {"TemporalPositionIdentifier",
     [](DcmItem& d, int n) { number(d, DCM_TemporalPositionIdentifier, 1 + 1 * n); }},
    {"NominalPercentageOfCardiacPhase",
     [](DcmItem& d, int n) { d.putAndInsertFloat32(DCM_NominalPercentageOfCardiacPhase, 12.5f * float(n)); }},
    {"NominalPercentageOfRespiratoryPhase",
     [](DcmItem& d, int n) {
       d.putAndInsertFloat32(DCM_NominalPercentageOfRespiratoryPhase, 25.0f * float(n));
     }},
    {"DiffusionBValue", [](DcmItem& d, int n) { d.putAndInsertFloat64(DCM_DiffusionBValue, 500.0 * n); }},
    {"DiffusionBValue",  // GE
     [](DcmItem& d, int n) {
       text(d, DcmTag(0x0043, 0x0010, EVR_LO), "GEMS_PARM_01");
       text(d, DcmTag(0x0043, 0x1039, EVR_IS), QByteArray::number(1000000000 + 500 * n) + "\\8\\0\\0");
     }},
    {"DiffusionBValue",  // Siemens
     [](DcmItem& d, int n) {
       text(d, DcmTag(0x0019, 0x0011, EVR_LO), "SIEMENS MR HEADER");
       text(d, DcmTag(0x0019, 0x110c, EVR_IS), QByteArray::number(400 * n));
     }},
    {"DiffusionBValue",  // Philips
     [](DcmItem& d, int n) {
       text(d, DcmTag(0x2001, 0x0010, EVR_LO), "Philips Imaging DD 001");
       d.putAndInsertFloat32(DcmTag(0x2001, 0x1003, EVR_FL), 300.0f * float(n));
     }},
    {"DiffusionDirectionality",
     [](DcmItem& d, int n) {
       word(d, DCM_DiffusionDirectionality, "NONE|DIRECTIONAL|ISOTROPIC|BMATRIX", n);
     }},
    {"ImageType",
     [](DcmItem& d, int n) {
       word(d, DCM_ImageType,
            "ORIGINAL\\PRIMARY\\M|ORIGINAL\\PRIMARY\\P|DERIVED\\PRIMARY\\W|DERIVED\\PRIMARY\\F", n);
     },
     May::vary},
    {"ComplexImageComponent",
     [](DcmItem& d, int n) { word(d, DCM_ComplexImageComponent, "MAGNITUDE|PHASE|REAL|IMAGINARY", n); }},
    {"AcquisitionContrast",
     [](DcmItem& d, int n) { word(d, DCM_AcquisitionContrast, "T1|T2|FLOW_ENCODED|STIR", n); }},
    {"VolumeBasedCalculationTechnique",
     [](DcmItem& d, int n) { word(d, DCM_VolumeBasedCalculationTechnique, "NONE|MAX_IP|MIN_IP|MEAN", n); }},
    {"ASLContext", [](DcmItem& d, int n) { word(d, DCM_ASLContext, "LABEL|CONTROL|M_ZERO_SCAN|OTHER", n); }},
    {"VelocityEncodingDirection", [](DcmItem& d, int n) { direction(d, DCM_VelocityEncodingDirection, n); }},
    {"ConvolutionKernel",
     [](DcmItem& d, int n) { text(d, DCM_ConvolutionKernel, "B" + QByteArray::number(30 + 20 * n) + "f"); }},
    {"KVP", [](DcmItem& d, int n) { number(d, DCM_KVP, 80 + 20 * n); }},
    {"FlipAngle", [](DcmItem& d, int n) { number(d, DCM_FlipAngle, 3 + 9 * n); }},
    {"SequenceName",
     [](DcmItem& d, int n) { text(d, DCM_SequenceName, "*fl2d" + QByteArray::number(n + 1)); }, May::change},
    {"RepetitionTime", [](DcmItem& d, int n) { number(d, DCM_RepetitionTime, 500 + 150 * n); }, May::vary},
    {"InversionTime", [](DcmItem& d, int n) { number(d, DCM_InversionTime, 100 + 80 * n); }, May::vary},
    {"AcquisitionNumber", [](DcmItem& d, int n) { number(d, DCM_AcquisitionNumber, 1 + 1 * n); }, May::vary},
    {"DiffusionGradientOrientation",
     [](DcmItem& d, int n) { direction(d, DCM_DiffusionGradientOrientation, n); }},
    {"FrameReferenceTime", [](DcmItem& d, int n) { number(d, DCM_FrameReferenceTime, 1000 + 20000 * n); },
     May::vary},
    {"TriggerTime", [](DcmItem& d, int n) { text(d, DCM_TriggerTime, QByteArray::number(33.5 * n)); },
     May::vary},
    {"ActualFrameDuration", [](DcmItem& d, int n) { number(d, DCM_ActualFrameDuration, 1000 + 500 * n); },
     May::vary},
    {"AcquisitionTime",
     [](DcmItem& d, int n) { text(d, DCM_AcquisitionTime, "10" + QByteArray::number(10 + 15 * n) + "05"); },
     May::vary},
    {"ContentTime",
     [](DcmItem& d, int n) { text(d, DCM_ContentTime, "11" + QByteArray::number(10 + 12 * n) + "10.25"); },
     May::vary},
    {"ContrastBolusAgent",
     [](DcmItem& d, int n) { text(d, DCM_ContrastBolusAgent, "AGENT " + QByteArray::number(n)); },
     May::change},
    {"ContrastBolusAgentPhase",
     [](DcmItem& d, int n) {
       word(d, DCM_ContrastBolusAgentPhase, "PRE_CONTRAST|IMMEDIATE|STEADY_STATE|POST_CONTRAST", n);
     },
     May::change},
    {"RescaleSlope",
     [](DcmItem& d, int n) {  // values round to the same floats
       text(d, DCM_RescaleSlope, "1.00000000" + QByteArray::number(n + 1));
       text(d, DCM_RescaleIntercept, "0");
     },
     May::vary},
    {"SliceThickness", [](DcmItem& d, int n) { number(d, DCM_SliceThickness, 1 + 2 * n); }, May::change},
    {"ScanOptions", [](DcmItem& d, int n) { word(d, DCM_ScanOptions, "FS|FC\\FS|PFF|SP", n); }, May::change},
    {"CorrectedImage",
     [](DcmItem& d, int n) { word(d, DCM_CorrectedImage, "DECY|DECY\\ATTN|DECY\\ATTN\\SCAT|NORM", n); },
     May::change},
    {"AttenuationCorrected", [](DcmItem& d, int n) { word(d, DCM_AttenuationCorrected, "YES|NO|A|B", n); },
     May::change},
    {"ReconstructionMethod",
     [](DcmItem& d, int n) { word(d, DCM_ReconstructionMethod, "OSEM|FBP|TOF|PSF", n); }, May::change},
    {"StackID", [](DcmItem& d, int n) { number(d, DCM_StackID, 1 + 1 * n); }, May::change},
    {"FrameLabel", [](DcmItem& d, int n) { word(d, DCM_FrameLabel, "rest|stress|early|late", n); },
     May::change},
    {"SeriesNumber", [](DcmItem& d, int n) { number(d, DCM_SeriesNumber, 3 + 1 * n); }, May::change},
    {"ProtocolName", [](DcmItem& d, int n) { word(d, DCM_ProtocolName, "Head|Neck|Chest|Leg", n); },
     May::change},
    {"SeriesDescription",
     [](DcmItem& d, int n) { word(d, DCM_SeriesDescription, "thick|thin|bone|lung", n); }, May::change},
};

}  // namespace

std::span<const SeriesAttribute> seriesAttributes() { return attributes; }

}  // namespace volumen::tests
