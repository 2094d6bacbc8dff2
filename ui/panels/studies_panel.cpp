#include "ui/panels/studies_panel.h"

#include <QFileInfo>
#include <QTreeWidgetItemIterator>
#include <QVBoxLayout>

#include "ui/session/text.h"

namespace volumen {

namespace {

enum Role { keyRole = Qt::UserRole, pathRole, indexRole };

QString sizeText(const Series& series) {
  const VoxelGeometry& g = series.regular ? series.regular->geometry : series.acquired;
  QString text = QStringLiteral("%1 x %2 x %3").arg(g.size.x).arg(g.size.y).arg(g.size.z);
  if (g.calibrated) text += QStringLiteral(", %1 mm").arg(g.spacing().z, 0, 'g', 3);
  return text;
}

QString toolTipOf(const Series& series) {
  QStringList lines{seriesText(series), sizeText(series)};
  for (const Warning& w : series.warnings) lines << QStringLiteral("! ") + shownText(w.sentence);
  for (QString& line : lines) line = line.toHtmlEscaped();
  // Rich text, so that long sentences wrap.
  return QStringLiteral("<p>%1</p>").arg(lines.join(QStringLiteral("<br>")));
}

bool sameSeries(const Series& a, const Series& b) { return a.id == b.id && a.path == b.path; }

}  // namespace

StudiesPanel::StudiesPanel(QWidget* parent)
    : QWidget(parent), search_(new QLineEdit), tree_(new QTreeWidget) {
  search_->setObjectName(QStringLiteral("studySearch"));
  search_->setPlaceholderText(tr("Search"));
  search_->setAccessibleName(tr("Search patients, studies and series"));
  search_->setClearButtonEnabled(true);
  tree_->setObjectName(QStringLiteral("studyTree"));
  tree_->setAccessibleName(tr("Patients, studies and series"));
  tree_->setHeaderHidden(true);
  tree_->setIndentation(14);
  tree_->setUniformRowHeights(false);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->addWidget(search_);
  column->addWidget(tree_, 1);
  connect(search_, &QLineEdit::textChanged, this, &StudiesPanel::filter);
  const auto choose = [this](QTreeWidgetItem* item) {
    const QString path = item->data(0, pathRole).toString();
    const QVariant index = item->data(0, indexRole);
    if (!index.isValid()) return;
    for (const auto& [opened, study] : studies_)
      if (opened == path) return Q_EMIT seriesChosen(study->volumes[index.toULongLong()]);
  };
  connect(tree_, &QTreeWidget::itemClicked, this, choose);
  connect(tree_, &QTreeWidget::itemActivated, this, choose);
}

QTreeWidgetItem* StudiesPanel::childNamed(QTreeWidgetItem* parent, const QString& key, const QString& text) {
  for (int n = 0; n < parent->childCount(); ++n)
    if (parent->child(n)->data(0, keyRole).toString() == key) return parent->child(n);
  auto* item = new QTreeWidgetItem(parent, {text});
  item->setData(0, keyRole, key);
  item->setFlags(Qt::ItemIsEnabled);
  item->setExpanded(true);
  return item;
}

void StudiesPanel::addSeries(const QString& path, const Series& series, std::size_t n) {
  QTreeWidgetItem* parent = tree_->invisibleRootItem();
  if (series.format == "DICOM") {
    const QString patient = patientText(series);
    const std::string key = "patient " + series.patientName + "\n" + series.patientId;
    parent = childNamed(parent, QString::fromStdString(key), patient);
    parent = childNamed(parent, QString::fromStdString(series.studyUid), studyText(series));
  } else {
    parent = childNamed(parent, QStringLiteral("files"),
                        series.format == "phantom" ? tr("Phantoms") : tr("Files"));
  }
  auto* item = new QTreeWidgetItem(parent, {seriesText(series)});
  if (!series.warnings.empty()) item->setText(0, QStringLiteral("! ") + item->text(0));
  item->setToolTip(0, toolTipOf(series));
  item->setData(0, pathRole, path);
  item->setData(0, indexRole, qulonglong(n));
}

void StudiesPanel::addRefused(const QString& path, const Study& study) {
  if (study.refused.empty()) return;
  auto* parent = childNamed(tree_->invisibleRootItem(), QStringLiteral("refused"), tr("Could not be read"));
  parent->setExpanded(false);
  for (const Refused& refused : study.refused) {
    const QString name = pathText(refused.path), reason = shownText(refused.reason);
    auto* item = new QTreeWidgetItem(parent, {QFileInfo(name).fileName()});
    item->setToolTip(0, QStringLiteral("<p>%1<br>%2</p>").arg(name.toHtmlEscaped(), reason.toHtmlEscaped()));
    item->setData(0, pathRole, path);
    item->setFlags(Qt::ItemIsEnabled);
  }
}

void StudiesPanel::removePath(const QString& path) {
  std::erase_if(studies_, [&](const auto& opened) { return opened.first == path; });
  std::vector<QTreeWidgetItem*> gone;
  for (QTreeWidgetItemIterator it(tree_); *it; ++it)
    if ((*it)->data(0, pathRole).toString() == path) gone.push_back(*it);
  for (QTreeWidgetItem* item : gone) {
    while (item) {
      QTreeWidgetItem* parent = item->parent();
      delete item;
      item = parent && parent->childCount() == 0 ? parent : nullptr;
    }
  }
}

void StudiesPanel::addStudy(const QString& path, const std::shared_ptr<const Study>& study) {
  removePath(path);
  studies_.emplace_back(path, study);
  for (std::size_t n = 0; n < study->volumes.size(); ++n) addSeries(path, study->volumes[n], n);
  addRefused(path, *study);
  filter(search_->text());
}

void StudiesPanel::showNames() {
  const auto opened = studies_;
  for (const auto& [path, study] : opened) addStudy(path, study);
}

void StudiesPanel::markShown(const Series& series) {
  for (QTreeWidgetItemIterator it(tree_); *it; ++it) {
    const QVariant index = (*it)->data(0, indexRole);
    bool shown = false;
    for (const auto& [path, study] : studies_)
      shown = shown || (index.isValid() && (*it)->data(0, pathRole).toString() == path &&
                        sameSeries(study->volumes[index.toULongLong()], series));
    QFont font = (*it)->font(0);
    font.setBold(shown);
    (*it)->setFont(0, font);
    if (shown) tree_->setCurrentItem(*it);
  }
}

void StudiesPanel::filter(const QString& text) {
  // From the leaves up: a parent is shown with any of its children.
  const std::function<bool(QTreeWidgetItem*, bool)> show = [&](QTreeWidgetItem* item, bool all) {
    const bool found = all || item->text(0).contains(text, Qt::CaseInsensitive);
    bool any = found;
    for (int n = 0; n < item->childCount(); ++n) any = show(item->child(n), found) || any;
    item->setHidden(!any);
    return any;
  };
  for (int n = 0; n < tree_->topLevelItemCount(); ++n) show(tree_->topLevelItem(n), text.isEmpty());
}

}  // namespace volumen
