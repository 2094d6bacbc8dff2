// An addition: a study source that lists one study, which cannot be opened.
#include "ui/controller/study_sources.h"

namespace volumen {

namespace {

class Shelf : public StudySource {
 public:
  QString key() const override { return QStringLiteral("shelf"); }
  QString name() const override { return QStringLiteral("Shelf"); }
  void list(const StudyListRequest& request) override {
    IndexedStudy study;
    study.id = 1;
    study.patientName = "Shelf^One";
    Q_EMIT listed(request, std::make_shared<StudyList>(listedStudies({study}, request.sort, 0)));
  }
  void series(std::int64_t study) override {
    Q_EMIT seriesListed(study, std::make_shared<std::vector<IndexedSeries>>());
  }
  void open(const IndexedChoice& choice, OpenHow) override {
    Q_EMIT notOpened(choice, QStringLiteral("The shelf is locked."));
  }
};

}  // namespace

std::unique_ptr<StudySource> makeShelf(const std::string&, Jobs&) { return std::make_unique<Shelf>(); }

}  // namespace volumen
