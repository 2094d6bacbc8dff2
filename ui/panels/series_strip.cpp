#include "ui/panels/series_strip.h"

#include <QGuiApplication>
#include <QMimeData>
#include <QPalette>
#include <QScrollBar>
#include <QTimer>
#include <algorithm>

#include "results/text/text.h"
#include "ui/panels/study_model.h"
#include "ui/widgets/plain_text.h"
#include "ui/widgets/untinted_icon.h"
#include "ui/workspace/dragged_series.h"
#include "ui/workspace/indexed_text.h"

namespace volumen {

namespace {

constexpr int stripIconEdge = 64, stripItemWidth = 132;

QString captionOf(const IndexedSeries& series) {
  QStringList name{shownText(series.modality), shownText(series.number), contentText(series)};
  name.removeAll(QString());
  const QString mark = series.warnings.empty() ? QString() : QStringLiteral("! ");
  return mark + name.join(QLatin1Char(' ')) + QLatin1Char('\n') + imagesText(series);
}

}  // namespace

SeriesStrip::SeriesStrip(QWidget* parent) : QListWidget(parent) {
  setObjectName(QStringLiteral("browserSeries"));
  setAccessibleName(tr("Series of the study"));
  setViewMode(QListView::IconMode);
  setFlow(QListView::LeftToRight);
  setWrapping(false);
  setMovement(QListView::Static);
  setDragEnabled(true);
  setDragDropMode(QAbstractItemView::DragOnly);
  setUniformItemSizes(true);
  setTextElideMode(Qt::ElideMiddle);
  setIconSize({stripIconEdge, stripIconEdge});
  setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  const int caption = 2 * fontMetrics().lineSpacing() + 12;
  setGridSize({stripItemWidth, stripIconEdge + caption});
  setFixedHeight(stripIconEdge + caption + horizontalScrollBar()->sizeHint().height() + 6);
  connect(horizontalScrollBar(), &QScrollBar::valueChanged, this, &SeriesStrip::wantVisible);
}

void SeriesStrip::showStudy(std::int64_t study, const SeriesListPtr& series) {
  const SeriesListPtr shown = series ? series : std::make_shared<const std::vector<IndexedSeries>>();
  const bool isSame = study == study_;
  if (isSame && *shown == *series_) return;
  std::map<std::int64_t, QIcon> before;
  for (int n = 0; isSame && n < count(); ++n)
    if (const IndexedSeries* s = seriesOf(item(n)); s && made_.contains(s->id))
      before[s->id] = item(n)->icon();
  study_ = study;
  series_ = shown;
  made_.clear();
  clear();
  QPixmap none(stripIconEdge, stripIconEdge);  // keeps the layout when the thumbnail arrives
  none.fill(Qt::transparent);
  for (const IndexedSeries& s : *series_) {
    auto* added = new QListWidgetItem(QIcon(none), captionOf(s), this);
    added->setData(Qt::UserRole, qint64(s.id));
    added->setToolTip(toolTipOf(everythingOf(s)));
    if (s.offline) added->setForeground(QGuiApplication::palette().brush(QPalette::Disabled, QPalette::Text));
    if (const auto icon = before.find(s.id); icon != before.end()) {
      added->setIcon(icon->second);
      made_.insert(s.id);
    }
  }
  // Positions of items are known only after layout.
  QTimer::singleShot(0, this, &SeriesStrip::wantVisible);
}

void SeriesStrip::showNames() {
  for (int n = 0; n < count(); ++n)
    if (const IndexedSeries* series = seriesOf(item(n))) {
      item(n)->setText(captionOf(*series));
      item(n)->setToolTip(toolTipOf(everythingOf(*series)));
    }
}

void SeriesStrip::setThumbnail(std::int64_t series, const QImage& thumbnail) {
  made_.insert(series);
  for (int n = 0; n < count() && !thumbnail.isNull(); ++n)
    if (choiceOf(item(n)).series == series) item(n)->setIcon(untintedIcon(thumbnail));
}

IndexedChoice SeriesStrip::choiceOf(const QListWidgetItem* item) const {
  return item ? IndexedChoice{study_, item->data(Qt::UserRole).toLongLong()} : IndexedChoice{};
}

const IndexedSeries* SeriesStrip::seriesOf(const QListWidgetItem* item) const {
  const std::int64_t id = choiceOf(item).series;
  const auto found = std::ranges::find(*series_, id, &IndexedSeries::id);
  return found == series_->end() ? nullptr : &*found;
}

void SeriesStrip::wantVisible() {
  if (!isVisible()) return;
  std::vector<std::int64_t> wanted;
  for (int n = 0; n < count(); ++n) {
    const std::int64_t id = choiceOf(item(n)).series;
    if (!made_.contains(id) && visualItemRect(item(n)).intersects(viewport()->rect())) wanted.push_back(id);
  }
  Q_EMIT thumbnailsWanted(wanted);
}

QStringList SeriesStrip::mimeTypes() const { return {draggedSeriesType}; }

QMimeData* SeriesStrip::mimeData(const QList<QListWidgetItem*>& items) const {
  return items.isEmpty() ? nullptr : draggedChoice({source_, choiceOf(items.front())});
}

void SeriesStrip::resizeEvent(QResizeEvent* event) {
  QListWidget::resizeEvent(event);
  wantVisible();
}

void SeriesStrip::showEvent(QShowEvent* event) {
  QListWidget::showEvent(event);
  QTimer::singleShot(0, this, &SeriesStrip::wantVisible);
}

}  // namespace volumen
