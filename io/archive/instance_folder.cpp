#include "io/archive/instance_folder.h"

#include <filesystem>

#include "io/files/name_for_uid.h"

namespace volumen {

std::string InstanceFolder::pathOf(const std::string& sopInstanceUid) const {
  return folder_ + "/" + nameForUid(sopInstanceUid) + ".dcm";
}

bool InstanceFolder::has(const std::string& sopInstanceUid) const {
  std::error_code ignored;
  return std::filesystem::exists(pathOf(sopInstanceUid), ignored);
}

Result<std::string> InstanceFolder::begin() {
  // Those that are dropped count, too: a faulty archive never ends.
  if (left_ == 0) return Error{"The archive \"" + archive_ + "\" sends more images than it lists."};
  --left_;
  Result<OutputFile> file = OutputFile::create(folder_ + "/instance.dcm");
  if (!file) return file.error();
  written_.emplace(std::move(*file));
  return written_->asidePath();
}

Status InstanceFolder::end(const dicom::InstanceUids& uids) {
  const bool isOfSeries = uids.study == studyUid_ && uids.series == seriesUid_ && !uids.instance.empty();
  if (!isOfSeries || has(uids.instance)) return drop(), Status();
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(written_->asidePath(), ignored);
  const Result<bool> kept = written_->commitAsNew(pathOf(uids.instance));
  written_.reset();
  if (!kept) return kept.error();
  if (!*kept) return {};  // another program has fetched it meanwhile
  bytes_ += ignored ? 0 : size;
  if (onStored_) onStored_();
  return {};
}

}  // namespace volumen
