#pragma once

#include <QComboBox>
#include <QDialog>
#include <QDirIterator>
#include <QFile>

#include "io/archive/archives.h"
#include "io/files/output_file.h"
#include "io/files/preset_files.h"
#include "io/files/private_folder.h"
#include "tests/ui/browser_window.h"

namespace volumen::tests {

/// The user's list of archives, until the end of a test.
struct ListedArchives {
  explicit ListedArchives(const std::string& json) {
    isWritten = makePrivateFolder(configFolder()) && writeWholeFile(userArchivesFile(), json);
  }
  explicit ListedArchives(const Archives& archives) : ListedArchives(archivesToJson(archives)) {}
  /// Lists "main", a QrPeer.
  explicit ListedArchives(int port) : ListedArchives(Archives{{archiveAt(port)}}) {}
  ~ListedArchives() { QFile::remove(QString::fromStdString(userArchivesFile())); }
  ListedArchives(const ListedArchives&) = delete;
  ListedArchives& operator=(const ListedArchives&) = delete;
  static Archive archiveAt(int port) {
    Archive archive;
    archive.name = "main", archive.host = "127.0.0.1", archive.port = port, archive.calledAe = "ARCH";
    return archive;
  }

  bool isWritten = false;
};

inline QStringList dicomFilesBelow(const QString& folder) {
  QStringList files;
  for (QDirIterator all(folder, QDir::Files, QDirIterator::Subdirectories); all.hasNext();)
    files << all.next();
  return files;
}

/// A window whose archives are chosen and edited.
struct ArchivesWindow : BrowserWindow {
  using BrowserWindow::BrowserWindow;

  QComboBox* box() { return child<QComboBox>("browserSource"); }
  /// Lists a source by keys. Returns whether it is offered.
  bool choose(const char* name) {
    if (box()->isHidden()) return false;
    const int n = box()->findText(QString::fromUtf8(name));
    for (int tries = 0; n >= 0 && box()->currentIndex() != n && tries < box()->count(); ++tries)
      QTest::keyClick(box(), n > box()->currentIndex() ? Qt::Key_Down : Qt::Key_Up);
    return n >= 0 && box()->currentIndex() == n;
  }
  /// Searches the listed archive at once.
  void searchFor(const char* words) {
    search()->clear();
    QTest::keyClicks(search(), QString::fromUtf8(words));
    QTest::keyClick(search(), Qt::Key_Return);
  }
  /// Opens a study of a source. Returns whether the series is shown.
  bool open(const char* source, const char* study, const char* series) {
    if (!child<QWidget>("studyBrowser")->isVisible()) child<QAction>("showBrowser")->trigger();
    if (!choose(source)) return false;
    searchFor(study);
    if (!has(study, 4)) return false;
    doubleClick(row(study, 4));
    return isShown(series);
  }
  QStringList openPlaces() {
    QStringList places;
    for (const OpenStudy& opened : window.document().open.all()) places << opened.path;
    return places;
  }

  /// Opens the dialog of archives from the preferences.
  void edit() {
    if (!child<QPushButton>("editArchives")) QTest::keyClick(&window, Qt::Key_Comma, Qt::ControlModifier);
    press("editArchives");
  }
  void press(const char* button) { QTest::mouseClick(child<QPushButton>(button), Qt::LeftButton); }
  void type(const char* field, const QString& text) {
    child<QLineEdit>(field)->selectAll();
    QTest::keyClicks(child<QLineEdit>(field), text);
  }
  QString told() { return child<QLabel>("archiveTold")->text(); }
  bool isEditing() {
    const auto* dialog = child<QDialog>("archivesDialog");
    return dialog && dialog->isVisible();
  }
  /// Saves the list. Returns whether the dialog is gone.
  bool save() {
    press("saveArchives");
    return QTest::qWaitFor([&] { return !child<QDialog>("archivesDialog"); }, longest);
  }
};

}  // namespace volumen::tests
