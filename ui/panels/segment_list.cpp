#include "ui/panels/segment_list.h"

#include <QHeaderView>
#include <QLocale>
#include <QMenu>
#include <QShortcut>
#include <QSignalBlocker>
#include <QStyledItemDelegate>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "results/segments/region_colours.h"
#include "results/segments/segment_maps.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "ui/controller/segment_edits.h"
#include "ui/controller/segment_target.h"
#include "ui/panels/segment_tree.h"
#include "ui/widgets/colours.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"
#include "ui/widgets/untinted_icon.h"
#include "ui/workspace/series_segments.h"

namespace volumen {

namespace {

enum ListColumn { shownColumn, lockColumn, amountColumn, mapColumn };
constexpr int numberRole = Qt::UserRole, mapRole = Qt::UserRole + 1;
constexpr int leastRows = 4, mostRows = 8;

// Makes a column read-only.
class NotTyped : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QWidget* createEditor(QWidget*, const QStyleOptionViewItem&, const QModelIndex&) const override {
    return nullptr;
  }
};

int segmentNumberOf(const QTreeWidgetItem* item) { return item->data(shownColumn, numberRole).toInt(); }
int mapNumberOf(const QTreeWidgetItem* item) { return item->data(shownColumn, mapRole).toInt(); }

QIcon swatchOf(const QColor& colour) {
  QImage square(12, 12, QImage::Format_RGB32);
  square.fill(colour);
  return untintedIcon(square);
}

// Joins the meanings of codes, such as "Tissue, Bone, Left".
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

SegmentList::SegmentList(SegmentEditing& editing, const SegmentNumbers& numbers, QWidget* parent)
    : QWidget(parent),
      editing_(editing),
      session_(editing.session()),
      numbers_(numbers),
      list_(new SegmentTree),
      worked_(wrappedLabel(QStringLiteral("segmentMap"))),
      add_(buttonOf(QStringLiteral("segmentAdd"), tr("Add"), [this] { add(); })),
      duplicate_(buttonOf(QStringLiteral("segmentDuplicate"), tr("Duplicate"), [this] { duplicate(); })),
      remove_(buttonOf(QStringLiteral("segmentRemove"), tr("Remove"), [this] { remove(); })),
      colour_(new ColourButton(tr("Colour of the segment"))),
      opacity_(new QSlider(Qt::Horizontal)) {
  makeLayout();
  connect(list_, &QTreeWidget::itemChanged, this, &SegmentList::itemChanged);
  connect(list_, &QTreeWidget::currentItemChanged, this,
          [this](const QTreeWidgetItem* item) { choose(item); });
  connect(list_, &QTreeWidget::customContextMenuRequested, this, &SegmentList::showMenu);
  connectButtons();
  showSegments();
}

void SegmentList::makeLayout() {
  list_->setObjectName(QStringLiteral("segmentList"));
  list_->setAccessibleName(tr("Segments"));
  list_->setHeaderLabels({tr("Shown, name"), tr("Locked"), tr("ml"), tr("Map")});
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);
  list_->setContextMenuPolicy(Qt::CustomContextMenu);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);  // the tool tip has the whole text
  for (const int column : {lockColumn, amountColumn, mapColumn})
    list_->setItemDelegateForColumn(column, new NotTyped(list_));
  list_->header()->setStretchLastSection(false);
  list_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  list_->header()->setSectionResizeMode(shownColumn, QHeaderView::Stretch);
  colour_->setObjectName(QStringLiteral("segmentColour"));
  opacity_->setObjectName(QStringLiteral("segmentFill"));
  opacity_->setAccessibleName(tr("Opacity of the segment"));
  opacity_->setRange(0, 100);
  opacity_->setMinimumWidth(40);
  stack(this, {{list_, 1}, worked_, lineOf({add_, duplicate_, remove_, colour_, {opacity_, 1}})});
}

void SegmentList::connectButtons() {
  auto* key = new QShortcut(Qt::Key_Delete, list_, nullptr, nullptr, Qt::WidgetShortcut);
  connect(key, &QShortcut::activated, this, [this] {
    if (remove_->isEnabled()) remove();
  });
  connect(colour_, &ColourButton::colourEdited, this, [this](glm::dvec3 colour) {
    editCurrent(
        tr("Colour of a segment"),
        [colour](Segment& s) { s.colour = glm::u8vec3(glm::round(255.0 * colour)); },
        QStringLiteral("segment's colour"));
  });
  connect(opacity_, &QSlider::valueChanged, this, [this](int percent) {
    editCurrent(
        tr("Opacity of a segment"), [percent](Segment& s) { s.opacity = percent / 100.0; },
        QStringLiteral("segment's opacity"));
  });
  connect(colour_, &ColourButton::gestureFinished, &session_, &Session::endGesture);
  connect(opacity_, &QSlider::sliderReleased, &session_, &Session::endGesture);
}

