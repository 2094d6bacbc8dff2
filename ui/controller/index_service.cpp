#include "ui/controller/index_service.h"

#include <QElapsedTimer>
#include <algorithm>

namespace volumen {

namespace {

constexpr std::size_t mostRecent = 5;
constexpr int importProgressEveryMs = 100, listAgainEveryMs = 1000;  // while something is imported

}  // namespace

IndexService::IndexService(const std::string& folder, QObject* parent) : QObject(parent), folder_(folder) {
  // The index stays with the one thread that opened it.
  for (Worker* worker : {&queries_, &thumbnails_, &importer_}) {
    worker->pool.setMaxThreadCount(1);
    worker->pool.setExpiryTimeout(-1);
  }
  thumbnails_.pool.setThreadPriority(QThread::LowPriority);
  importer_.pool.setThreadPriority(QThread::LowPriority);
}

IndexService::~IndexService() {
  closing_ = true;
  cancelImport_.cancel();
  for (Worker* worker : {&queries_, &thumbnails_, &importer_}) {
    worker->pool.start([worker] { worker->index.reset(); });
    worker->pool.waitForDone();
  }
}

// Runs a function on the thread of this object.
template <class Function>
void IndexService::tell(Function function) {
  QMetaObject::invokeMethod(this, std::move(function), Qt::QueuedConnection);
}

void IndexService::failWith(const std::string& sentence) {
  tell([this, text = QString::fromStdString(sentence)] { Q_EMIT failed(text); });
}

// Null, with the reason told: it cannot be opened.
Index* IndexService::indexOf(Worker& worker) {
  if (worker.index) return &*worker.index;
  Result<Index> opened = folder_.empty() ? Result<Index>(Error{tr("There is no home folder for the list of "
                                                                  "studies: set HOME or XDG_DATA_HOME.")
                                                                   .toStdString()})
                                         : Index::open(folder_);
  if (!opened) {
    tell([this, text = QString::fromStdString(opened.message())] { Q_EMIT unavailable(text); });
    return nullptr;
  }
  worker.index.emplace(std::move(*opened));
  if (const std::string& notice = worker.index->notice(); !notice.empty())
    tell([this, text = QString::fromStdString(notice)] { Q_EMIT noticed(text); });
  return &*worker.index;
}

void IndexService::start(Worker& worker, Job job) {
  worker.pool.start([this, &worker, job = std::move(job)] {
    if (Index* index = indexOf(worker)) job(*index);
  });
}

void IndexService::list(const StudyListRequest& request) {
  start(queries_, [this, request, number = ++newest_](Index& index) {
    if (closing_ || number != newest_) return;
    StudyQuery query;
    query.words = request.words;
    Result<std::vector<IndexedStudy>> studies = index.studies(query);
    if (!studies) return failWith(studies.message());
    const std::size_t recent = request.words.empty() ? mostRecent : 0;
    auto list = std::make_shared<const StudyList>(listedStudies(std::move(*studies), request.sort, recent));
    tell([this, list, number] {
      if (number == newest_) Q_EMIT listed(list);
    });
  });
}

void IndexService::series(std::int64_t study) {
  start(queries_, [this, study](Index& index) {
    if (closing_) return;
    Result<std::vector<IndexedSeries>> found = index.series(study);
    if (!found) return failWith(found.message());
    tell([this, study, list = std::make_shared<const std::vector<IndexedSeries>>(std::move(*found))] {
      Q_EMIT seriesListed(study, list);
    });
  });
}

void IndexService::open(const IndexedChoice& choice, OpenHow how) {
  start(queries_, [this, choice, how](Index& index) {
    if (closing_) return;
    Result<std::vector<std::string>> files = index.files(choice.study);
    if (!files) return failWith(files.message());
    const Result<std::vector<std::string>> refused = index.refusedBeside(choice.study);
    if (!refused) return failWith(refused.message());
    files->insert(files->end(), refused->begin(), refused->end());
    OpenIntent intent;
    intent.how = how;
    if (choice.series != 0) {
      const Result<std::vector<IndexedSeries>> all = index.series(choice.study);
      if (!all) return failWith(all.message());
      const auto chosen = std::ranges::find(*all, choice.series, &IndexedSeries::id);
      if (chosen != all->end()) intent.seriesUid = chosen->seriesUid;
    }
    if (const Status remembered = index.opened(choice.study); !remembered) failWith(remembered.message());
    tell([this, choice, intent, files = *files] {
      Q_EMIT filesFound(choice, files, intent);
      Q_EMIT changed();
    });
  });
}

void IndexService::remove(const std::vector<std::int64_t>& studies) { change(studies, &Index::forget); }

void IndexService::undoRemove(const std::vector<std::int64_t>& studies) {
  change(studies, &Index::undoForget);
}

void IndexService::change(const std::vector<std::int64_t>& studies,
                          Status (Index::*how)(const std::vector<std::int64_t>& studies)) {
  start(queries_, [this, studies, how](Index& index) {
    if (const Status done = (index.*how)(studies); !done) return failWith(done.message());
    tell([this] { Q_EMIT changed(); });
  });
}

void IndexService::wantThumbnails(const std::vector<std::int64_t>& series) {
  {
    const std::lock_guard lock(mutex_);
    wanted_.assign(series.rbegin(), series.rend());
  }
  for (std::size_t n = 0; n < series.size(); ++n)
    start(thumbnails_, [this](Index& index) { makeNextThumbnail(index); });
}

void IndexService::makeNextThumbnail(Index& index) {
  std::int64_t series = 0;
  {
    const std::lock_guard lock(mutex_);
    if (closing_ || wanted_.empty()) return;
    series = wanted_.back();
    wanted_.pop_back();
  }
  QImage image;
  // A series without one is no failure: its files are offline, or hold no picture.
  if (const Result<Thumbnail> png = index.thumbnail(series))
    image = QImage::fromData(png->data(), int(png->size()), "PNG");
  tell([this, series, image] { Q_EMIT thumbnailMade(series, image); });
}

void IndexService::import(const QStringList& paths) {
  std::vector<std::string> all;
  for (const QString& path : paths) all.push_back(path.toStdString());
  if (imports_++ == 0) Q_EMIT importingChanged(true);
  importer_.pool.start([this, all, cancel = cancelImport_] {
    if (Index* index = indexOf(importer_)) runImport(*index, all, cancel);
    tell([this] {
      if (--imports_ == 0) Q_EMIT importingChanged(false);
    });
  });
}

void IndexService::cancelImport() {
  cancelImport_.cancel();
  cancelImport_ = CancelToken();
}

void IndexService::runImport(Index& index, const std::vector<std::string>& paths, const CancelToken& cancel) {
  QElapsedTimer told, listedAgain;
  listedAgain.start();
  const auto progress = [&](const char*, std::size_t done, std::size_t total) {
    if (told.isValid() && told.elapsed() < importProgressEveryMs) return;
    told.start();
    const bool again = listedAgain.elapsed() >= listAgainEveryMs;
    if (again) listedAgain.start();
    tell([this, done, total, again] {
      Q_EMIT importProgressed(qint64(done), qint64(total));
      if (again) Q_EMIT changed();
    });
  };
  const Result<ImportReport> report = index.import(paths, progress, cancel);
  tell([this, report] {
    if (report)
      Q_EMIT importEnded(*report);
    else
      Q_EMIT failed(QString::fromStdString(report.message()));
    Q_EMIT changed();
  });
}

}  // namespace volumen
