#include "io/archive/send_archive.h"

#include <set>

#include "io/archive/protocol.h"
#include "io/regular_file.h"

namespace volumen {

namespace {

std::vector<SentInstance> instancesIn(const std::vector<std::string>& files, const CancelToken& cancel,
                                      SendReport& report) {
  std::vector<SentInstance> instances;
  std::set<std::string> known;
  for (const std::string& path : files) {
    if (cancel.cancelled()) break;
    const auto uids = dicom::instanceUids(path);
    if (!uids)
      report.notDicom.push_back({path, fileName(path) + ": " + uids.message()});
    else if (uids->instance.empty())
      report.notDicom.push_back({path, fileName(path) + ": it holds no DICOM instance"});
    else if (uids->sopClass.empty())
      report.notDicom.push_back({path, fileName(path) + ": it does not say which kind of object it is"});
    else if (known.insert(uids->instance).second)
      instances.push_back({path, *uids});
  }
  return instances;
}

}  // namespace

Result<SendReport> sendToArchive(const Archive& archive, const std::vector<std::string>& files,
                                 const Progress& progress, const CancelToken& cancel) {
  SendReport report;
  const std::vector<SentInstance> instances = instancesIn(files, cancel, report);
  report.instances = int(instances.size());
  if (cancel.cancelled()) return Error{"cancelled"};
  if (instances.empty()) return report;
  std::vector<bool> isAnswered(instances.size());
  std::size_t done = 0;
  const Status sent =
      protocolOf(archive, cancel)->send(instances, [&](std::size_t n, const std::string& refusal) {
        isAnswered[n] = true;
        if (refusal.empty())
          ++report.sent;
        else
          report.failed.push_back({instances[n].path, refusal});
        if (progress) progress("sending", ++done, instances.size());
      });
  if (!sent && report.sent == 0 && report.failed.empty()) return sent.error();
  for (std::size_t n = 0; n < instances.size(); ++n)
    if (!isAnswered[n])
      report.failed.push_back(
          {instances[n].path, sent ? "the archive did not say that it keeps it" : sent.message()});
  return report;
}

}  // namespace volumen
