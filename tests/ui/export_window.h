#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "io/export/dicom_series.h"
#include "tests/ui/leaving.h"
#include "tests/ui/marked_window.h"
#include "viewer/phantoms/phantoms.h"

namespace volumen::tests {

/// A window on a series with a length, a key image and a segment, whose Export dialog is answered.
struct ExportWindow : MarkedWindow {
  using MarkedWindow::MarkedWindow;

  QString status() { return child<QLabel>("toldText")->text(); }

  /// Chooses what leaves by keys in the dialog. Returns whether it is offered.
  bool ask(const char* choice) {
    child<QAction>("exportFiles")->trigger();
    auto* box = child<QComboBox>("exportChoice");
    const int n = box ? box->findText(QLatin1String(choice)) : -1;
    while (n >= 0 && box->currentIndex() < n) QTest::keyClick(box, Qt::Key_Down);
    return n >= 0 && box->currentIndex() == n;
  }
  /// Returns what is offered for the view in focus.
  QStringList choices() {
    child<QAction>("exportFiles")->trigger();
    const auto* box = child<QComboBox>("exportChoice");
    QStringList all;
    for (int n = 0; box && n < box->count(); ++n) all << box->itemText(n);
    QTest::keyClick(child<QDialog>("exportDialog"), Qt::Key_Escape);
    // A closed dialog would be found in place of the next one.
    return QTest::qWaitFor([&] { return !child<QDialog>("exportDialog"); }, longest) ? all : QStringList();
  }
  void answerWith(const QString& folder) {
    click("exportButton");
    answer(*this, "exportFolderDialog", folder);
  }
  /// Exports into a folder and waits until all is written.
  bool leave(const char* choice, const QString& folder) {
    if (!ask(choice)) return false;
    answerWith(folder);
    return QTest::qWaitFor([&] { return status().startsWith(QStringLiteral("Saved")); }, longest) && idle();
  }
};

/// Writes a CT of a head with a name into a folder. Returns whether that was possible.
inline bool writeNamedHead(const QString& folder) {
  DicomSeriesTags tags;
  tags.patientName = "Doe^Jane", tags.patientId = "PAT4711", tags.studyUid = "1.2.3.1", tags.modality = "CT";
  const Result<VolumePtr> head = makePhantom("ct-head:40");
  return head && writeDicomSeries(**head, tags, folder.toStdString());
}

/// Returns the values of an element of a file; empty if it has none.
inline std::string textIn(const QString& path, const DcmTagKey& tag) {
  DcmFileFormat file;
  OFString text;
  if (file.loadFile(path.toStdString().c_str()).good())
    file.getDataset()->findAndGetOFStringArray(tag, text, OFTrue);
  return text.c_str();
}

}  // namespace volumen::tests
