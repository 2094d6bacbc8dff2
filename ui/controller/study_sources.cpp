#include "ui/controller/study_sources.h"

#include <algorithm>
#include <utility>

#include "io/archive/archives.h"
#include "io/archive/fetched_studies.h"
#include "ui/controller/all_sources.h"
#include "ui/controller/archive_source.h"
#include "ui/controller/index_service.h"

namespace volumen {

namespace {

using Make = std::unique_ptr<StudySource> (*)(const std::string& indexFolder, Jobs& jobs);

constexpr Make sources[] = {
    [](const std::string& indexFolder, Jobs& jobs) -> std::unique_ptr<StudySource> {
      return std::make_unique<IndexService>(indexFolder, jobs);
    },
    [](const std::string&, Jobs&) -> std::unique_ptr<StudySource> { return std::make_unique<AllSources>(); },
};

}  // namespace

StudySourceList makeStudySources(const std::string& indexFolder, Jobs& jobs) {
  StudySourceList all;
  for (const Make make : sources) all.push_back(make(indexFolder, jobs));
  return all;
}

StudySources::StudySources(StudySourceList always, std::string indexFolder, Jobs& jobs)
    : indexFolder_(std::move(indexFolder)),
      jobs_(jobs),
      all_(std::move(always)),
      always_(all_.size()),
      current_(all_.front().get()) {
  offer({});
}

StudySource* StudySources::offered(const QString& key) const {
  const auto found = std::ranges::find_if(offered_, [&](const StudySource* s) { return s->key() == key; });
  return found == offered_.end() ? nullptr : *found;
}

StudySource* StudySources::importer() const {
  const auto first = std::ranges::find_if(all_, [](const auto& source) { return source->canImport(); });
  return first == all_.end() ? nullptr : first->get();
}

void StudySources::choose(std::size_t n) {
  if (std::exchange(current_, offered_[n]) != offered_[n]) Q_EMIT chosen();
}

Status StudySources::offerArchives() {
  const Result<Archives> archives = readArchives(userArchivesFile());
  if (!archives) return archives.error();
  offer(archives->archives);
  const bool isGone = std::ranges::find(offered_, current_) == offered_.end();
  if (isGone) current_ = offered_.front();
  Q_EMIT offeredChanged();
  if (isGone) Q_EMIT chosen();
  return {};
}

void StudySources::offer(const std::vector<Archive>& archives) {
  offered_.clear();
  for (std::size_t n = 0; n < always_; ++n)
    if (!all_[n]->isOfOthers()) offered_.push_back(all_[n].get());
  for (const Archive& archive : archives) offered_.push_back(&sourceOf(archive));
  const std::vector<StudySource*> others = offered_;
  for (std::size_t n = 0; n < always_; ++n) {
    if (!all_[n]->isOfOthers()) continue;
    all_[n]->setOthers(others);
    if (!archives.empty()) offered_.push_back(all_[n].get());
  }
}

std::optional<bool> StudySources::isKept(const std::string& studyUid) const {
  return isFetchedKept(indexFolder_, studyUid);
}

// Another program may hold the marks for as long as it removes studies.
void StudySources::keep(const std::string& studyUid, bool isKept) {
  marks_.run(
      {}, [=, folder = indexFolder_](const Job&) { return keepFetched(folder, studyUid, isKept); },
      [this](const Status& done) {
        if (!done) Q_EMIT failed(QString::fromStdString(done.message()));
      });
}

// Returns the source of an archive, made if it is new. What it fetches changes the index.
ArchiveSource& StudySources::sourceOf(const Archive& archive) {
  ArchiveSource*& source = archives_[archive.name];
  if (source) {
    source->setArchive(archive);
    return *source;
  }
  all_.push_back(std::make_unique<ArchiveSource>(archive, indexFolder_, jobs_));
  source = static_cast<ArchiveSource*>(all_.back().get());
  if (StudySource* index = importer())
    connect(source, &ArchiveSource::imported, index, &StudySource::changed);
  Q_EMIT added(all_.size() - 1);
  return *source;
}

}  // namespace volumen
