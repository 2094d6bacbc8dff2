#pragma once

#include <cstdint>
#include <vector>

#include "ui/controller/study_source.h"
#include "ui/document/job_lane.h"

namespace volumen {

/// Lists what all other sources list, which are asked at once. A study is listed once for each place that has
/// it; the list names the places. Choices are opened and sent by the sources that have them. A source that
/// does not answer is a notice on the list.
class AllSources : public StudySource {
  Q_OBJECT
 public:
  using StudySource::StudySource;

  QString key() const override { return QStringLiteral("all"); }
  QString name() const override { return tr("All"); }
  bool isRemote() const override { return true; }
  bool isOfOthers() const override { return true; }
  void setOthers(const std::vector<StudySource*>& others) override;

  /// Asks those that changed if the request is the same, else all. Archives list their studies of today if
  /// there are no words.
  void list(const StudyListRequest& request) override;
  void series(std::int64_t study) override;
  void wantThumbnails(const std::vector<std::int64_t>& series) override;
  void open(const IndexedChoice& choice, OpenHow how) override;
  ListFiles filesOf(const IndexedChoice& choice) const override;

 private:
  // One of the other sources, with its answer to the last request.
  struct Part {
    StudySource* source;
    std::int64_t number;  // of the source among all that there ever were
    StudyListPtr list{};  // null if there is none yet
    QString problem{};
    bool isAsked = false, isAnswered = false;
  };

  std::int64_t numberOf(StudySource* source);
  void listenTo(StudySource* source, std::int64_t number);
  StudyListRequest requestTo(const StudySource& source) const;
  Part* partOf(std::int64_t number);
  const Part* partOf(std::int64_t number) const;
  void take(std::int64_t number, const StudyListPtr& list, const QString& problem);
  QString notice() const;
  void tellList();

  std::vector<Part> parts_;
  std::vector<StudySource*> known_;  // by number
  StudyListRequest wanted_;
  bool isListOld_ = false;  // the list in work lacks what came since
  JobLane lists_;
};

}  // namespace volumen
