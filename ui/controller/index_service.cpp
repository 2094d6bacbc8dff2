#include "ui/controller/index_service.h"

#include <QElapsedTimer>
#include <QLocale>
#include <algorithm>
#include <string_view>

namespace volumen {

namespace {

constexpr std::size_t mostRecent = 5;
constexpr int listAgainEveryMs = 1000;  // during an import

// The files of a choice and the intent to open them.
struct ChosenFiles {
  std::vector<std::string> files;
  OpenIntent intent;
  Status remembered;
};

Result<ChosenFiles> chosenFiles(Index& index, const IndexedChoice& choice, OpenHow how) {
  ChosenFiles chosen;
  chosen.intent.how = how;
  Result<std::vector<std::string>> files = index.files(choice.study);
  if (!files) return files.error();
  const Result<std::vector<std::string>> refused = index.refusedBeside(choice.study);
  if (!refused) return refused.error();
  chosen.files = std::move(*files);
  chosen.files.insert(chosen.files.end(), refused->begin(), refused->end());
  if (choice.series != 0) {
    const Result<std::vector<IndexedSeries>> all = index.series(choice.study);
    if (!all) return all.error();
    const auto series = std::ranges::find(*all, choice.series, &IndexedSeries::id);
    if (series != all->end()) chosen.intent.seriesUid = series->seriesUid;
  }
  if (how != OpenHow::lookedInto) chosen.remembered = index.opened(choice.study);
  return chosen;
}

// The index searches for words; the patient is compared here. Returns nothing if the query fails.
std::optional<std::vector<IndexedStudy>> studiesOfPatient(const Index& index, const std::string& id,
                                                          const std::string& name) {
  if (id.empty() && name.empty()) return std::vector<IndexedStudy>();
  StudyQuery query;
  query.words = id.empty() ? name : id;
  Result<std::vector<IndexedStudy>> found = index.studies(query);
  if (!found) return {};
  std::erase_if(*found, [&](const IndexedStudy& s) { return s.patientId != id || s.patientName != name; });
  return std::move(*found);
}

// A missing thumbnail is no failure: the files are offline or hold no picture.
Result<QImage> thumbnailImage(Index& index, std::int64_t series) {
  const Result<Thumbnail> png = index.thumbnail(series);
  return png ? QImage::fromData(png->data(), int(png->size()), "PNG") : QImage();
}

}  // namespace

IndexService::IndexService(const std::string& folder, Jobs& jobs, QObject* parent)
    : StudySource(parent), folder_(folder), jobs_(jobs) {}

// The index is destroyed on the thread that opened it.
IndexService::~IndexService() {
  for (const Job& import : imports_) import.cancel().cancel();
  for (Worker* worker : {&queries_, &thumbnails_, &importer_}) {
    worker->lane.giveUpAll();
    worker->lane.run(
        {}, [worker](const Job&) { worker->index.reset(); }, [] {});
    worker->lane.wait();
  }
}

// Returns null and reports the reason if the index cannot be opened.
Index* IndexService::indexOf(Worker& worker) {
  if (worker.index) return &*worker.index;
  Result<Index> opened = Index::open(folder_);
  if (!opened) {
    const QString why = QString::fromStdString(opened.message());
    worker.lane.tell([this, why] { Q_EMIT unavailable(why); });
    return nullptr;
  }
  worker.index.emplace(std::move(*opened));
  if (const QString notice = QString::fromStdString(worker.index->notice()); !notice.isEmpty())
    worker.lane.tell([this, notice] { Q_EMIT noticed(notice); });
  return &*worker.index;
}

// Runs `work(index, job)`, which returns a Result. `done` receives its value, or `refuse` the sentence, which
// is empty if it was reported already. Returns the number of the job.
template <class Work, class Done, class Failed>
int IndexService::start(Worker& worker, Work work, Done done, Failed refuse) {
  using Made = std::invoke_result_t<Work, Index&, const Job&>;
  return worker.lane.run(
      {},
      [this, &worker, work](const Job& job) -> std::optional<Made> {
        if (Index* index = indexOf(worker)) return work(*index, job);
        return {};
      },
      [done, refuse](std::optional<Made> made) {
        if (!made) return refuse(QString());
        if (!*made) return refuse(QString::fromStdString(made->message()));
        done(std::move(**made));
      });
}

template <class Work, class Done>
int IndexService::start(Worker& worker, Work work, Done done) {
  return start(worker, work, done, [this](const QString& sentence) {
    if (!sentence.isEmpty()) Q_EMIT failed(sentence);
  });
}

void IndexService::list(const StudyListRequest& request) {
  queries_.lane.giveUp(listing_);
  listing_ = start(
      queries_,
      [request](Index& index, const Job&) -> Result<StudyListPtr> {
        Result<std::vector<IndexedStudy>> studies = index.studies({.words = request.words});
        if (!studies) return studies.error();
        const std::size_t recent = request.words.empty() ? mostRecent : 0;
        return std::make_shared<const StudyList>(listedStudies(std::move(*studies), request.sort, recent));
      },
      [this, request](const StudyListPtr& list) { Q_EMIT listed(request, list); });
}

void IndexService::series(std::int64_t study) {
  start(
      queries_, [study](Index& index, const Job&) { return index.series(study); },
      [this, study](std::vector<IndexedSeries> found) {
        Q_EMIT seriesListed(study, std::make_shared<const std::vector<IndexedSeries>>(std::move(found)));
      });
}

void IndexService::studiesOf(const std::string& patientId, const std::string& patientName) {
  queries_.lane.run(
      {},
      [this, patientId, patientName](const Job&) {
        const Index* index = indexOf(queries_);
        return index ? studiesOfPatient(*index, patientId, patientName) : std::nullopt;
      },
      [this, patientId, patientName](const std::optional<std::vector<IndexedStudy>>& studies) {
        Q_EMIT patientListed(patientId, patientName, studies);
      });
}

void IndexService::open(const IndexedChoice& choice, OpenHow how) {
  start(
      queries_, [choice, how](Index& index, const Job&) { return chosenFiles(index, choice, how); },
      [this, choice](const ChosenFiles& chosen) {
        Q_EMIT filesFound(choice, chosen.files, chosen.intent);
        if (!chosen.remembered) Q_EMIT failed(QString::fromStdString(chosen.remembered.message()));
        if (chosen.intent.how != OpenHow::lookedInto) Q_EMIT changed();
      },
      [this, choice](const QString& sentence) {
        Q_EMIT notOpened(choice, sentence.isEmpty() ? tr("The list of studies cannot be read.") : sentence);
      });
}

ListFiles IndexService::filesOf(const IndexedChoice& choice) const {
  return [choice, folder = folder_]() -> Result<std::vector<std::string>> {
    const Result<Index> index = Index::openAsItIs(folder);
    if (!index) return index.error();
    return index->files(choice.study, choice.series);
  };
}

void IndexService::remove(const std::vector<std::int64_t>& studies) { change(studies, &Index::forget); }

void IndexService::undoRemove(const std::vector<std::int64_t>& studies) {
  change(studies, &Index::undoForget);
}

void IndexService::change(const std::vector<std::int64_t>& studies,
                          Status (Index::*how)(const std::vector<std::int64_t>& studies)) {
  start(
      queries_,
      [studies, how](Index& index, const Job&) -> Result<bool> {
        if (const Status done = (index.*how)(studies); !done) return done.error();
        return true;
      },
      [this](bool) { Q_EMIT changed(); });
}

void IndexService::wantThumbnails(const std::vector<std::int64_t>& series) {
  for (const int job : thumbnailJobs_) thumbnails_.lane.giveUpWaiting(job);
  thumbnailJobs_.clear();
  for (const std::int64_t id : series)
    thumbnailJobs_.push_back(start(
        thumbnails_, [id](Index& index, const Job&) { return thumbnailImage(index, id); },
        [this, id](const QImage& image) { Q_EMIT thumbnailMade(id, image); }));
}

// Shows intermediate results from time to time.
Progress IndexService::importProgress(const Job& import, const Job& job) {
  auto clock = std::make_shared<QElapsedTimer>();
  clock->start();
  return [this, import, job, clock](const char* what, std::size_t done, std::size_t total) {
    const QLocale locale;
    const bool areStudies = std::string_view(what) == readingInstitutions;
    if (total > 0)
      import.tell((areStudies ? tr("Reading where they were made: %1 of %2 studies")
                              : tr("Importing: %1 of %2 files"))
                      .arg(locale.toString(qulonglong(done)), locale.toString(qulonglong(total))),
                  double(done) / double(total));
    if (clock->elapsed() < listAgainEveryMs) return;
    clock->start();
    importer_.lane.tell(job, [this] { Q_EMIT changed(); });
  };
}

void IndexService::import(const QStringList& paths) {
  std::vector<std::string> all;
  for (const QString& path : paths) all.push_back(path.toStdString());
  const Job import(tr("Importing"));
  imports_.push_back(import);
  jobs_.add(import, {});
  Q_EMIT importBegun();
  importer_.lane.run(
      {},
      [this, all, import](const Job& job) -> std::optional<Result<ImportReport>> {
        Index* index = indexOf(importer_);
        if (!index) return {};
        return index->import(all, importProgress(import, job), import.cancel());
      },
      [this, import](const std::optional<Result<ImportReport>>& report) {
        jobs_.remove(import);
        std::erase_if(imports_, [&](const Job& other) { return other.id() == import.id(); });
        if (!report) return;
        if (*report)
          Q_EMIT importEnded(**report);
        else
          Q_EMIT failed(QString::fromStdString(report->message()));
        Q_EMIT changed();
      });
}

}  // namespace volumen