// Reuses row items, so that a name being typed stays in its field.
void SegmentList::showSegments() {
  const QSignalBlocker quietList(list_), quietSlider(opacity_);
  const std::vector<const SegmentMap*> maps = allSegmentsShown(session_);
  const SegmentMap* worked = segmentsShown(session_);
  const Segment* current = segmentShown(session_);
  int row = 0;
  QTreeWidgetItem* chosen = nullptr;
  for (const SegmentMap* map : maps)
    for (const Segment& segment : map->segments) {
      QTreeWidgetItem* item = list_->topLevelItem(row++);
      if (!item) item = new QTreeWidgetItem(list_);
      showRow(item, *map, segment);
      if (map == worked && segment.number == current->number) chosen = item;
    }
  while (list_->topLevelItemCount() > row) delete list_->takeTopLevelItem(row);
  showMaps(maps.size() > 1);
  if (list_->currentItem() != chosen) list_->setCurrentItem(chosen);
  showRoom();
  if (current) {
    colour_->setColour(fromQColor(regionColour(current->colour, current->number)));
    opacity_->setValue(int(std::lround(100 * current->opacity)));
  }
  showButtons();
}

void SegmentList::showMaps(bool areSeveral) {
  list_->setColumnHidden(mapColumn, !areSeveral);
  worked_->setVisible(areSeveral);
  if (areSeveral)
    worked_->setText(tr("%1 is worked on: tools and steps change its segments, others keep their voxels.")
                         .arg(mapName(segmentsShown(session_)->number)));
}

// Makes the list as high as its rows within limits, so that the pages below stay visible.
void SegmentList::showRoom() {
  const int row = std::max(list_->sizeHintForRow(0), list_->fontMetrics().height() + 4);
  const int least = list_->header()->sizeHint().height() + leastRows * row + 2 * list_->frameWidth();
  const int more = (std::clamp(list_->topLevelItemCount(), leastRows, mostRows) - leastRows) * row;
  list_->setMinimumHeight(least);
  list_->setMaximumHeight(least + more);
  const QLayout& all = *layout();
  setMaximumHeight(
      more + (all.hasHeightForWidth() ? all.totalHeightForWidth(width()) : all.totalSizeHint().height()));
}

void SegmentList::showRow(QTreeWidgetItem* item, const SegmentMap& map, const Segment& segment) {
  const QString name = shownText(segment.label);
  item->setFlags(item->flags() | Qt::ItemIsEditable | Qt::ItemIsUserCheckable);
  item->setData(shownColumn, numberRole, segment.number);
  item->setData(shownColumn, mapRole, map.number);
  item->setText(shownColumn, name);
  item->setIcon(shownColumn, swatchOf(regionColour(segment.colour, segment.number)));
  item->setCheckState(shownColumn, segment.visible ? Qt::Checked : Qt::Unchecked);
  item->setCheckState(lockColumn, segment.locked ? Qt::Checked : Qt::Unchecked);
  item->setText(amountColumn, amountText(map, segment.number));
  item->setTextAlignment(amountColumn, Qt::AlignRight | Qt::AlignVCenter);
  item->setText(mapColumn, mapName(map.number));
  QFont font = list_->font();
  font.setItalic(segment.span.has_value());
  item->setFont(shownColumn, font);
  const QString follows = segment.span ? tr("Follows the curve until it is changed by hand.") : QString();
  item->setToolTip(shownColumn, toolTipOf(QStringList{name, codesText(segment), follows,
                                                      tr("A double-click or F2 renames it.")}));
  item->setToolTip(lockColumn, toolTipOf(tr("Locked: nothing takes voxels from it or gives it some.")));
}

QString SegmentList::amountText(const SegmentMap& map, int number) const {
  const auto* counted = numbers_.find({map.labels});
  if (!counted || !counted->value) return QStringLiteral("\u2026");
  const std::int64_t voxels = counted->value->voxels[std::size_t(number)];
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
      map && !freeNumber(*map) ? tr("There are 255 segments in this map, and no more fit.") : whyNone;
  const QString whyNoCurrent = !whyNone.isEmpty() ? whyNone
                               : current          ? QString()
                                                  : tr("There is no segment yet.");
  offerControl(add_, tr("Another segment, without voxels."), whyNoMore);
  offerControl(duplicate_,
               tr("A segment with these voxels and codes and a name alike, in another map: a map has each "
                  "voxel once."),
               whyNoCurrent);
  offerControl(remove_, tr("Removes the segment and its voxels (Del)."),
               whyNoCurrent.isEmpty() ? whyNotChanged(session_) : whyNoCurrent);
  offerControl(colour_, tr("Colour of the segment"), whyNoCurrent);
  offerControl(opacity_, tr("Opacity of the segment"), whyNoCurrent);
}

