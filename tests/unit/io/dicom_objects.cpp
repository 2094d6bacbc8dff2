#include "tests/unit/io/dicom_objects.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QtGlobal>

#include "tests/unit/io/dicom_writer.h"

namespace volumen::tests {

namespace {

DcmTagKey tagOf(unsigned group, unsigned element) { return DcmTagKey(Uint16(group), Uint16(element)); }

}  // namespace

void writeObject(const std::string& path, const char* sopClassUid, const std::function<void(DcmItem&)>& edit,
                 bool implicitVr) {
  DcmFileFormat file;
  DcmDataset& data = *file.getDataset();
  put(data, 0x0008, 0x0016, sopClassUid);
  put(data, 0x0008, 0x0018, newUid().c_str());
  edit(data);
  const E_TransferSyntax syntax = implicitVr ? EXS_LittleEndianImplicit : EXS_LittleEndianExplicit;
  if (file.saveFile(path.c_str(), syntax).bad()) qFatal("cannot write %s", path.c_str());
}

DcmItem& addItem(DcmItem& in, unsigned group, unsigned element) {
  DcmItem* item = nullptr;
  if (in.findOrCreateSequenceItem(tagOf(group, element), item, -2).bad()) qFatal("no item");
  return *item;
}

void put(DcmItem& in, unsigned group, unsigned element, const std::string& value) {
  if (in.putAndInsertOFStringArray(tagOf(group, element), value.c_str()).bad()) qFatal("no value");
}

void putFloats(DcmItem& in, unsigned group, unsigned element, const std::vector<float>& values) {
  if (in.putAndInsertFloat32Array(tagOf(group, element), values.data(), values.size()).bad())
    qFatal("no floats");
}

void putWord(DcmItem& in, unsigned group, unsigned element, unsigned value) {
  if (in.putAndInsertUint16(tagOf(group, element), Uint16(value)).bad()) qFatal("no word");
}

}  // namespace volumen::tests
