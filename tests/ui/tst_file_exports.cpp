// Guards File > Export... by real events: each choice leaves as the object that it says, whole, with the
// values that are shown, with or without the patient's identity.
#include <QMimeData>
#include <QTreeWidgetItemIterator>
#include <memory>

#include "io/export/read_segments.h"
#include "io/load.h"
#include "io/open.h"
#include "io/report.h"
#include "tests/fixtures/program.h"
#include "tests/ui/export_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestFileExports : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init() { openAlone(); }
  void eachChoiceIsOneObject_data();
  void eachChoiceIsOneObject();
  void valuesAreThoseShown();
  void theSeriesIsCopied();
  void slicesAreLikeThoseInTheView();
  void namesAreHiddenInPictures();
  void identityIsLeftOut();
  void facesAreLeftOut();
  void draggedSeriesAreFiles();

 private:
  QTemporaryDir data_;
  QString ct_;
};

void TestFileExports::initTestCase() {
  ct_ = data_.filePath(QStringLiteral("ct"));
  QVERIFY(writeNamedHead(ct_));
}

void TestFileExports::eachChoiceIsOneObject_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QString>("sopClass");
  const auto row = [](const char* choice, const char* file, const char* sopClass) {
    QTest::newRow(choice) << QString::fromLatin1(file) << QString::fromLatin1(sopClass);
  };
  row("Its segments as they are now", "segments.dcm", "1.2.840.10008.5.1.4.1.1.66.4");
  row("Its segments as an RT structure set", "structures.dcm", "1.2.840.10008.5.1.4.1.1.481.3");
  row("The measurements of its study as a structured report", "measurements.dcm",
      "1.2.840.10008.5.1.4.1.1.88.33");
  row("The key images of its study as a list for archives", "key-images.dcm",
      "1.2.840.10008.5.1.4.1.1.88.59");
  row("Window and measurements of the series as a presentation state", "presentation.dcm",
      "1.2.840.10008.5.1.4.1.1.11.1");
  row("The picture in the view", "picture.dcm", "1.2.840.10008.5.1.4.1.1.7");
}

// In the study of its series, as a new one. A second one gets a name of its own.
void TestFileExports::eachChoiceIsOneObject() {
  QFETCH(QString, file);
  QFETCH(QString, sopClass);
  ExportWindow w(ct_);
  QVERIFY(w.prepare());
  w.session().setFocus(axialViewId);
  const QTemporaryDir folder;
  QVERIFY2(w.leave(QTest::currentDataTag(), folder.path()), qPrintable(w.status()));
  const QString path = folder.filePath(file);
  QCOMPARE(filesAt(folder.path()), QStringList{path});
  QCOMPARE(textIn(path, DCM_SOPClassUID), sopClass.toStdString());
  QCOMPARE(textIn(path, DCM_StudyInstanceUID), std::string("1.2.3.1"));
  QCOMPARE(textIn(path, DCM_PatientName), std::string("Doe^Jane"));
  const QByteArray before = contentsOf(path);
  w.child<QLabel>("toldText")->clear();
  QVERIFY2(w.leave(QTest::currentDataTag(), folder.path()), qPrintable(w.status()));
  QCOMPARE(filesAt(folder.path()).size(), qsizetype(2));
  QVERIFY(contentsOf(path) == before);
  w.window.end();
}

// The length of the report, the key image, and the voxels of segments are those of the window.
void TestFileExports::valuesAreThoseShown() {
  ExportWindow w(ct_);
  QVERIFY(w.prepare());
  const QTemporaryDir folder;
  for (const char* choice : {"The measurements of its study as a structured report",
                             "The key images of its study as a list for archives",
                             "Its segments as they are now", "Its segments as an RT structure set"}) {
    w.child<QLabel>("toldText")->clear();
    QVERIFY2(w.leave(choice, folder.path()), choice);
  }
  const Result<Report> report = loadReport(folder.filePath(QStringLiteral("measurements.dcm")).toStdString());
  QVERIFY2(report, report ? "" : report.message().c_str());
  QCOMPARE(report->groups.size(), std::size_t(1));
  const Shape& drawn = w.workspace().measurements[0].shape;
  QCOMPARE(*report->groups[0].measurements.at(0).value, glm::distance(drawn.points[0], drawn.points[1]));
  const Result<KeyObjects> keys =
      loadKeyObjects(folder.filePath(QStringLiteral("key-images.dcm")).toStdString());
  QVERIFY2(keys, keys ? "" : keys.message().c_str());
  QCOMPARE(keys->pictures.size(), std::size_t(1));
  QCOMPARE(keys->pictures[0].sopInstanceUid, w.workspace().keyImages[0].sopInstanceUid);
  const LoadedSeriesPtr shown = w.session().series();
  for (const char* file : {"segments.dcm", "structures.dcm"}) {
    const auto read = readSegments(folder.filePath(QLatin1String(file)).toStdString(), shown->series,
                                   shown->volume->geometry());
    QVERIFY2(read, read ? "" : read.message().c_str());
    QCOMPARE(maskOf(read->maps.at(0).labels, 1).count(), w.voxels(1));
  }
  w.window.end();
}

