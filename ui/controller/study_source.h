#pragma once

#include <QImage>
#include <QObject>
#include <QStringList>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/index/index.h"
#include "io/study/series.h"
#include "ui/controller/open_intent.h"
#include "ui/data/study_list.h"

namespace volumen {

/// A query of the study browser.
struct StudyListRequest {
  std::string words;  ///< as typed; empty for what the source lists by itself: all studies
  StudySort sort;
  bool operator==(const StudyListRequest&) const = default;
};

/// Lists files; may be called on any thread.
using ListFiles = std::function<Result<std::vector<std::string>>()>;

/// A source of studies: the index of this machine, or an archive. No call waits; each ends in a signal. Slow
/// work is a job in the list. Opening and importing send no signal if they are cancelled there. Numbers of
/// studies and series are local to the source.
class StudySource : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  /// Returns the identifier of the source and of studies opened from it: "index".
  virtual QString key() const = 0;
  /// Returns the name shown to the user.
  virtual QString name() const = 0;
  /// Returns whether it is asked over a network: less often, and only for what the user wants to see. False
  /// in the base class.
  virtual bool isRemote() const { return false; }
  /// Returns whether it lists what other sources have. Then it is offered after them, while there are
  /// archives. False in the base class.
  virtual bool isOfOthers() const { return false; }
  /// Sets the other sources that are offered, for one that lists them.
  virtual void setOthers(const std::vector<StudySource*>&) {}
  /// Returns the path under which a study of this source is listed among open studies.
  QString placeOf(std::int64_t study) const { return QStringLiteral("%1:%2").arg(key()).arg(study); }

  /// Lists studies. Ends in listed(), or in unavailable() if the source cannot be queried. Before, listed()
  /// may tell what is known so far. Of several pending requests only the latest needs an answer.
  virtual void list(const StudyListRequest& request) = 0;
  /// Lists the series of a study; ends in seriesListed().
  virtual void series(std::int64_t study) = 0;
  /// Lists all studies of a patient with this ID and name, unordered. Ends in patientListed(). The base class
  /// returns none.
  virtual void studiesOf(const std::string& patientId, const std::string& patientName);
  /// Makes thumbnails; ends in thumbnailMade() for each. Earlier requests not begun are cancelled. The base
  /// class makes none.
  virtual void wantThumbnails(const std::vector<std::int64_t>& series);
  /// Opens a choice. Ends in filesFound() once the files of the study are on this machine, or in notOpened().
  /// A study may come series by series: then filesFound() is sent again with all that is there so far
  /// (OpenHow::joining).
  virtual void open(const IndexedChoice& choice, OpenHow how) = 0;

  /// Returns what lists the files of a choice on this machine. Null in the base class: they are elsewhere.
  virtual ListFiles filesOf(const IndexedChoice&) const { return {}; }

  /// Returns whether import() is supported; false in the base class.
  virtual bool canImport() const { return false; }
  /// Imports everything below these paths, after pending imports. Ends in importEnded().
  virtual void import(const QStringList&) {}
  /// Returns whether studies can be removed; false in the base class.
  virtual bool canRemove() const { return false; }
  /// Removes studies from the source, and restores them; never deletes files. Ends in changed().
  virtual void remove(const std::vector<std::int64_t>&) {}
  virtual void undoRemove(const std::vector<std::int64_t>&) {}

 Q_SIGNALS:
  /// The answer to this request, or a part of it.
  void listed(const volumen::StudyListRequest& request, const volumen::StudyListPtr& list);
  void seriesListed(qint64 study, const volumen::SeriesListPtr& series);
  /// `studies` is empty if the source could not be queried.
  void patientListed(const std::string& patientId, const std::string& patientName,
                     const std::optional<std::vector<volumen::IndexedStudy>>& studies);
  /// `thumbnail` is null if there is none.
  void thumbnailMade(qint64 series, const QImage& thumbnail);
  /// The files of a chosen study, and the intent with the chosen series.
  void filesFound(const volumen::IndexedChoice& choice, const std::vector<std::string>& files,
                  const volumen::OpenIntent& intent);
  /// What has come so far of the series being fetched, with files on this machine and a path of its own. Null
  /// when nothing more comes, after filesFound() or notOpened(). Sent for choices that replace what is shown.
  void arriving(const std::shared_ptr<const volumen::Series>& part);
  /// A sentence why a choice is not opened.
  void notOpened(const volumen::IndexedChoice& choice, const QString& sentence);
  /// The content of the source changed.
  void changed();
  void importBegun();
  void importEnded(const volumen::ImportReport& report);
  /// A sentence about the last call, other than notOpened().
  void failed(const QString& sentence);
  /// A sentence why the source cannot be queried.
  void unavailable(const QString& sentence);
  /// A notice about the source, sent once: a damaged index was put aside.
  void noticed(const QString& sentence);
};

}  // namespace volumen
