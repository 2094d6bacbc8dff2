#include "ui/panels/segment_list.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLocale>
#include <QShortcut>
#include <QSignalBlocker>
#include <QStyledItemDelegate>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "ui/controller/segment_target.h"
#include "ui/widgets/colours.h"
#include "ui/widgets/plain_text.h"
#include "ui/widgets/untinted_icon.h"
#include "ui/workspace/region_colours.h"
#include "ui/workspace/segments.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

enum ListColumn { shownColumn, lockColumn, amountColumn };

// A column whose texts nobody types.
class NotTyped : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QWidget* createEditor(QWidget*, const QStyleOptionViewItem&, const QModelIndex&) const override {
    return nullptr;
  }
};

QToolButton* listButton(const char* name, const QString& text) {
  auto* made = new QToolButton;
  made->setObjectName(QLatin1String(name));
  made->setText(text);
  return made;
}

int segmentNumberOf(const QTreeWidgetItem* item) { return item->data(shownColumn, Qt::UserRole).toInt(); }

QIcon swatchOf(const QColor& colour) {
  QImage square(12, 12, QImage::Format_RGB32);
  square.fill(colour);
  return untintedIcon(square);
}

// "Tissue, Bone, Left".
QString codesText(const Segment& segment) {
  QStringList codes;
  for (const Code* code : {&segment.category, &segment.type, &segment.modifier})
    if (!code->meaning.empty()) codes << shownText(code->meaning);
  return codes.join(QStringLiteral(", "));
}

void offerControl(QWidget* control, const QString& says, const QString& whyNot) {
  control->setEnabled(whyNot.isEmpty());
  control->setToolTip(toolTipOf(QStringList{says, whyNot}));
}

}  // namespace