// Ignores an empty name. Makes the edited map current, except for changes of visibility.
void SegmentList::itemChanged(QTreeWidgetItem* item, int column) {
  if (!segmentsShown(session_)) return;
  const int map = mapNumberOf(item), number = segmentNumberOf(item);
  const SegmentMap* of = segmentMapOf(session_.workspace(), keyOf(session_.series()->series), map);
  const Segment* segment = of ? findSegment(*of, number) : nullptr;
  if (!segment) return;
  const QString name = item->text(shownColumn).trimmed(), before = shownText(segment->label);
  const bool isOn = item->checkState(column) == Qt::Checked;
  if (column == lockColumn)
    edit((isOn ? tr("Lock %1") : tr("Unlock %1")).arg(before), map, number,
         [isOn](Segment& s) { s.locked = isOn; });
  else if (column == shownColumn && isOn != segment->visible)
    showSegment(isOn, *of, *segment);
  else if (column == shownColumn && !name.isEmpty() && name != before)
    edit(tr("Rename %1").arg(before), map, number, [&](Segment& s) { s.label = name.toStdString(); });
  showSegments();
}

void SegmentList::showSegment(bool isOn, const SegmentMap& map, const Segment& segment) {
  const QString text = (isOn ? tr("Show %1") : tr("Hide %1")).arg(shownText(segment.label));
  const int worked = segmentsShown(session_)->number;
  Workspace after = withSegmentChanged(withMapWorkedOn(session_.workspace(), map.series, map.number),
                                       map.series, segment.number, [isOn](Segment& s) { s.visible = isOn; });
  session_.change(text, withMapWorkedOn(std::move(after), map.series, worked));
  session_.endGesture();
}

void SegmentList::edit(const QString& text, int map, int number,
                       const std::function<void(Segment&)>& change) {
  const SeriesKey series = keyOf(session_.series()->series);
  session_.change(
      text, withSegmentChanged(withMapWorkedOn(session_.workspace(), series, map), series, number, change));
  session_.endGesture();
}

void SegmentList::editCurrent(const QString& text, const std::function<void(Segment&)>& change,
                              const QString& mergeKey) {
  const Segment* segment = segmentShown(session_);
  if (!segment) return;
  const SeriesKey series = keyOf(session_.series()->series);
  session_.change(text, withSegmentChanged(session_.workspace(), series, segment->number, change), mergeKey);
}

void SegmentList::choose(const QTreeWidgetItem* item) {
  if (!item || !segmentsShown(session_)) return;
  const SeriesKey series = keyOf(session_.series()->series);
  session_.change(tr("Choose a segment"),
                  withCurrentSegment(withMapWorkedOn(session_.workspace(), series, mapNumberOf(item)), series,
                                     segmentNumberOf(item)));
  session_.endGesture();
}

void SegmentList::add() {
  session_.change(tr("Add segment"), withNewSegment(session_.workspace(), keyOf(session_.series()->series),
                                                    session_.series()->volume->geometry(), {}));
  session_.endGesture();
}

void SegmentList::duplicate() {
  const SegmentMap& map = *segmentsShown(session_);
  const Segment& segment = *segmentShown(session_);
  SegmentWork work =
      workShown(session_, tr("Duplicate %1").arg(shownText(segment.label)), tr("Copying a segment"));
  work.makeMaps = [from = map.number, number = segment.number](
                      const std::vector<SegmentMap>& maps,
                      const CancelToken&) -> Result<std::vector<SegmentMap>> {
    return withSegmentCopied(maps, from, number);
  };
  editing_.change(work);
}

// Opens a menu with the buttons' actions and the maps that can take the segment.
void SegmentList::showMenu(QPoint at) {
  QTreeWidgetItem* item = list_->itemAt(at);
  if (!item) return;
  list_->setCurrentItem(item);
  auto* menu = new QMenu(this);
  menu->setObjectName(QStringLiteral("segmentMenu"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->setToolTipsVisible(true);
  const auto offerMove = [&](const QString& text, std::optional<int> to) {
    const QString why = whyNotChanged(session_);
    const auto move = [this, to] {
      editing_.change(
          moveOf(session_, to, [editing = &editing_](const QString& sentence) { editing->note(sentence); }));
    };
    QAction* action = menu->addAction(text, this, move);
    action->setEnabled(why.isEmpty());
    action->setToolTip(toolTipOf(QStringList{
        tr("It takes its voxels from the segments there; where a locked one has some, it stays where it is."),
        why}));
  };
  menu->addAction(duplicate_->text(), this, &SegmentList::duplicate)->setEnabled(duplicate_->isEnabled());
  const SegmentMap* worked = segmentsShown(session_);
  for (const SegmentMap* map : allSegmentsShown(session_))
    if (map != worked) offerMove(tr("Move to %1").arg(mapName(map->number)), map->number);
  if (worked->segments.size() > 1) offerMove(tr("Move to a new map"), {});
  menu->addAction(remove_->text(), this, &SegmentList::remove)->setEnabled(remove_->isEnabled());
  menu->popup(list_->viewport()->mapToGlobal(at));
}

void SegmentList::remove() {
  const Segment* segment = segmentShown(session_);
  SegmentWork work =
      workShown(session_, tr("Remove %1").arg(shownText(segment->label)), tr("Removing a segment"));
  work.number = segment->number;
  editing_.change(work);
}

}  // namespace volumen
