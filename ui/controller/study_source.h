#pragma once

#include <QImage>
#include <QObject>
#include <QStringList>
#include <optional>
#include <string>
#include <vector>

#include "io/index/index.h"
#include "ui/controller/open_intent.h"
#include "ui/data/study_list.h"

namespace volumen {

/// What the study browser wants to list.
struct StudyListRequest {
  std::string words;  ///< as typed; empty: all studies, and those opened last
  StudySort sort;
  bool operator==(const StudyListRequest&) const = default;
};

/// Where studies are listed and opened from: the index of this machine, an archive. Asking never waits: what
/// is asked ends in a signal. What takes its time is a job of the list, and ends in none where it is
/// cancelled there. Numbers of studies and series are the source's own.
class StudySource : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  /// What tells it from other sources, and the studies opened from it from theirs: "index".
  virtual QString key() const = 0;
  /// For people.
  virtual QString name() const = 0;
  /// Under which a study of it stands among what is open.
  QString placeOf(std::int64_t study) const { return QStringLiteral("%1:%2").arg(key()).arg(study); }

  /// Ends in listed(), or in unavailable() where there is nothing to ask. Of what is asked meanwhile the
  /// newest alone need be answered.
  virtual void list(const StudyListRequest& request) = 0;
  /// Ends in seriesListed().
  virtual void series(std::int64_t study) = 0;
  /// Ends in patientListed(): all studies of a patient of this ID and name, in no order. Here: there are
  /// none.
  virtual void studiesOf(const std::string& patientId, const std::string& patientName);
  /// Ends in thumbnailMade() for each; those wanted before and not begun are given up. Here: there are none.
  virtual void wantThumbnails(const std::vector<std::int64_t>& series);
  /// Ends in filesFound(), once the files of the study are on this machine, or in notOpened().
  virtual void open(const IndexedChoice& choice, OpenHow how) = 0;

  /// Whether import() does anything; here it does not.
  virtual bool canImport() const { return false; }
  /// Reads all below these paths into it, after what is being imported already. Ends in importEnded().
  virtual void import(const QStringList&) {}
  /// Whether studies can be taken out of it; here they cannot.
  virtual bool canRemove() const { return false; }
  /// Takes studies out of it, and back into it; never deletes files. Ends in changed().
  virtual void remove(const std::vector<std::int64_t>&) {}
  virtual void undoRemove(const std::vector<std::int64_t>&) {}

 Q_SIGNALS:
  /// The answer to this request.
  void listed(const volumen::StudyListRequest& request, const volumen::StudyListPtr& list);
  void seriesListed(qint64 study, const volumen::SeriesListPtr& series);
  /// None: they could not be asked for.
  void patientListed(const std::string& patientId, const std::string& patientName,
                     const std::optional<std::vector<volumen::IndexedStudy>>& studies);
  /// Null: there is none.
  void thumbnailMade(qint64 series, const QImage& thumbnail);
  /// The files of the study of a choice, and what was asked for, with the series of the choice.
  void filesFound(const volumen::IndexedChoice& choice, const std::vector<std::string>& files,
                  const volumen::OpenIntent& intent);
  /// Why a choice is not opened: a sentence.
  void notOpened(const volumen::IndexedChoice& choice, const QString& sentence);
  /// It holds something else now.
  void changed();
  void importBegun();
  void importEnded(const volumen::ImportReport& report);
  /// A sentence on what was asked last, but for notOpened().
  void failed(const QString& sentence);
  /// Why nothing can be asked.
  void unavailable(const QString& sentence);
  /// What is to be known of it, told once: a damaged index was put aside.
  void noticed(const QString& sentence);
};

}  // namespace volumen
