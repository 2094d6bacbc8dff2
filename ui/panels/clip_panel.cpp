#include "ui/panels/clip_panel.h"

#include <QPushButton>
#include <QVBoxLayout>

#include "ui/session/camera_moves.h"

namespace volumen {

ClipPanel::ClipPanel(Session& session, QWidget* parent) : QWidget(parent), session_(session) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(4);
  for (int axis = 0; axis < 3; ++axis)
    for (bool high : {false, true}) {
      NumberRow*& row = (high ? high_ : low_)[axis];
      row = makeRow(
          QStringLiteral("%1 %2").arg(high ? tr("to") : tr("from"), QStringLiteral("ijk").mid(axis, 1)));
      row->setObjectName(
          QStringLiteral("clip%1%2").arg(high ? QStringLiteral("High") : QStringLiteral("Low")).arg(axis));
      column->addWidget(row);
      connectRow(axis, high);
    }
  auto* reset = new QPushButton(tr("Show all"));
  reset->setObjectName(QStringLiteral("clipReset"));
  connect(reset, &QPushButton::clicked, this,
          [this] { session_.edit(tr("Remove the clip box"), [](Scene& s) { s.clip = {}; }); });
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
    const QString what = tr("Clip box");
    session_.edit(
        what,
        [&](Scene& s) {
          double &low = s.clip.boxLow[axis], &top = s.clip.boxHigh[axis];
          (high ? top : low) = percent / 100;
          if (low > top) (high ? low : top) = percent / 100;  // pushes the other side along
        },
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

// The sides of the volume's box by the patient's: "from R", "to L".
void ClipPanel::nameSides() {
  const bool directions = session_.series() && session_.series()->volume->geometry().calibrated;
  for (int axis = 0; axis < 3; ++axis) {
    QString low = QStringLiteral("ijk").mid(axis, 1), high = low;
    if (directions) {
      const glm::dvec3 along = session_.series()->volume->geometry().patientFromVoxelStep[axis];
      low = QString::fromStdString(sideLetters(-along).substr(0, 1));
      high = QString::fromStdString(sideLetters(along).substr(0, 1));
    }
    low_[axis]->setName(tr("from %1").arg(low));
    high_[axis]->setName(tr("to %1").arg(high));
  }
}

}  // namespace volumen
