#include <QFileInfo>
#include <QTreeWidgetItemIterator>
#include <algorithm>
#include <unordered_set>

#include "ui/panels/studies_panel.h"
#include "ui/panels/studies_panel_roles.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/reference_text.h"
#include "ui/workspace/text.h"

namespace volumen {

// Null for all other items.
ReferencePtr StudiesPanel::referenceOf(const QTreeWidgetItem* item) const {
  const QVariant index = item->data(0, referenceRole);
  const OpenStudy* opened = index.isValid() ? openedOf(item) : nullptr;
  if (!opened || index.toULongLong() >= opened->study->references.size()) return nullptr;
  return {opened->study, &opened->study->references[index.toULongLong()]};
}

void StudiesPanel::addReference(const OpenStudy& opened, std::size_t n) {
  if (!studies_.isListed(opened.study->references[n])) return;
  Series study;
  static_cast<SeriesIdentity&>(study) = opened.study->references[n];
  study.format = "DICOM";
  auto* item = new QTreeWidgetItem(studyItem(study));
  item->setData(0, pathRole, opened.path);
  item->setData(0, referenceRole, qulonglong(n));
}

// Again whenever there is more in the list that they may refer to.
void StudiesPanel::showReferences() {
  std::unordered_set<std::string_view> here;
  for (const Series* series : studies_.pictures())
    here.insert(series->sopInstanceUids.begin(), series->sopInstanceUids.end());
  const std::vector<ReferencePtr> objects = studies_.references();
  for (const ReferencePtr& object : objects) here.insert(object->sopInstanceUid);
  for (QTreeWidgetItemIterator it(tree_); *it; ++it) {
    const ReferencePtr object = referenceOf(*it);
    if (!object) continue;
    const auto notHere = std::size_t(std::ranges::count_if(
        object->pictures, [&](const ReferencedPicture& p) { return !here.contains(p.sopInstanceUid); }));
    const QStringList lines = referenceLines(*object, notHere);
    (*it)->setText(0, lines.join(QLatin1Char('\n')));
    const QStringList tip = lines + QStringList{shownText(object->text), pathText(object->path)};
    (*it)->setToolTip(0, toolTipOf(tip));
  }
}

}  // namespace volumen
