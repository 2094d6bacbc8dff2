#pragma once

#include <algorithm>
#include <vector>

#include "ui/controller/study_source.h"
#include "ui/document/jobs.h"

namespace volumen::tests {

/// A source of studies that answers on command. Opening a study is a job until then.
class FakeSource : public StudySource {
 public:
  struct Study {
    IndexedStudy listed;
    std::vector<std::string> files;
  };
  struct Open {
    IndexedChoice choice;
    OpenHow how;
    Job job;
  };

  FakeSource(const QString& key, Jobs& jobs, std::vector<Study> studies)
      : key_(key), jobs_(jobs), studies_(std::move(studies)) {}

  QString key() const override { return key_; }
  QString name() const override { return QStringLiteral("Archive ") + key_; }
  void list(const StudyListRequest& request) override { asked.push_back(request); }
  void series(std::int64_t study) override { Q_EMIT seriesListed(study, std::make_shared<SeriesList>()); }
  void open(const IndexedChoice& choice, OpenHow how) override {
    opens.push_back({choice, how, Job(QStringLiteral("Fetching %1").arg(choice.study))});
    jobs_.add(opens.back().job, {});
  }

  /// Returns whether these words were searched for.
  bool wasAsked(const std::string& words) const {
    return std::ranges::find(asked, words, &StudyListRequest::words) != asked.end();
  }
  /// Answers all requests for these words with the studies whose patients' names contain them.
  void answer(const std::string& words) {
    std::vector<IndexedStudy> found;
    for (const Study& study : studies_)
      if (study.listed.patientName.find(words) != std::string::npos) found.push_back(study.listed);
    for (const StudyListRequest& request : std::vector(asked))
      if (request.words == words)
        Q_EMIT listed(request, std::make_shared<StudyList>(listedStudies(found, request.sort, 0)));
  }
  /// Answers the n-th opening, from 0, unless it was cancelled.
  void answerOpen(std::size_t n) {
    const Open open = opens.at(n);
    jobs_.remove(open.job);
    if (open.job.cancelled()) return;
    const auto study =
        std::ranges::find(studies_, open.choice.study, [](const Study& s) { return s.listed.id; });
    Q_EMIT filesFound(open.choice, study->files, {.how = open.how});
  }

  std::vector<StudyListRequest> asked;
  std::vector<Open> opens;

 private:
  using SeriesList = std::vector<IndexedSeries>;
  const QString key_;
  Jobs& jobs_;
  const std::vector<Study> studies_;
};

}  // namespace volumen::tests
