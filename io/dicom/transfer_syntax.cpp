#include "io/dicom/transfer_syntax.h"

namespace volumen::dicom {
namespace {

constexpr TransferSyntax syntaxTable[] = {
    {"1.2.840.10008.1.2", "Implicit VR Little Endian", Coding::native, {false, false}},
    {"1.2.840.10008.1.2.1", "Explicit VR Little Endian", Coding::native, {}},
    {"1.2.840.10008.1.2.1.99", "Deflated Explicit VR Little Endian", Coding::native, {}, true},
    {"1.2.840.10008.1.2.2", "Explicit VR Big Endian", Coding::native, {true, true}},
    {"1.2.840.10008.1.2.5", "RLE Lossless", Coding::rle, {}},
    {"1.2.840.10008.1.2.4.50", "JPEG Baseline (Process 1)", Coding::jpeg, {}},
    {"1.2.840.10008.1.2.4.51", "JPEG Extended (Process 2 and 4)", Coding::jpeg, {}},
    {"1.2.840.10008.1.2.4.53", "JPEG Spectral Selection (Process 6 and 8)", Coding::jpeg, {}},
    {"1.2.840.10008.1.2.4.55", "JPEG Full Progression (Process 10 and 12)", Coding::jpeg, {}},
    {"1.2.840.10008.1.2.4.57", "JPEG Lossless (Process 14)", Coding::jpeg, {}},
    {"1.2.840.10008.1.2.4.70", "JPEG Lossless (Process 14, Selection Value 1)", Coding::jpeg, {}},
    {"1.2.840.10008.1.2.4.80", "JPEG-LS Lossless", Coding::jpegLs, {}},
    {"1.2.840.10008.1.2.4.81", "JPEG-LS Near-Lossless", Coding::jpegLs, {}},
    {"1.2.840.10008.1.2.4.90", "JPEG 2000 Lossless", Coding::jpeg2000, {}},
    {"1.2.840.10008.1.2.4.91", "JPEG 2000", Coding::jpeg2000, {}},
    {"1.2.840.10008.1.2.4.201", "High-Throughput JPEG 2000 Lossless", Coding::jpeg2000, {}},
    {"1.2.840.10008.1.2.4.202", "High-Throughput JPEG 2000 Lossless with RPCL", Coding::jpeg2000, {}},
    {"1.2.840.10008.1.2.4.203", "High-Throughput JPEG 2000", Coding::jpeg2000, {}},
    {"1.2.840.10008.1.2.4.92", "JPEG 2000 Part 2 Multi-component Lossless", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.93", "JPEG 2000 Part 2 Multi-component", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.94", "JPIP Referenced", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.95", "JPIP Referenced Deflate", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.100", "MPEG2 Main Profile, Main Level", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.101", "MPEG2 Main Profile, High Level", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.102", "MPEG-4 AVC/H.264 High Profile", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.103", "MPEG-4 AVC/H.264 BD-compatible High Profile", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.104", "MPEG-4 AVC/H.264 High Profile for 2D Video", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.105", "MPEG-4 AVC/H.264 High Profile for 3D Video", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.106", "MPEG-4 AVC/H.264 Stereo High Profile", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.107", "HEVC/H.265 Main Profile", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.108", "HEVC/H.265 Main 10 Profile", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.110", "JPEG XL Lossless", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.111", "JPEG XL JPEG Recompression", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.112", "JPEG XL", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.204", "JPIP HTJ2K Referenced", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.4.205", "JPIP HTJ2K Referenced Deflate", Coding::unsupported, {}},
    {"1.2.840.10008.1.2.8.1", "Deflated Image Frame Compression", Coding::unsupported, {}},
    {"1.2.840.113619.5.2", "GE Private Implicit VR Big Endian", Coding::unsupported, {false, false}},
};

}  // namespace

TransferSyntax transferSyntax(const std::string& uid) {
  for (const TransferSyntax& syntax : syntaxTable)
    if (uid == syntax.uid) return syntax;
  return {"", "", Coding::unsupported, {}};
}

}  // namespace volumen::dicom
