// Fuzzes the coded bytes of one frame. The end of the input describes the picture.
#include <fuzzer/FuzzedDataProvider.h>

#include "io/dicom/decode.h"

using namespace volumen;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  constexpr const char* syntaxes[] = {
      "1.2.840.10008.1.2.1",    "1.2.840.10008.1.2.2",    "1.2.840.10008.1.2.5",    "1.2.840.10008.1.2.4.50",
      "1.2.840.10008.1.2.4.51", "1.2.840.10008.1.2.4.57", "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.80",
      "1.2.840.10008.1.2.4.81", "1.2.840.10008.1.2.4.90", "1.2.840.10008.1.2.4.91"};
  constexpr const char* photometrics[] = {"MONOCHROME1", "MONOCHROME2",  "PALETTE COLOR", "RGB",
                                          "YBR_FULL",    "YBR_FULL_422", "YBR_ICT",       "YBR_RCT"};
  FuzzedDataProvider input(bytes, size);
  const dicom::TransferSyntax syntax = dicom::transferSyntax(input.PickValueInArray(syntaxes));
  dicom::PixelFormat format;
  format.photometric = input.PickValueInArray(photometrics);
  format.columns = input.ConsumeIntegralInRange(1, 300);
  format.rows = input.ConsumeIntegralInRange(1, 300);
  format.bitsAllocated = input.PickValueInArray({1, 8, 16, 32});
  format.bitsStored = input.ConsumeIntegralInRange(1, format.bitsAllocated);
  format.highBit = format.bitsStored - 1;
  format.isSigned = input.ConsumeBool();
  format.bigEndian = syntax.encoding.bigEndian;
  format.samples = format.isGrey() || format.photometric == "PALETTE COLOR" ? 1 : 3;
  format.planar = input.ConsumeBool();
  format.bytesInWords = format.bigEndian && format.bitsAllocated <= 8;
  const int frame = format.isBits() ? input.ConsumeIntegralInRange(0, 99) : 0;
  const std::vector<std::uint8_t> coded = input.ConsumeRemainingBytes<std::uint8_t>();
  (void)dicom::decodeFrame(format, syntax, coded, frame);
  return 0;
}
