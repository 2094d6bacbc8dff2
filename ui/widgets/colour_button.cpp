#include "ui/widgets/colour_button.h"

#include <QPainter>

#include "ui/widgets/colours.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

void chooseColour(QWidget* owner, const QString& title, glm::dvec3 start,
                  const std::function<void(glm::dvec3)>& picked, const std::function<void()>& finished) {
  auto* dialog = new QColorDialog(toQColor(start), owner);
  dialog->setObjectName(QStringLiteral("colourDialog"));
  dialog->setWindowTitle(title);
  dialog->setOption(QColorDialog::DontUseNativeDialog);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  QObject::connect(dialog, &QColorDialog::currentColorChanged, owner,
                   [picked](const QColor& c) { picked(fromQColor(c)); });
  QObject::connect(dialog, &QDialog::finished, owner, [picked, finished, start](int result) {
    if (result == QDialog::Rejected) picked(start);
    finished();
  });
  dialog->show();
}

ColourButton::ColourButton(const QString& title, QWidget* parent) : QToolButton(parent) {
  setAccessibleName(title);
  setToolTip(toolTipOf(title));
  setFixedSize(28, 22);
  connect(this, &QToolButton::clicked, this, [this, title] {
    chooseColour(
        this, title, colour_,
        [this](glm::dvec3 c) {
          setColour(c);
          Q_EMIT colourEdited(c);
        },
        [this] { Q_EMIT gestureFinished(); });
  });
}

void ColourButton::setColour(glm::dvec3 colour) {
  colour_ = colour;
  update();
}

void ColourButton::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(palette().color(hasFocus() ? QPalette::Highlight : QPalette::Mid), hasFocus() ? 2 : 1));
  painter.setBrush(toQColor(colour_));
  painter.setOpacity(isEnabled() ? 1 : 0.4);
  painter.drawRoundedRect(QRectF(rect()).adjusted(2, 2, -2, -2), 3, 3);
}

}  // namespace volumen
