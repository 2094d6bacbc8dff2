#include "ui/panels/clip_panel.h"

#include <QPushButton>
#include <QVBoxLayout>

#include "ui/workspace/camera_moves.h"
#include "ui/workspace/clip_box.h"

namespace volumen {

namespace {

// Names the ends of a volume axis whose direction is unknown.
QString edgeName(const QString& axis, bool last) {
  return (last ? ClipPanel::tr("%1 end") : ClipPanel::tr("%1 start")).arg(axis);
}

// Returns the patient's side that is nearest to a direction, such as "Right edge".
QString sideName(glm::dvec3 direction) {
  const QString words = QString::fromStdString(sideWords(direction)).section(QLatin1Char('-'), 0, 0);
  return ClipPanel::tr("%1 edge").arg(words.left(1).toUpper() + words.mid(1));
}

}  // namespace

ClipPanel::ClipPanel(Session& session, QWidget* parent) : QWidget(parent), session_(session) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(4);
  for (int axis = 0; axis < 3; ++axis)
    for (bool high : {false, true}) {
      NumberRow*& row = (high ? high_ : low_)[axis];
      row = makeRow(edgeName(QStringLiteral("IJK").mid(axis, 1), high));
      row->setObjectName(
          QStringLiteral("clip%1%2").arg(high ? QStringLiteral("High") : QStringLiteral("Low")).arg(axis));
      column->addWidget(row);
      connectRow(axis, high);
    }
  auto* reset = new QPushButton(tr("Reset clipping"));
  reset->setObjectName(QStringLiteral("clipReset"));
  connect(reset, &QPushButton::clicked, this,
          [this] { session_.edit(tr("Reset clipping"), [](Scene& s) { s.clip = {}; }); });
  column->addWidget(reset);
  column->addStretch();
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.series != after.series) nameSides();
    if (!(before.scene.clip == after.scene.clip)) showClip();
  });
  showClip();
}

NumberRow* ClipPanel::makeRow(const QString& name) {
  return new NumberRow(name, {.low = 0, .high = 100, .decimals = 1, .suffix = QStringLiteral(" %")});
}

void ClipPanel::connectRow(int axis, bool high) {
  NumberRow* row = high ? high_[axis] : low_[axis];
  connect(row, &NumberRow::valueEdited, this, [this, axis, high](double percent) {
    const QString what = tr("Clip");
    session_.edit(
        what, [&](Scene& s) { moveClipFace(s.clip, axis, high, percent / 100); },
        what + QString::number(2 * axis + high));
  });
  connect(row, &NumberRow::gestureFinished, this, [this] { session_.endGesture(); });
}

void ClipPanel::showClip() {
  const Clip& clip = session_.scene().clip;
  for (int axis = 0; axis < 3; ++axis) {
    low_[axis]->setValue(100 * clip.boxLow[axis]);
    high_[axis]->setValue(100 * clip.boxHigh[axis]);
  }
}

// Names the sides of the volume's box by the patient's sides.
void ClipPanel::nameSides() {
  const bool directions = session_.series() && session_.series()->volume->geometry().calibrated;
  for (int axis = 0; axis < 3; ++axis) {
    const QString letter = QStringLiteral("IJK").mid(axis, 1);
    QString low = edgeName(letter, false), high = edgeName(letter, true);
    if (directions) {
      const glm::dvec3 along = session_.series()->volume->geometry().patientFromVoxelStep[axis];
      low = sideName(-along);
      high = sideName(along);
    }
    low_[axis]->setName(low);
    high_[axis]->setName(high);
  }
}

}  // namespace volumen
