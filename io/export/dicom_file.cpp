#include "io/export/dicom_file.h"

#include <dcmtk/dcmdata/dcostrmb.h>
#include <dcmtk/dcmdata/dctk.h>
#include <sys/stat.h>

#include <vector>

namespace volumen {

namespace {

Error existsAlready(const std::string& path) {
  return Error{path + " is there already, and is not replaced: name another file."};
}

// True if a value does not fit the 16-bit length that most VRs have in Explicit VR.
bool isTooLongForExplicit(DcmDataset& data) {
  constexpr Uint32 longest = 0xfffe;
  DcmStack stack;
  while (data.nextObject(stack, true).good()) {
    DcmObject* object = stack.top();
    if (object->isLeaf() && object->getLength() > longest &&
        !DcmVR(object->getVR()).usesExtendedLengthEncoding())
      return true;
  }
  return false;
}

}  // namespace

Status writeDicomFile(DcmFileFormat& file, OutputFile& out, const std::string& path,
                      E_TransferSyntax syntax) {
  std::vector<Uint8> buffer(1 << 20);
  DcmOutputBufferStream stream(buffer.data(), offile_off_t(buffer.size()));
  file.transferInit();
  OFCondition done = EC_StreamNotifyClient;
  while (done == EC_StreamNotifyClient) {
    done = file.write(stream, syntax, EET_ExplicitLength, nullptr);
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

Result<OutputFile> createNew(const std::string& path) {
  struct stat there {};
  if (::lstat(path.c_str(), &there) == 0) return existsAlready(path);
  return OutputFile::create(path);
}

Status commitNew(OutputFile& out, const std::string& path) {
  const Result<bool> isNew = out.commitAsNew(path);
  if (!isNew) return isNew.error();
  return *isNew ? Status() : existsAlready(path);
}

Status writeNewDicom(DcmFileFormat& file, const std::string& path, const CancelToken& cancel) {
  auto out = createNew(path);
  if (!out) return out.error();
  const bool isLong = isTooLongForExplicit(*file.getDataset());
  const E_TransferSyntax syntax = isLong ? EXS_LittleEndianImplicit : EXS_LittleEndianExplicit;
  if (Status s = writeDicomFile(file, *out, path, syntax); !s) return s;
  if (cancel.cancelled()) return Error{"Interrupted; nothing was written."};
  return commitNew(*out, path);
}

}  // namespace volumen