SegmentList::SegmentList(Session& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      list_(new QTreeWidget),
      add_(listButton("segmentAdd", tr("Add"))),
      duplicate_(listButton("segmentDuplicate", tr("Duplicate"))),
      remove_(listButton("segmentRemove", tr("Remove"))),
      colour_(new ColourButton(tr("Colour of the segment"))),
      opacity_(new QSlider(Qt::Horizontal)) {
  makeLayout();
  connect(list_, &QTreeWidget::itemChanged, this, &SegmentList::itemChanged);
  connect(list_, &QTreeWidget::currentItemChanged, this,
          [this](const QTreeWidgetItem* item) { choose(item); });
  connectButtons();
  showSegments();
}

void SegmentList::makeLayout() {
  list_->setObjectName(QStringLiteral("segmentList"));
  list_->setAccessibleName(tr("Segments"));
  list_->setHeaderLabels({tr("Shown, name"), tr("Locked"), tr("ml")});
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);  // what is cut off stands in the tool tip
  for (const int column : {lockColumn, amountColumn})
    list_->setItemDelegateForColumn(column, new NotTyped(list_));
  list_->header()->setStretchLastSection(false);
  list_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  list_->header()->setSectionResizeMode(shownColumn, QHeaderView::Stretch);
  colour_->setObjectName(QStringLiteral("segmentColour"));
  opacity_->setObjectName(QStringLiteral("segmentFill"));
  opacity_->setAccessibleName(tr("Opacity of the segment"));
  opacity_->setRange(0, 100);
  opacity_->setMinimumWidth(40);
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  for (QWidget* part : {static_cast<QWidget*>(add_), static_cast<QWidget*>(duplicate_),
                        static_cast<QWidget*>(remove_), static_cast<QWidget*>(colour_)})
    row->addWidget(part);
  row->addWidget(opacity_, 1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(list_, 1);
  column->addLayout(row);
}

void SegmentList::connectButtons() {
  connect(add_, &QToolButton::clicked, this, &SegmentList::add);
  connect(duplicate_, &QToolButton::clicked, this, &SegmentList::duplicate);
  connect(remove_, &QToolButton::clicked, this, &SegmentList::remove);
  auto* key = new QShortcut(Qt::Key_Delete, list_, nullptr, nullptr, Qt::WidgetShortcut);
  connect(key, &QShortcut::activated, this, [this] {
    if (remove_->isEnabled()) remove();
  });
  connect(colour_, &ColourButton::colourEdited, this, [this](glm::dvec3 colour) {
    if (const Segment* segment = segmentShown(session_))
      edit(
          tr("Colour of a segment"), segment->number,
          [colour](Segment& s) { s.colour = glm::u8vec3(glm::round(255.0 * colour)); },
          QStringLiteral("segment's colour"));
  });
  connect(opacity_, &QSlider::valueChanged, this, [this](int percent) {
    if (const Segment* segment = segmentShown(session_))
      edit(
          tr("Opacity of a segment"), segment->number, [percent](Segment& s) { s.opacity = percent / 100.0; },
          QStringLiteral("segment's opacity"));
  });
  connect(colour_, &ColourButton::gestureFinished, &session_, &Session::endGesture);
  connect(opacity_, &QSlider::sliderReleased, &session_, &Session::endGesture);
}

// Rows stay the items they are, so that a name that is being typed stays in its field.
void SegmentList::showSegments() {
  const QSignalBlocker quietList(list_), quietSlider(opacity_);
  const SegmentMap* map = segmentsShown(session_);
  const Segment* current = segmentShown(session_);
  const int count = map ? int(map->segments.size()) : 0;
  while (list_->topLevelItemCount() > count) delete list_->takeTopLevelItem(count);
  QTreeWidgetItem* chosen = nullptr;
  for (int n = 0; n < count; ++n) {
    QTreeWidgetItem* item = list_->topLevelItem(n);
    if (!item) item = new QTreeWidgetItem(list_);
    const Segment& segment = map->segments[std::size_t(n)];
    showRow(item, *map, segment);
    if (&segment == current) chosen = item;
  }
  if (list_->currentItem() != chosen) list_->setCurrentItem(chosen);
  showRoom();
  if (current) {
    colour_->setColour(fromQColor(regionColour(current->colour, current->number)));
    opacity_->setValue(int(std::lround(100 * current->opacity)));
  }
  showButtons();
}

// As high as its rows, so that the pages below are seen; of many it scrolls.
void SegmentList::showRoom() {
  const int rows = std::clamp(list_->topLevelItemCount(), 3, 8);
  const int row = std::max(list_->sizeHintForRow(0), list_->fontMetrics().height() + 4);
  list_->setFixedHeight(list_->header()->sizeHint().height() + rows * row + 2 * list_->frameWidth());
}

void SegmentList::showRow(QTreeWidgetItem* item, const SegmentMap& map, const Segment& segment) {
  const QString name = shownText(segment.label);
  item->setFlags(item->flags() | Qt::ItemIsEditable | Qt::ItemIsUserCheckable);
  item->setData(shownColumn, Qt::UserRole, segment.number);
  item->setText(shownColumn, name);
  item->setIcon(shownColumn, swatchOf(regionColour(segment.colour, segment.number)));
  item->setCheckState(shownColumn, segment.visible ? Qt::Checked : Qt::Unchecked);
  item->setCheckState(lockColumn, segment.locked ? Qt::Checked : Qt::Unchecked);
  item->setText(amountColumn, amountText(map, segment.number));
  item->setTextAlignment(amountColumn, Qt::AlignRight | Qt::AlignVCenter);
  QFont font = list_->font();
  font.setItalic(segment.span.has_value());
  item->setFont(shownColumn, font);
  const QString follows = segment.span ? tr("Follows the curve until it is changed by hand.") : QString();
  item->setToolTip(shownColumn, toolTipOf(QStringList{name, codesText(segment), follows,
                                                      tr("A double-click or F2 renames it.")}));
  item->setToolTip(lockColumn, toolTipOf(tr("Locked: nothing takes voxels from it or gives it some.")));
}

QString SegmentList::amountText(const SegmentMap& map, int number) const {
  if (!numbers_ || numbers_->labels != map.labels) return QStringLiteral("\u2026");
  const std::int64_t voxels = numbers_->voxels[std::size_t(number)];
  const VoxelGeometry& grid = map.labels->geometry();
  if (!grid.calibrated) return tr("%1 voxels").arg(QLocale().toString(qlonglong(voxels)));
  const double ml = double(voxels) * grid.voxelVolume() / 1000;
  return QLocale().toString(ml, 'f', ml < 100 ? 2 : 0);
}

void SegmentList::showButtons() {
  const QString whyNone = whyNoSegments(session_);
  const SegmentMap* map = segmentsShown(session_);
  const Segment* current = segmentShown(session_);
  const QString whyNoMore =
      map && !freeNumber(*map) ? tr("There are 255 segments, and no more fit.") : whyNone;
  const QString whyNoCurrent = !whyNone.isEmpty() ? whyNone
                               : current          ? QString()
                                                  : tr("There is no segment yet.");
  offerControl(add_, tr("Another segment, without voxels."), whyNoMore);
  offerControl(duplicate_,
               tr("A segment with these codes and a name alike, without voxels: each voxel is in one."),
               whyNoCurrent.isEmpty() ? whyNoMore : whyNoCurrent);
  offerControl(remove_, tr("Removes the segment and its voxels (Del)."),
               whyNoCurrent.isEmpty() ? whyNotChanged(session_) : whyNoCurrent);
  offerControl(colour_, tr("Colour of the segment"), whyNoCurrent);
  offerControl(opacity_, tr("Opacity of the segment"), whyNoCurrent);
}

void SegmentList::showMeasured(const SegmentNumbers& numbers) {
  numbers_ = numbers;
  showSegments();
}

// An empty name is none.
void SegmentList::itemChanged(QTreeWidgetItem* item, int column) {
  const SegmentMap* map = segmentsShown(session_);
  const Segment* segment = map ? findSegment(*map, segmentNumberOf(item)) : nullptr;
  if (!segment) return;
  const QString name = item->text(shownColumn).trimmed(), before = shownText(segment->label);
  const bool isOn = item->checkState(column) == Qt::Checked;
  const int number = segment->number;
  if (column == lockColumn)
    edit((isOn ? tr("Lock %1") : tr("Unlock %1")).arg(before), number,
         [isOn](Segment& s) { s.locked = isOn; });
  else if (column == shownColumn && isOn != segment->visible)
    edit((isOn ? tr("Show %1") : tr("Hide %1")).arg(before), number,
         [isOn](Segment& s) { s.visible = isOn; });
  else if (column == shownColumn && !name.isEmpty() && name != before)
    edit(tr("Rename %1").arg(before), number, [&](Segment& s) { s.label = name.toStdString(); });
  showSegments();
}

void SegmentList::edit(const QString& text, int number, const std::function<void(Segment&)>& change,
                       const QString& mergeKey) {
  const SeriesKey series = keyOf(session_.series()->series);
  session_.change(text, withSegmentChanged(session_.workspace(), series, number, change), mergeKey);
  if (mergeKey.isEmpty()) session_.endGesture();
}

void SegmentList::choose(const QTreeWidgetItem* item) {
  if (!item || !segmentsShown(session_)) return;
  session_.change(
      tr("Choose a segment"),
      withCurrentSegment(session_.workspace(), keyOf(session_.series()->series), segmentNumberOf(item)));
  session_.endGesture();
}

void SegmentList::add() {
  session_.change(tr("Add segment"), withNewSegment(session_.workspace(), keyOf(session_.series()->series),
                                                    session_.series()->volume->geometry(), {}));
  session_.endGesture();
}

void SegmentList::duplicate() {
  session_.change(tr("Duplicate segment"),
                  withSegmentCopied(session_.workspace(), keyOf(session_.series()->series),
                                    segmentShown(session_)->number));
  session_.endGesture();
}

void SegmentList::remove() {
  const Segment* segment = segmentShown(session_);
  Q_EMIT workWanted({keyOf(session_.series()->series),
                     wholeVolume(session_),
                     segment->number,
                     tr("Remove %1").arg(shownText(segment->label)),
                     tr("Removing a segment"),
                     {},
                     {}});
}

}  // namespace volumen
