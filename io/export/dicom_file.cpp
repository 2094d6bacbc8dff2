#include "io/export/dicom_file.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcostrmb.h>
#include <dcmtk/dcmdata/dctk.h>

#include <vector>

namespace volumen {

// DCMTK's output goes through one buffer, so that a file of any size is written as it is made.
Status writeDicomFile(DcmFileFormat& file, OutputFile& out, const std::string& path) {
  std::vector<Uint8> buffer(1 << 20);
  DcmOutputBufferStream stream(buffer.data(), offile_off_t(buffer.size()));
  file.transferInit();
  OFCondition done = EC_StreamNotifyClient;
  while (done == EC_StreamNotifyClient) {
    done = file.write(stream, EXS_LittleEndianExplicit, EET_ExplicitLength, nullptr);
    stream.flush();
    void* bytes = nullptr;
    offile_off_t count = 0;
    stream.flushBuffer(bytes, count);
    if (Status s = out.write(bytes, std::size_t(count)); !s) return s;
  }
  file.transferEnd();
  if (done.bad()) return Error{"Cannot write " + path + ": " + done.text() + "."};
  return {};
}

}  // namespace volumen
