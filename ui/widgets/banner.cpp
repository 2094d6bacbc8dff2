#include "ui/widgets/banner.h"

#include <QEvent>
#include <QHBoxLayout>
#include <algorithm>

#include "ui/widgets/plain_text.h"

namespace volumen {

Banner::Banner(QWidget* over)
    : QFrame(over->parentWidget()),
      over_(over),
      sentence_(plainLabel()),
      details_(new QPlainTextEdit),
      more_(new QToolButton),
      offer_(new QToolButton) {
  setObjectName(QStringLiteral("banner"));
  setStyleSheet(
      QStringLiteral("#banner { background: #4a3312; border-top: 1px solid #c98a2b; }"
                     "#banner QLabel, #banner QPlainTextEdit { background: transparent; color: #ffe2b0; }"));
  sentence_->setObjectName(QStringLiteral("bannerText"));
  sentence_->setWordWrap(true);
  sentence_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  details_->setObjectName(QStringLiteral("bannerDetails"));
  details_->setReadOnly(true);
  details_->setFrameShape(QFrame::NoFrame);
  details_->setFixedHeight(7 * fontMetrics().lineSpacing());  // more lines are scrolled
  details_->hide();
  more_->setText(tr("Details"));
  more_->setCheckable(true);
  offer_->setObjectName(QStringLiteral("bannerOffer"));
  makeLayout();
  connect(offer_, &QToolButton::clicked, this, &Banner::accepted);
  connect(more_, &QToolButton::toggled, details_, &QWidget::setVisible);
  over_->installEventFilter(this);
  hide();
}

void Banner::makeLayout() {
  auto* close = new QToolButton;
  close->setObjectName(QStringLiteral("bannerClose"));
  close->setText(tr("Close"));
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  auto* row = new QHBoxLayout;
  row->addWidget(sentence_, 1);
  row->addWidget(more_);
  row->addWidget(offer_);
  row->addWidget(close);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 6, 8, 6);
  column->addLayout(row);
  column->addWidget(details_);
}

void Banner::tell(const Sentence& sentence) {
  told_ = {sentence};
  offer_->hide();
  show(false);
}

void Banner::add(const QString& sentence, const QStringList& details) {
  if (isHidden()) return tell(sentence, details);
  if (std::ranges::find(told_, sentence, &Sentence::text) != told_.end()) return;
  told_.push_back({sentence, details});
  show(false);
}

void Banner::takeBack(const void* by) {
  takeBackWhere([by](const Sentence& s) { return s.by == by; });
}

void Banner::takeBackOfFocus() {
  takeBackWhere([](const Sentence& s) { return s.ofFocus; });
}

void Banner::takeBackWhere(const std::function<bool(const Sentence&)>& isOver) {
  if (std::erase_if(told_, isOver) == 0 || isHidden()) return;
  if (told_.empty()) return hide();
  show(more_->isChecked());
}

void Banner::show(bool withDetails) {
  refresh();
  const bool anyDetails = std::ranges::any_of(told_, [](const Sentence& s) { return !s.details.isEmpty(); });
  more_->setVisible(anyDetails);
  more_->setChecked(withDetails && anyDetails);
  details_->setVisible(more_->isChecked());
  QFrame::show();
  place();
}

void Banner::refresh() {
  QStringList sentences, details;
  for (const Sentence& s : told_) {
    sentences << s.text;
    details << s.details;
  }
  sentence_->setText(writing_(sentences.join(QLatin1Char('\n'))));
  details_->setPlainText(writing_(details.join(QLatin1Char('\n'))));
}

void Banner::offer(const QString& text) {
  offer_->setText(text);
  offer_->show();
}

bool Banner::eventFilter(QObject* object, QEvent* event) {
  if (event->type() == QEvent::Resize || event->type() == QEvent::Move) place();
  return QFrame::eventFilter(object, event);
}

// Moves the banner if its height has changed.
bool Banner::event(QEvent* event) {
  const bool done = QFrame::event(event);
  if (event->type() == QEvent::LayoutRequest) place();
  return done;
}

void Banner::place() {
  if (isHidden()) return;
  const QPoint corner = over_->mapTo(parentWidget(), QPoint(0, over_->height()));
  const int width = over_->width(), height = layout()->totalHeightForWidth(width);
  setGeometry(corner.x(), corner.y() - height, width, height);
  raise();
}

}  // namespace volumen
