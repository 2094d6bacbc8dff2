#include "io/archive/instance_uids.h"

#include "io/dicom/data_set.h"
#include "io/dicom/scanned_file.h"
#include "io/regular_file.h"

namespace volumen {

Result<InstanceUids> uidsIn(const std::string& path) {
  const Result<RegularFile> file = RegularFile::open(path);
  if (!file) return file.error();
  dicom::ScannedFile scanned;
  if (Status read = scanned.begin(*file); !read) return read.error();
  const Result<dicom::MetaHeader> meta = dicom::scanMeta(scanned.head, file->size());
  if (!meta) return meta.error();
  scanned.meta = *meta;
  if (Status named = scanned.findSyntax(); !named) return named.error();
  if (Status read = scanned.scan(*file); !read) return read.error();
  const dicom::DataSet data(scanned.head, scanned.dataSet.elements);
  const auto uid = [&](std::uint32_t tag) { return data.text(tag, data.root()); };
  InstanceUids uids{uid(0x00080016), uid(0x00080018), uid(0x0020000d), uid(0x0020000e),
                    meta->transferSyntaxUid};
  if (uids.sopInstance.empty()) return Error{"it holds no DICOM instance"};
  return uids;
}

}  // namespace volumen
