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
  if (!index.isValid()) return nullptr;
  for (const Opened& opened : studies_)
    if (opened.path == item->data(0, pathRole).toString() &&
        index.toULongLong() < opened.study->references.size())
      return {opened.study, &opened.study->references[index.toULongLong()]};
  return nullptr;
}

std::vector<const Series*> StudiesPanel::allPictures() const {
  std::vector<const Series*> all = allSeries();
  for (const Opened& opened : studies_)
    for (const Series& frames : opened.frames)
      if (isListed(frames)) all.push_back(&frames);
  return all;
}

std::vector<ReferencePtr> StudiesPanel::references() const {
  std::vector<ReferencePtr> all;
  for (const Opened& opened : studies_)
    for (const Reference& object : opened.study->references)
      if (isListed(object)) all.emplace_back(opened.study, &object);
  return all;
}

QStringList StudiesPanel::filesWithoutPixels() const {
  QStringList files;
  for (const Opened& opened : studies_) {
    if (!isListed(opened)) continue;
    for (const Other& other : opened.study->other) {
      const bool isReference = std::ranges::find(opened.study->references, other.path, &Reference::path) !=
                               opened.study->references.end();
      if (!isReference && other.kind.find("without pixel data") != std::string::npos)
        files << QStringLiteral("%1: %2.").arg(pathText(other.path), shownText(other.kind));
    }
  }
  return files;
}

void StudiesPanel::addReference(const Opened& opened, std::size_t n) {
  if (!isListed(opened.study->references[n])) return;
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
  for (const Series* series : allPictures())
    here.insert(series->sopInstanceUids.begin(), series->sopInstanceUids.end());
  const std::vector<ReferencePtr> objects = references();
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
