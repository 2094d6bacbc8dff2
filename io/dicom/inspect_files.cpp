#include "io/dicom/inspect_files.h"

#include "io/dicom/header_check.h"
#include "io/worker/batches.h"
#include "io/worker/dicom_fields.h"

namespace volumen::dicom {
namespace {

std::vector<Inspection> inspectEach(const std::vector<std::string>& paths) {
  std::vector<Inspection> all;
  for (const std::string& path : paths) {
    all.push_back(inspect(path));
    worker::finishStep();
  }
  return all;
}

}  // namespace

Inspection refusal(worker::Failure why) {
  Inspection refused{Inspection::Kind::refused, std::string(worker::reasonOf(why)) + ".", {}, {}, {}};
  refused.again = worker::isOfMachine(why);
  return refused;
}

void checkInspection(const std::string& path, Inspection& i) {
  if (i.kind == Inspection::Kind::picture && !isConsistent(i.header, path))
    i = refusal(worker::Failure::wrong);
  if (i.derivedObject) i.derivedObject->path = path;
}

std::vector<Inspection> inspectFiles(const std::vector<std::string>& paths, const Progress& progress,
                                     const CancelToken& cancel) {
  std::vector<Inspection> all =
      worker::forFiles<inspectEach>(paths, "reading headers", progress, cancel, refusal);
  if (worker::isolating())
    for (std::size_t n = 0; n < paths.size(); ++n) checkInspection(paths[n], all[n]);
  return all;
}

}  // namespace volumen::dicom