void TestFileExports::theSeriesIsCopied() {
  ExportWindow w(ct_);
  QVERIFY(w.prepare());
  const QTemporaryDir folder;
  QVERIFY(w.leave("The series in the view", folder.path()));
  QStringList here = filesAt(ct_), there = filesAt(folder.filePath(QStringLiteral("series")));
  QCOMPARE(there.size(), here.size());
  QCOMPARE(filesAt(folder.path()).size(), here.size());
  std::set<QByteArray> originals, copies;
  for (const QString& file : here) originals.insert(contentsOf(file));
  for (const QString& file : there) copies.insert(contentsOf(file));
  QVERIFY(copies == originals);
  w.window.end();
}

// Coronal ones through the whole head: the volume that they are read as has its values at the same places.
void TestFileExports::slicesAreLikeThoseInTheView() {
  ExportWindow w(ct_);
  QVERIFY(w.prepare());
  w.session().setFocus(coronalViewId);
  const QTemporaryDir folder;
  QVERIFY(w.leave("All slices like that in the view as a new series", folder.path()));
  const Volume& shown = *w.session().series()->volume;
  const std::string path = folder.filePath(QStringLiteral("slices")).toStdString();
  const auto study = openStudy(path);
  QVERIFY(study && study->volumes.size() == 1);
  const auto read = loadSeries(study->volumes[0]);
  QVERIFY2(read, read ? "" : read.message().c_str());
  const VoxelGeometry &here = shown.geometry(), &there = read->drawn->geometry();
  QCOMPARE(there.size.z, here.size.y);
  const glm::dvec3 normal = glm::normalize(there.patientFromVoxelStep[2]);
  QVERIFY(std::abs(normal.y) > 0.999);
  int compared = 0;
  for (int y = 5; y < 35; y += 5)
    for (int x = 5; x < 35; x += 5) {
      const glm::dvec3 voxel = there.voxelFromPatient(here.patientFromVoxel({x, y, 20}));
      const glm::ivec3 nearest = glm::round(voxel);
      if (glm::distance(voxel, glm::dvec3(nearest)) > 1e-3) continue;
      QVERIFY(std::abs(read->drawn->value(nearest.x, nearest.y, nearest.z) - shown.value(x, y, 20)) <= 0.5);
      ++compared;
    }
  QVERIFY(compared > 10);
  w.window.end();
}

void TestFileExports::namesAreHiddenInPictures() {
  ExportWindow w(ct_);
  QVERIFY(w.prepare());
  w.session().setFocus(axialViewId);
  std::vector<QByteArray> pictures;
  for (const bool isHidden : {false, true}) {
    const QTemporaryDir folder;
    w.child<QLabel>("toldText")->clear();
    QVERIFY(w.ask("The picture in the view"));
    auto* hide = w.child<QCheckBox>("exportHideNames");
    QVERIFY(hide->isEnabled() && !hide->isChecked());
    if (isHidden) QTest::mouseClick(hide, Qt::LeftButton, {}, {8, hide->height() / 2});
    w.answerWith(folder.path());
    QTRY_VERIFY_WITH_TIMEOUT(w.status().startsWith(QStringLiteral("Saved")), longest);
    const QString path = folder.filePath(QStringLiteral("picture.dcm"));
    QCOMPARE(textIn(path, DCM_BurnedInAnnotation), std::string(isHidden ? "NO" : "YES"));
    QCOMPARE(textIn(path, DCM_PatientName), std::string("Doe^Jane"));
    DcmFileFormat file;
    QVERIFY(file.loadFile(path.toStdString().c_str()).good());
    const Uint8* bytes = nullptr;
    unsigned long count = 0;
    QVERIFY(file.getDataset()->findAndGetUint8Array(DCM_PixelData, bytes, &count).good());
    pictures.emplace_back(reinterpret_cast<const char*>(bytes), qsizetype(count));
  }
  QVERIFY(pictures[0] != pictures[1]);
  w.window.end();
}

