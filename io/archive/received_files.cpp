#include "io/archive/received_files.h"

#include <algorithm>
#include <filesystem>

#include "io/archive/fetched_studies.h"
#include "io/dicom/scan.h"
#include "io/files/name_for_uid.h"
#include "io/files/private_folder.h"
#include "io/regular_file.h"
#include "io/worker/call.h"

namespace volumen {

namespace {

Filed refusedWith(unsigned status, const std::string& problem) {
  Filed filed;
  filed.status = status;
  filed.problem = problem;
  return filed;
}

// Returns what a data set lacks, as the end of a sentence.
std::string lackOf(const dicom::InstanceUids& uids) {
  if (uids.study.empty()) return "an image has no StudyInstanceUID";
  if (uids.series.empty()) return "an image has no SeriesInstanceUID";
  return uids.instance.empty() ? "an image has no SOPInstanceUID" : "";
}

// Returns where the data set of a file begins.
Result<std::uint64_t> beginOfDataSet(const RegularFile& file) {
  constexpr std::uint64_t enough = 64 << 10;
  std::vector<std::uint8_t> head;
  if (Status read = file.readUpTo(head, enough); !read) return read.error();
  const auto meta = dicom::scanMeta(head, file.size());
  if (!meta) return meta.error();
  return meta->dataSet;
}

// Returns whether two files hold the same data set, whatever their file meta information (PS3.10 7.1) says.
bool haveSameDataSet(const std::string& path, const std::string& other) {
  constexpr std::uint64_t most = 1 << 20;
  const auto a = RegularFile::open(path), b = RegularFile::open(other);
  if (!a || !b) return false;
  const auto beginA = beginOfDataSet(*a), beginB = beginOfDataSet(*b);
  if (!beginA || !beginB || a->size() - *beginA != b->size() - *beginB) return false;
  for (std::uint64_t at = 0, size = a->size() - *beginA; at < size; at += most) {
    const std::uint64_t part = std::min(most, size - at);
    const auto some = a->read(*beginA + at, part), others = b->read(*beginB + at, part);
    if (!some || !others || *some != *others) return false;
  }
  return true;
}

}  // namespace

Filed ReceivedFiles::file(OutputFile& instance) {
  const auto uids = dicom::instanceUids(instance.asidePath());
  if (!uids)
    return refusedWith(worker::isReasonOfMachine(uids.message()) ? outOfResources : notUnderstood,
                       "an image cannot be read: " + uids.message());
  if (const std::string lack = lackOf(*uids); !lack.empty()) return refusedWith(lacksUids, lack);
  if (wants_ && !wants_(*uids)) return refusedWith(notAuthorized, "an image was not asked for");
  const std::string study = nameForUid(uids->study), series = nameForUid(uids->series);
  if (Status s = beginReceived(folder_, study, series); !s) return refusedWith(outOfResources, s.message());
  Filed filed;
  filed.uids = *uids;
  filed.path = folder_ + "/" + study + "/" + series + "/" + nameForUid(uids->instance) + ".dcm";
  return keep(instance, std::move(filed));
}

// Peers, and programs that fetch, may bring one instance at once.
Filed ReceivedFiles::keep(OutputFile& instance, Filed filed) {
  const auto isNew = instance.commitAsNew(filed.path);
  if (!isNew) return refusedWith(outOfResources, isNew.message());
  filed.alreadyHere = !*isNew;
  if (filed.alreadyHere && !haveSameDataSet(instance.asidePath(), filed.path))
    return refusedWith(isDuplicate, "another image with the UID " + filed.uids.instance + " is here already");
  const std::filesystem::path path = filed.path;
  if (Status s = makeNamesLast(path.parent_path().string()); !s)
    return refusedWith(outOfResources, s.message());
  std::error_code ignored;
  filed.bytes = std::filesystem::file_size(path, ignored);
  return filed;
}

}  // namespace volumen
