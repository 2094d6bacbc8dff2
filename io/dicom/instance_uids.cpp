#include "io/dicom/instance_uids.h"

#include "io/dicom/data_set.h"
#include "io/dicom/scanned_file.h"
#include "io/regular_file.h"
#include "io/worker/batches.h"

namespace volumen::dicom {

static void fields(worker::Wire& w, InstanceUids& uids) {
  w(uids.study, uids.series, uids.instance, uids.sopClass, uids.transferSyntax);
}

namespace {

Result<InstanceUids> instanceUidsHere(const std::string& path) {
  const Result<RegularFile> file = RegularFile::open(path);
  if (!file) return file.error();
  ScannedFile s;
  if (Status read = s.readMeta(*file); !read) return read.error();
  const Status scanned = s.scan(*file);
  const DataSet data(s.head, s.dataSet.elements);
  const auto uid = [&](std::uint32_t tag) { return data.text(tag, data.root()); };
  InstanceUids uids{uid(0x0020000d), uid(0x0020000e), uid(0x00080018), uid(0x00080016),
                    s.meta.transferSyntaxUid};
  // Damage behind the UIDs does no harm here.
  const bool isAll = !uids.study.empty() && !uids.series.empty() && !uids.instance.empty();
  if (!scanned && !isAll) return scanned.error();
  return uids;
}

}  // namespace

Result<InstanceUids> instanceUids(const std::string& path) {
  const CancelToken never;
  worker::Request request = worker::headersOf({path}, never);
  worker::Failure failure{};
  return worker::isolated<instanceUidsHere>(request, failure, path);
}

}  // namespace volumen::dicom
