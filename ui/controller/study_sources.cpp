#include "ui/controller/study_sources.h"

#include <algorithm>
#include <utility>

#include "io/archive/archives.h"
#include "ui/controller/archive_source.h"
#include "ui/controller/index_service.h"

namespace volumen {

namespace {

using Make = std::unique_ptr<StudySource> (*)(const std::string& indexFolder, Jobs& jobs);

constexpr Make sources[] = {
    [](const std::string& indexFolder, Jobs& jobs) -> std::unique_ptr<StudySource> {
      return std::make_unique<IndexService>(indexFolder, jobs);
    },
};

// Adds the archives of the user's list. What they fetch changes the index, which is the first source.
void addArchives(StudySourceList& all, const std::string& indexFolder, Jobs& jobs) {
  StudySource* index = all.front().get();
  const Result<Archives> archives = readArchives(userArchivesFile());
  if (!archives) {
    // Nobody listens yet.
    const QString why = QString::fromStdString(archives.message());
    QMetaObject::invokeMethod(
        index, [index, why] { Q_EMIT index->noticed(why); }, Qt::QueuedConnection);
    return;
  }
  for (const Archive& archive : archives->archives) {
    auto source = std::make_unique<ArchiveSource>(archive, indexFolder, jobs);
    QObject::connect(source.get(), &ArchiveSource::imported, index, &StudySource::changed);
    all.push_back(std::move(source));
  }
}

}  // namespace

StudySourceList makeStudySources(const std::string& indexFolder, Jobs& jobs) {
  StudySourceList all;
  for (const Make make : sources) all.push_back(make(indexFolder, jobs));
  addArchives(all, indexFolder, jobs);
  return all;
}

StudySource* StudySources::importer() const {
  const auto first = std::ranges::find_if(all_, [](const auto& source) { return source->canImport(); });
  return first == all_.end() ? nullptr : first->get();
}

void StudySources::choose(std::size_t n) {
  if (std::exchange(current_, n) != n) Q_EMIT chosen();
}

}  // namespace volumen
