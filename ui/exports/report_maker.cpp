#include "ui/exports/report_maker.h"

#include <QTimer>
#include <algorithm>
#include <optional>

#include "results/text/text.h"
#include "ui/exports/flat_pictures.h"
#include "ui/overlays/picture_pages.h"

namespace volumen {

namespace {

// Reports of the segments of each series.
using ReportsOfSeries = std::vector<std::vector<SegmentReport>>;

// Slow.
Result<ReportsOfSeries> reportsOf(const std::vector<ReportedSegments>& all, const CancelToken& cancel) {
  ReportsOfSeries reports;
  for (const ReportedSegments& one : all) {
    reports.emplace_back();
    if (!one.whyNot.isEmpty()) continue;
    auto made = voxelReportsOf(one.key, cancel);
    if (!made) return made.error();
    reports.back() = *std::move(made);
  }
  return reports;
}

// Returns the workspace with only the measurements that have no numbers yet, and what they are measured on.
PictureStop unmeasured(const std::vector<ReportedStudy>& studies, const Session& session) {
  PictureStop stop{session.workspace(), session.workspace().focus};
  stop.workspace.measurements.eraseIf([](const Measurement&) { return true; });
  for (const ReportedStudy& study : studies)
    for (const ReportedMeasurement& row : study.measurements)
      if (!row.measured) stop.workspace.measurements.push_back(row.measurement);
  return stop.workspace.measurements.empty() ? stop : heldNow(std::move(stop), session);
}

class ReportMaker : public QObject, public PictureMaker {
 public:
  ReportMaker(const PictureMakerPtr& pictures, const std::vector<ReportedStudy>& studies,
              const Session& session, bool namesHidden);

  std::size_t count() const override { return items_.size(); }
  void make(std::size_t n, JobLane& lane, const Done& done) override;
  void giveUp() override;

 private:
  // A picture, or else the tables of a study.
  struct Item {
    std::optional<std::size_t> picture;
    std::size_t study;
  };

  void measure();
  void takeNumbers();
  void measureSegments();
  MadePicture tables(const ReportsOfSeries& reports) const;

  const PictureMakerPtr pictures_;
  std::vector<ReportedStudy> studies_;
  const bool namesHidden_;
  PictureStop unmeasured_;
  std::vector<Item> items_;
  std::size_t study_ = 0;  // whose tables are being made
  JobLane* lane_ = nullptr;
  Done done_;
  std::unique_ptr<FrameService> frames_;
  std::unique_ptr<Session> copy_;  // with `unmeasured_`, while it is measured
  std::unique_ptr<MeasuredNumbers> measurer_;
};

ReportMaker::ReportMaker(const PictureMakerPtr& pictures, const std::vector<ReportedStudy>& studies,
                         const Session& session, bool namesHidden)
    : pictures_(pictures),
      studies_(studies),
      namesHidden_(namesHidden),
      unmeasured_(unmeasured(studies, session)) {
  std::size_t picture = 0;
  for (std::size_t n = 0; n < studies_.size(); ++n) {
    for (std::size_t of = 0; of < studies_[n].pictures; ++of) items_.push_back({picture++, n});
    if (!studies_[n].measurements.empty() || !studies_[n].segments.empty()) items_.push_back({{}, n});
  }
}

void ReportMaker::make(std::size_t n, JobLane& lane, const Done& done) {
  if (items_[n].picture) return pictures_->make(*items_[n].picture, lane, done);
  study_ = items_[n].study, lane_ = &lane, done_ = done;
  unmeasured_.workspace.measurements.empty() ? measureSegments() : measure();
}

void ReportMaker::giveUp() {
  pictures_->giveUp();
  if (measurer_) measurer_->disconnect(this);
  done_ = {};
}

// Measures for all studies at once.
void ReportMaker::measure() {
  frames_ = std::make_unique<FrameService>();
  copy_ = sessionOf(unmeasured_);
  measurer_ = std::make_unique<MeasuredNumbers>(*copy_, *frames_);
  connect(measurer_.get(), &MeasuredNumbers::changed, this, &ReportMaker::takeNumbers, Qt::QueuedConnection);
  takeNumbers();
}

// Goes on once all numbers are there that can be had.
void ReportMaker::takeNumbers() {
  if (!done_ || !measurer_) return;
  for (const Measurement& m : copy_->workspace().measurements)
    if (numbersKeyOf(*copy_, m) && !measurer_->exactNumbersOf(m)) return;
  for (ReportedStudy& study : studies_)
    for (ReportedMeasurement& row : study.measurements)
      if (!row.measured) row.measured = measurer_->exactNumbersOf(row.measurement);
  measurer_.reset();
  copy_.reset();
  frames_.reset();
  unmeasured_ = {};
  measureSegments();
}

void ReportMaker::measureSegments() {
  lane_->run(
      {},
      [segments = studies_[study_].segments](const Job& job) { return reportsOf(segments, job.cancel()); },
      [this](const Result<ReportsOfSeries>& reports) {
        if (const Done done = std::exchange(done_, {}))
          done(reports ? Result(tables(*reports)) : reports.error());
      });
}

MadePicture ReportMaker::tables(const ReportsOfSeries& reports) const {
  const HidingNames hiding(namesHidden_);
  const ReportedStudy& study = studies_[study_];
  MadePicture made;
  made.label.head = pageHead(*study.series);
  made.label.group = int(study_);
  if (!study.measurements.empty()) made.tables.push_back(measurementTable(study.measurements));
  for (std::size_t n = 0; n < reports.size(); ++n)
    made.tables.push_back(segmentTable(study.segments[n], reports[n]));
  return made;
}

}  // namespace

PictureMakerPtr reportPages(const PictureMakerPtr& pictures, const std::vector<ReportedStudy>& studies,
                            const Session& session, bool namesHidden) {
  return std::make_shared<ReportMaker>(pictures, studies, session, namesHidden);
}

}  // namespace volumen