// The switch is remembered.
void TestFileExports::identityIsLeftOut() {
  ExportWindow w(ct_);
  QVERIFY(w.prepare());
  w.session().setFocus(axialViewId);
  for (const char* choice :
       {"The series in the view", "The picture in the view", "Its segments as they are now"}) {
    const QTemporaryDir folder;
    w.child<QLabel>("toldText")->clear();
    QVERIFY(w.ask(choice));
    auto* without = w.child<QCheckBox>("exportDeidentified");
    const bool isFirst = !without->isChecked();
    QCOMPARE(isFirst, choice == QByteArray("The series in the view"));
    if (isFirst) QTest::mouseClick(without, Qt::LeftButton, {}, {8, without->height() / 2});
    w.answerWith(folder.path());
    QTRY_VERIFY_WITH_TIMEOUT(!filesAt(folder.path()).isEmpty() && w.window.jobs().rows().empty(), longest);
    for (const QString& file : filesAt(folder.path())) {
      const QByteArray bytes = contentsOf(file);
      QVERIFY(bytes.size() > 132);
      for (const char* original : {"Doe", "PAT4711", "1.2.3.1"})
        QVERIFY2(!bytes.contains(original), original);
      QCOMPARE(textIn(file, DCM_PatientIdentityRemoved), std::string("YES"));
      QVERIFY(textIn(file, DCM_BurnedInAnnotation) != "YES");
    }
  }
  w.window.end();
}

// Faces go only without identity, and only from what may show a head.
void TestFileExports::facesAreLeftOut() {
  ExportWindow w(ct_);
  QVERIFY(w.prepare());
  w.session().setFocus(axialViewId);
  w.session().prefer([](Preferences& p) { p.exportsWithoutIdentity = false; });
  const QTemporaryDir folder;
  QVERIFY(w.ask("The series in the view"));
  auto* without = w.child<QCheckBox>("exportDeidentified");
  auto* faceless = w.child<QCheckBox>("exportFaceless");
  auto* choice = w.child<QComboBox>("exportChoice");
  QVERIFY(!faceless->isEnabled());
  QTest::mouseClick(without, Qt::LeftButton, {}, {8, without->height() / 2});
  QVERIFY(faceless->isEnabled() && !faceless->isChecked());
  const int series = choice->currentIndex();
  choice->setCurrentIndex(choice->findText(QStringLiteral("The picture in the view")));
  QVERIFY(!faceless->isEnabled());
  choice->setCurrentIndex(series);
  QTest::mouseClick(faceless, Qt::LeftButton, {}, {8, faceless->height() / 2});
  QVERIFY(faceless->isChecked());
  w.answerWith(folder.path());
  QTRY_VERIFY_WITH_TIMEOUT(!filesAt(folder.path()).isEmpty() && w.window.jobs().rows().empty(), longest);
  for (const QString& file : filesAt(folder.path())) {
    QCOMPARE(textIn(file, DCM_RecognizableVisualFeatures), std::string("NO"));
    QVERIFY(textIn(file, DCM_ImageType).starts_with("DERIVED"));
  }
  w.session().prefer([](Preferences& p) { p.exportsWithoutIdentity = false; });
  w.window.end();
}

// Those of the disk, for other programs; a drop on this window opens nothing again. Files have the identity,
// so none are given while exports leave it out.
void TestFileExports::draggedSeriesAreFiles() {
  ExportWindow w(ct_);
  QVERIFY(w.settle());
  const auto leaveIdentityOut = [&](bool on) {
    w.session().prefer([on](Preferences& p) { p.exportsWithoutIdentity = on; });
  };
  leaveIdentityOut(false);
  auto* tree = w.child<QTreeWidget>("studyTree");
  std::unique_ptr<QMimeData> dragged;
  for (QTreeWidgetItemIterator it(tree); *it && !dragged; ++it)
    dragged.reset(tree->model()->mimeData({tree->indexFromItem(*it)}));
  QVERIFY(dragged);
  QStringList files;
  for (const QUrl& url : dragged->urls()) files << url.toLocalFile();
  files.sort();
  QCOMPARE(files, filesAt(ct_));
  const auto opened = w.window.document().open.all().size();
  QDropEvent drop(QPointF(5, 5), Qt::CopyAction, dragged.get(), Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&w.window, &drop);
  QVERIFY(w.idle());
  QCOMPARE(w.window.document().open.all().size(), opened);
  leaveIdentityOut(true);
  for (QTreeWidgetItemIterator it(tree); *it; ++it) {
    const std::unique_ptr<QMimeData> now(tree->model()->mimeData({tree->indexFromItem(*it)}));
    QVERIFY(!now || !now->hasUrls());
  }
  leaveIdentityOut(false);
  w.window.end();
}

VOLUMEN_TEST(TestFileExports);
#include "tst_file_exports.moc"
