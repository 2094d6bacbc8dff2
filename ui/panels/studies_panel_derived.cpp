#include <QFileInfo>
#include <QMenu>
#include <QTreeWidgetItemIterator>
#include <algorithm>
#include <unordered_set>

#include "results/text/text.h"
#include "ui/panels/studies_panel.h"
#include "ui/panels/studies_panel_roles.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/derived_text.h"

namespace volumen {

// Returns null for all other items.
DerivedObjectPtr StudiesPanel::derivedObjectOf(const QTreeWidgetItem* item) const {
  const QVariant index = item->data(0, derivedRole);
  const OpenStudy* opened = index.isValid() ? openedOf(item) : nullptr;
  if (!opened || index.toULongLong() >= opened->study->derived.size()) return nullptr;
  return {opened->study, &opened->study->derived[index.toULongLong()]};
}

void StudiesPanel::addDerivedObject(const OpenStudy& opened, std::size_t n) {
  if (!studies_.isListed(opened.study->derived[n])) return;
  Series study;
  static_cast<SeriesIdentity&>(study) = opened.study->derived[n];
  study.format = "DICOM";
  auto* item = new QTreeWidgetItem(studyItem(study));
  item->setData(0, pathRole, opened.path);
  item->setData(0, derivedRole, qulonglong(n));
}

void StudiesPanel::addObjectEntries(QMenu* menu, const DerivedObjectPtr& object) {
  if (!object) return;
  if (object->kind == DerivedKind::segmentation)
    menu->addAction(tr("Edit as segments"), this, [this, path = QString::fromStdString(object->path)] {
      Q_EMIT segmentsRequested({path});
    });
  menu->addAction(tr("Send to archive..."), this, [this, object] { Q_EMIT sendRequested(object); });
}

// Repeated whenever the list has new pictures that objects may refer to.
void StudiesPanel::showDerivedObjects() {
  std::unordered_set<std::string_view> here;
  for (const Series* series : studies_.pictures())
    here.insert(series->sopInstanceUids.begin(), series->sopInstanceUids.end());
  const std::vector<DerivedObjectPtr> objects = studies_.derived();
  for (const DerivedObjectPtr& object : objects) here.insert(object->sopInstanceUid);
  for (QTreeWidgetItemIterator it(tree_); *it; ++it) {
    const DerivedObjectPtr object = derivedObjectOf(*it);
    if (!object) continue;
    const auto notHere = std::size_t(std::ranges::count_if(
        object->pictures, [&](const ReferencedPicture& p) { return !here.contains(p.sopInstanceUid); }));
    const QStringList lines = referenceLines(*object, notHere);
    const QString mark = object->warnings.empty() ? QString() : QStringLiteral("! ");
    (*it)->setText(0, mark + lines.join(QLatin1Char('\n')));
    QStringList tip = lines + QStringList{shownText(object->text), pathText(object->path)};
    for (const std::string& warning : object->warnings) tip << QStringLiteral("! ") + shownText(warning);
    (*it)->setToolTip(0, toolTipOf(tip));
  }
}

}  // namespace volumen
