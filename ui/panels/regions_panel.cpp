#include "ui/panels/regions_panel.h"

#include <QMenu>
#include <QScrollBar>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>
#include <utility>

#include "results/segments/region_colours.h"
#include "results/text/text.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/derived_text.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

enum RegionRole { pathOfRegion = Qt::UserRole, idOfRegion, numberOfRegion };

DerivedKey keyOfItem(const QTreeWidgetItem* item) {
  return {item->data(0, pathOfRegion).toString().toStdString(),
          item->data(0, idOfRegion).toString().toStdString()};
}

QIcon swatch(const QColor& colour) {
  QPixmap pixmap(12, 12);
  pixmap.fill(colour);
  return pixmap;
}

glm::dvec3 meanOf(const std::vector<glm::dvec3>& points) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& p : points) sum += p;
  return sum / double(points.size());
}

// Returns the middle of a region's middle contour or of a segment's middle plane.
std::optional<glm::dvec3> middleOfRegion(const LoadedRegions& regions, int number) {
  if (regions.contours) {
    for (const RegionOfInterest& region : regions.contours->regions)
      if (region.number == number && !region.contours.empty() &&
          !region.contours[region.contours.size() / 2].points.empty())
        return meanOf(region.contours[region.contours.size() / 2].points);
    return {};
  }
  const Segmentation& all = *regions.segmentation;
  std::vector<glm::dvec3> origins;
  for (const SegmentFrame& frame : all.frames)
    if (all.segments[frame.segment].number == number) origins.push_back(frame.origin);
  if (origins.empty()) return {};
  const glm::dvec2 half = glm::dvec2(all.size - 1) / 2.0 * all.mm;
  return origins[origins.size() / 2] + half.x * all.right + half.y * all.down;
}

}  // namespace

RegionsLook firstLook(const DerivedObject& object) {
  RegionsLook look;
  look.kind = object.kind;
  look.label = object.label;
  look.frameOfReferenceUid = object.frameOfReferenceUid;
  return look;
}

RegionsPanel::RegionsPanel(Session& session, DerivedObjects& derived, QWidget* parent)
    : QWidget(parent),
      session_(session),
      derived_(derived),
      empty_(wrappedLabel(QStringLiteral("regionsEmpty"),
                          tr("Contours (RTSTRUCT) and segmentations (SEG) of what is open stand here."))),
      list_(new QTreeWidget),
      opacity_(new QSlider(Qt::Horizontal)) {
  list_->setObjectName(QStringLiteral("regionList"));
  list_->setAccessibleName(tr("Contours and segments"));
  list_->setHeaderHidden(true);
  list_->setIndentation(12);
  list_->setContextMenuPolicy(Qt::CustomContextMenu);
  list_->setMinimumHeight(60);
  opacity_->setObjectName(QStringLiteral("segmentOpacity"));
  opacity_->setAccessibleName(tr("Opacity of segments"));
  opacity_->setToolTip(tr("Opacity of segments"));
  opacity_->setRange(0, 100);
  stack(this, {empty_, {list_, 1}, lineOf({opacity_->accessibleName(), {opacity_, 1}})}, 8);
  connect(list_, &QTreeWidget::itemChanged, this, &RegionsPanel::toggle);
  connect(list_, &QTreeWidget::itemDoubleClicked, this, &RegionsPanel::choose);
  connect(list_, &QTreeWidget::customContextMenuRequested, this, &RegionsPanel::showMenu);
  connect(opacity_, &QSlider::valueChanged, this, &RegionsPanel::setOpacity);
  connect(opacity_, &QSlider::sliderReleased, &session_, &Session::endGesture);
  connect(&derived_, &DerivedObjects::changed, this, &RegionsPanel::showAll);
  whenChanged(session_, this, &RegionsPanel::showAll, &Workspace::regions);
  showAll();
}

void RegionsPanel::showAll() {
  const QSignalBlocker quietList(list_), quietSlider(opacity_);
  const auto& shown = session_.workspace().regions;
  SharedMap<DerivedKey, RegionsLook> all = shown;
  for (const DerivedObjectPtr& object : derived_.all())
    if (object->kind == DerivedKind::contours || object->kind == DerivedKind::segmentation)
      all.add(keyOf(*object), firstLook(*object));
  const int scrolled = list_->verticalScrollBar()->value();
  list_->clear();
  bool anySegments = false;
  for (const auto& [key, look] : all) {
    const bool isShown = shown.contains(key);
    QTreeWidgetItem* item = addObject(key, look, isShown);
    const auto regions = isShown ? derived_.regions(key) : nullptr;
    if (!regions) continue;
    if (regions->contours)
      for (const RegionOfInterest& region : regions->contours->regions)
        addRegion(item, look, region.number, shownText(region.name),
                  regionColour(region.colour, region.number));
    if (!regions->segmentation) continue;
    for (const std::string& note : regions->segmentation->notes) addNote(item, shownText(note));
    for (const Segment& segment : regions->segmentation->segments)
      addRegion(item, look, segment.number, shownText(segment.label),
                regionColour(segment.colour, segment.number));
    if (!std::exchange(anySegments, true)) opacity_->setValue(int(std::lround(100 * look.opacity)));
  }
  list_->verticalScrollBar()->setValue(scrolled);
  opacity_->setEnabled(anySegments);
  empty_->setVisible(all.empty());
  list_->setVisible(!all.empty());
}

