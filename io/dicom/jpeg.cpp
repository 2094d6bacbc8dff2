#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpls/djdecode.h>
#include <dcmtk/oflog/appender.h>
#include <dcmtk/oflog/spi/logevent.h>

#include <mutex>

#include "io/dicom/codestream.h"
#include "io/dicom/decode.h"
#include "io/worker/serve.h"

namespace volumen::dicom {
namespace {

/// The last warning of the JPEG library on this thread. For missing data the library warns, makes up pixels
/// and reports success.
thread_local std::string lastWarning;

class WarningCollector : public dcmtk::log4cplus::Appender {
 public:
  ~WarningCollector() override { destructorImpl(); }
  void close() override { closed = true; }

 protected:
  void append(const dcmtk::log4cplus::spi::InternalLoggingEvent& event) override {
    const std::string text = event.getMessage().c_str();
    const bool lost = text.find("Corrupt JPEG data") != std::string::npos ||
                      text.find("Premature end") != std::string::npos;
    if (lost && text.find("extraneous bytes") == std::string::npos) lastWarning = text;
  }
};

}  // namespace

void registerDecoders() {
  static std::once_flag once;
  std::call_once(once, [] {
    OFLog::configure(OFLogger::OFF_LOG_LEVEL);
    OFLogger logger = OFLog::getLogger("dcmtk.dcmjpeg");
    logger.setLogLevel(OFLogger::WARN_LOG_LEVEL);
    logger.setAdditivity(false);
    logger.addAppender(dcmtk::log4cplus::SharedAppenderPtr(new WarningCollector));
    DJDecoderRegistration::registerCodecs();
    DJLSDecoderRegistration::registerCodecs();
    DcmRLEDecoderRegistration::registerCodecs();
  });
}

namespace {

/// Fills a data set with one compressed picture. Colours are declared as RGB to keep them unconverted.
void fill(DcmDataset& data, const PixelFormat& format, E_TransferSyntax syntax, Bytes bytes) {
  data.putAndInsertUint16(DCM_SamplesPerPixel, Uint16(format.samples));
  data.putAndInsertString(DCM_PhotometricInterpretation, format.samples == 1 ? "MONOCHROME2" : "RGB");
  if (format.samples > 1) data.putAndInsertUint16(DCM_PlanarConfiguration, 0);
  data.putAndInsertUint16(DCM_Rows, Uint16(format.rows));
  data.putAndInsertUint16(DCM_Columns, Uint16(format.columns));
  data.putAndInsertUint16(DCM_BitsAllocated, Uint16(format.bitsAllocated));
  data.putAndInsertUint16(DCM_BitsStored, Uint16(format.bitsStored));
  data.putAndInsertUint16(DCM_HighBit, Uint16(format.highBit));
  data.putAndInsertUint16(DCM_PixelRepresentation, format.isSigned ? 1 : 0);
  auto* sequence = new DcmPixelSequence(DcmTag(DCM_PixelData, EVR_OB));
  sequence->insert(new DcmPixelItem(DcmTag(DCM_Item, EVR_OB)));  // the offset table
  auto* item = new DcmPixelItem(DcmTag(DCM_Item, EVR_OB));
  item->putUint8Array(bytes.data(), Uint32(bytes.size()));
  sequence->insert(item);
  auto* pixels = new DcmPixelData(DCM_PixelData);
  pixels->putOriginalRepresentation(syntax, nullptr, sequence);
  data.insert(pixels);
}

/// Returns the decoded samples as little endian bytes of `bitsAllocated`, whatever width the decoder chose.
std::vector<std::uint8_t> decodedBytes(DcmDataset& data, const PixelFormat& format) {
  Uint16 bits = 0, planar = 0;
  data.findAndGetUint16(DCM_BitsAllocated, bits);
  data.findAndGetUint16(DCM_PlanarConfiguration, planar);
  const Uint8* narrow = nullptr;
  const Uint16* wide = nullptr;
  unsigned long count = 0;
  std::vector<std::uint8_t> bytes;
  if (bits == 8) data.findAndGetUint8Array(DCM_PixelData, narrow, &count);
  if (bits == 16) data.findAndGetUint16Array(DCM_PixelData, wide, &count);
  const std::size_t samples = format.frameSamples(), width = std::size_t(format.bitsAllocated / 8);
  if ((!narrow && !wide) || count < samples || width > 2 || (wide && width < 2)) return {};
  if (wide && !planar) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(wide);
    return {first, first + samples * width};
  }
  bytes.resize(samples * width);
  const std::size_t pixels = format.framePixels(), colours = std::size_t(format.samples);
  for (std::size_t n = 0; n < samples; ++n) {
    const std::size_t at = planar ? n % colours * pixels + n / colours : n;
    const unsigned value = narrow ? narrow[at] : wide[at];
    bytes[n * width] = std::uint8_t(value);
    if (width == 2) bytes[n * 2 + 1] = std::uint8_t(value >> 8);
  }
  return bytes;
}

}  // namespace

Result<std::vector<std::uint8_t>> decodeJpeg(const PixelFormat& format, const TransferSyntax& syntax,
                                             Bytes bytes) {
  const Result<StreamInfo> info = jpegInfo(bytes);
  if (!info) return info.error();
  if (Status s = checkStream(*info, format, bytes.size()); !s) return s.error();
  if (bytes.size() >= undefinedLength) return Error{"its compressed picture is larger than 4 GiB"};
  worker::needAll();
  registerDecoders();
  lastWarning.clear();
  DcmDataset data;
  fill(data, format, DcmXfer(syntax.uid).getXfer(), bytes);
  const OFCondition done = data.chooseRepresentation(EXS_LittleEndianExplicit, nullptr);
  if (done.bad())
    return Error{std::string("its ") + syntax.name + " picture cannot be decoded (" + done.text() + ")"};
  if (!lastWarning.empty())
    return Error{std::string("its ") + syntax.name + " picture is damaged (" + lastWarning + ")"};
  std::vector<std::uint8_t> decoded = decodedBytes(data, format);
  if (decoded.empty()) return Error{std::string("its ") + syntax.name + " picture decodes to the wrong size"};
  return decoded;
}

}  // namespace volumen::dicom
