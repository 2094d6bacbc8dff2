// An addition: a tool that stamps a ball into a new segment, with a preview while the button is held.
#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "results/segments/step_work.h"
#include "ui/controller/segment_editing.h"
#include "ui/tools/tool.h"

namespace volumen {

namespace {

constexpr double radiusMm = 4;

SegmentWork stampAt(const SlicePress& press, glm::dvec3 p) {
  SegmentWork work;
  work.series = keyOf(press.series->series);
  work.volume = press.series->volume;
  work.text = work.doing = QStringLiteral("Stamp");
  work.makeAll = [volume = work.volume, p](SegmentMap map, const CancelToken& cancel) {
    const int number = *freeNumber(map);
    Segment stamp;
    stamp.number = number;
    stamp.label = "Stamp";
    const Step ball{"ball", stepNameOf(number), {{"at", std::vector{p}}, {"radiusMm", radiusMm}}};
    return withStepsDone(withSegment(std::move(map), stamp), {{ball}, {number}}, *volume, cancel);
  };
  return work;
}

class StampDrag : public Drag {
 public:
  explicit StampDrag(const SlicePress& press) : press_(press) {
    press_.segments->preview(stampAt(press_, press_.patientAt(press_.at)));
  }

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    press_.segments->preview(stampAt(press_, press_.patientAt(p)));
  }
  bool drawsOver() const override { return true; }
  void giveUp() override { press_.segments->endPreview(); }
  bool release(QPointF p, Qt::KeyboardModifiers) override {
    press_.segments->change(stampAt(press_, press_.patientAt(p)));
    return true;
  }

 private:
  const SlicePress press_;
};

}  // namespace

std::unique_ptr<Drag> beginStamp(const SlicePress& press) {
  return press.segments ? std::make_unique<StampDrag>(press) : nullptr;
}

}  // namespace volumen