QTreeWidgetItem* RegionsPanel::addObject(const DerivedKey& key, const RegionsLook& look, bool shown) {
  DerivedObject named;
  named.kind = look.kind;
  named.label = look.label;
  auto* item = new QTreeWidgetItem(list_, {derivedName(named)});
  item->setToolTip(0, toolTipOf(pathText(key.path)));
  item->setData(0, pathOfRegion, QString::fromStdString(key.path));
  item->setData(0, idOfRegion, QString::fromStdString(key.id));
  item->setCheckState(0, shown ? Qt::Checked : Qt::Unchecked);
  item->setExpanded(true);
  return item;
}

void RegionsPanel::addRegion(QTreeWidgetItem* parent, const RegionsLook& look, int number,
                             const QString& text, const QColor& colour) {
  const QString name = text.isEmpty() ? tr("Region %1").arg(number) : text;
  auto* item = new QTreeWidgetItem(parent, {name});
  item->setIcon(0, swatch(colour));
  item->setToolTip(0, toolTipOf(tr("%1: a double-click goes to it").arg(name)));
  for (const int role : {pathOfRegion, idOfRegion}) item->setData(0, role, parent->data(0, role));
  item->setData(0, numberOfRegion, number);
  item->setCheckState(0, look.shows(number) ? Qt::Checked : Qt::Unchecked);
}

void RegionsPanel::addNote(QTreeWidgetItem* parent, const QString& sentence) {
  auto* item = new QTreeWidgetItem(parent, {QStringLiteral("! ") + sentence});
  item->setToolTip(0, toolTipOf(sentence));
  item->setFlags(Qt::ItemIsEnabled);
}

void RegionsPanel::toggle(QTreeWidgetItem* item) {
  const DerivedKey key = keyOfItem(item);
  const bool on = item->checkState(0) == Qt::Checked;
  const QVariant number = item->data(0, numberOfRegion);
  const auto edit = [this, key, on, number](Workspace& w) {
    if (number.isValid()) return void(w.regions.editOrAdd(key).shown.editOrAdd(number.toInt()) = on);
    if (!on) return void(w.regions.erase(key));
    for (const DerivedObjectPtr& object : derived_.all())
      if (keyOf(*object) == key) w.regions.editOrAdd(key) = firstLook(*object);
  };
  // Queued, because the change refills the list that is emitting this signal.
  QMetaObject::invokeMethod(
      this,
      [this, edit, text = on ? tr("Show %1").arg(item->text(0)) : tr("Hide %1").arg(item->text(0))] {
        session_.change(text, edit);
        session_.endGesture();
      },
      Qt::QueuedConnection);
}

void RegionsPanel::choose(QTreeWidgetItem* item) {
  const QVariant number = item->data(0, numberOfRegion);
  const auto look = session_.workspace().regions.find(keyOfItem(item));
  if (!number.isValid() || look == session_.workspace().regions.end()) return;
  const auto regions = derived_.regions(look->first);
  if (!regions) return;
  std::string frame = look->second.frameOfReferenceUid;
  if (regions->contours)
    for (const RegionOfInterest& region : regions->contours->regions)
      if (region.number == number.toInt() && !region.frameOfReferenceUid.empty())
        frame = region.frameOfReferenceUid;
  if (const auto middle = middleOfRegion(*regions, number.toInt())) Q_EMIT placeChosen(frame, *middle);
}

// Opens a menu for a segmentation and its rows.
void RegionsPanel::showMenu(QPoint position) {
  const QTreeWidgetItem* item = list_->itemAt(position);
  if (!item) return;
  const DerivedKey key = keyOfItem(item);
  const auto isIt = [&](const DerivedObjectPtr& object) {
    return keyOf(*object) == key && object->kind == DerivedKind::segmentation;
  };
  if (std::ranges::none_of(derived_.all(), isIt)) return;
  auto* menu = new QMenu(this);
  menu->setObjectName(QStringLiteral("regionMenu"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->addAction(tr("Edit as segments"), this,
                  [this, path = QString::fromStdString(key.path)] { Q_EMIT segmentsRequested({path}); });
  menu->popup(list_->viewport()->mapToGlobal(position));
}

void RegionsPanel::setOpacity(int percent) {
  const QString what = tr("Opacity of segments");
  session_.change(
      what,
      [&](Workspace& w) {
        w.regions.editIf([](const auto& entry) { return entry.second.kind == DerivedKind::segmentation; },
                         [percent](RegionsLook& look) { look.opacity = percent / 100.0; });
      },
      what);
}

}  // namespace volumen
