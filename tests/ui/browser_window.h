#pragma once

#include <QAction>
#include <QContextMenuEvent>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTreeView>
#include <optional>

#include "io/export/dicom_series.h"
#include "io/index/index.h"
#include "tests/ui/journey.h"
#include "ui/widgets/banner.h"
#include "viewer/phantoms/phantoms.h"

namespace volumen::tests {

inline QStringList texts(std::initializer_list<const char*> utf8) {
  QStringList all;
  for (const char* text : utf8) all << QString::fromUtf8(text);
  return all;
}

/// A series to write: its folder, the phantom of its voxels and its attributes.
struct WrittenSeries {
  const char *folder, *phantom, *name, *id, *studyUid, *date, *study, *series;
};

/// Three patients: Doe with two studies, one of two series. Müller. A name in two scripts.
inline const std::vector<WrittenSeries>& writtenSeries() {
  static const std::vector<WrittenSeries> all{
      {"doe/bone", "ct-head:24", "Doe^Jane", "A111", "1.2.3.1", "20240310", "Head", "Bone"},
      {"doe/soft", "ct-head:20", "Doe^Jane", "A111", "1.2.3.1", "20240310", "Head", "Soft tissue"},
      {"doe/old", "sphere:16", "Doe^Jane", "A111", "1.2.3.2", "20190511", "Follow-up", "Scout"},
      {"mueller", "cube:16", "Müller^Jörg", "B222", "1.2.3.3", "20230105", "Abdomen", "Venous"},
      {"yamada", "sphere:20", "Yamada^Tarou=山田^太郎", "C333", "1.2.3.4", "20220602", "Knee", "Sagittal"}};
  return all;
}

/// Folders of studies, an index in its own folder, and windows that use it.
struct Studies {
  QTemporaryDir dir;
  QString data = dir.filePath(QStringLiteral("data")), home = dir.filePath(QStringLiteral("home"));

  bool write() const {
    for (const WrittenSeries& s : writtenSeries()) {
      const QString folder = data + QLatin1Char('/') + QString::fromUtf8(s.folder);
      QDir().mkpath(QFileInfo(folder).path());
      DicomSeriesTags tags;
      tags.patientName = s.name, tags.patientId = s.id, tags.studyUid = s.studyUid;
      tags.studyDate = s.date, tags.studyDescription = s.study, tags.description = s.series;
      const Result<VolumePtr> volume = makePhantom(s.phantom);
      if (!volume || !writeDicomSeries(**volume, tags, folder.toStdString())) return false;
    }
    return true;
  }
  bool import() const {
    if (!write()) return false;
    Result<Index> index = Index::open(home.toStdString());
    return index && index->import({data.toStdString()});
  }
  Services services() const {
    Services real = realServices();
    real.indexFolder = home.toStdString();
    return real;
  }
};

/// A window that shows the study browser.
struct BrowserWindow : Journey {
  explicit BrowserWindow(const Studies& studies, const QStringList& paths = {})
      : Journey(paths, studies.services()) {}
  explicit BrowserWindow(const Services& services) : Journey({}, services) {}

  QTreeView* tree() { return child<QTreeView>("browserTree"); }
  QListWidget* strip() { return child<QListWidget>("browserSeries"); }
  QLineEdit* search() { return child<QLineEdit>("browserSearch"); }
  QString notice() { return child<QLabel>("browserNotice")->text(); }
  Banner* banner() { return child<Banner>("banner"); }

  /// Returns the first row whose cell in `column` contains this text, at any expanded level.
  QModelIndex row(const char* text, int column = 0) {
    return tree()
        ->model()
        ->match(tree()->model()->index(0, column), Qt::DisplayRole, QString::fromUtf8(text), 1,
                Qt::MatchContains | Qt::MatchRecursive)
        .value(0)
        .siblingAtColumn(0);
  }
  bool has(const char* text, int column = 0) {
    return QTest::qWaitFor([&] { return row(text, column).isValid(); }, longest);
  }
  /// Returns the texts of a column of all patients, from top to bottom.
  QStringList patients(int column = 0) {
    QStringList texts;
    const QAbstractItemModel* model = tree()->model();
    for (int n = 0; n < model->rowCount(); ++n)
      if (model->index(n, 0).data().toString() != QStringLiteral("Opened last"))
        texts << model->index(n, column).data().toString();
    return texts;
  }
  bool shows(const QStringList& names) {
    return QTest::qWaitFor([&] { return patients() == names; }, longest);
  }

  void click(const QModelIndex& index, Qt::KeyboardModifiers modifiers = {}) {
    tree()->scrollTo(index);
    QTest::mouseClick(tree()->viewport(), Qt::LeftButton, modifiers, tree()->visualRect(index).center());
  }
  void doubleClick(const QModelIndex& index) {
    click(index);
    QTest::mouseDClick(tree()->viewport(), Qt::LeftButton, {}, tree()->visualRect(index).center());
  }
  /// Opens the context menu of a row. Returns null if there is none.
  QMenu* menuOf(const QModelIndex& index) {
    tree()->scrollTo(index);
    const QPoint at = tree()->visualRect(index).center();
    QTest::mouseClick(tree()->viewport(), Qt::RightButton, {}, at);
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, tree()->viewport()->mapToGlobal(at));
    QCoreApplication::sendEvent(tree()->viewport(), &event);
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    return menu && menu->objectName() == QStringLiteral("browserMenu") ? menu : nullptr;
  }
  /// Returns an entry of a context menu, or null.
  static QAction* entryOf(QMenu* menu, const char* text) {
    for (QAction* action : menu->actions())
      if (action->text() == QLatin1String(text)) return action;
    return nullptr;
  }
  static void chooseEntry(QMenu* menu, QAction* entry) {
    QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(entry).center());
  }
  /// Opens the study "Head", whose first series is "Bone".
  bool openHead() {
    if (!has("Head", 4)) return false;
    doubleClick(row("Head", 4));
    return isShown("Bone");
  }
  /// Waits until `view`, or the view in focus, shows a series with this description.
  bool isShown(const char* description, std::optional<ViewId> view = {}) {
    return QTest::qWaitFor(
        [&] {
          const Session& session = window.session();
          const LoadedSeriesPtr shown = session.seriesOf(view.value_or(session.workspace().focus));
          return shown && shown->series.description == description;
        },
        longest);
  }
};

}  // namespace volumen::tests
