// Guards window.md "Open objects that refer to pictures": they are listed, and documents are read. Real
// events on real files.
#include <QTextBrowser>

#include "tests/ui/derived_2d.h"
#include "tests/unit/suite.h"
#include "ui/panels/report_dialog.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

class TestDerivedWindow : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theListTellsThem_data();
  void theListTellsThem();
  void theyAreCountedAgainWhenMoreIsOpen();
  void aKeyObjectGoesToItsPicture();
  void aReportIsRead();
  void aReportSaysWhatIsNotHere();
  void aReportNamesItsPatient();
  void anObjectAloneSaysWhatItIs_data();
  void anObjectAloneSaysWhatItIs();
  void aReportAloneIsShown();
  void whatIsForOpenPicturesIsShownAtOnce();
  void aPictureWithoutPixelsIsNamed();
  void lettersOfProjections_data();
  void lettersOfProjections();
};

void TestDerivedWindow::theListTellsThem_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QString>("name");
  QTest::addColumn<QString>("details");
  const auto row = [](const char* file, const char* name, const char* details) {
    QTest::newRow(file) << QString::fromLatin1(file) << QString::fromLatin1(name)
                        << QString::fromLatin1(details);
  };
  row(presentation, "Presentation state: TEST", "its picture is not here");
  row(keyObjects, "Key objects: Of Interest", "its picture is not here");
  row("dicom-2d/sr-tid1500-on-CT_small.dcm", "Report: Imaging Measurement Report", "its picture is not here");
  row("dicom-2d/seg-overlap-on-CT2.dcm", "Segmentation: ISO_IR 192", "none of its 4 pictures is here");
  row("pet-ct/sts019-rtstruct-ct.dcm", "Contours: RTstruct", "none of its 179 pictures is here");
}

void TestDerivedWindow::theListTellsThem() {
  NEED_REFERENCES();
  QFETCH(QString, file);
  QFETCH(QString, name);
  QFETCH(QString, details);
  References2d w({file.toLatin1().constData()});
  QVERIFY(w.has(name.toLatin1().constData()));
  const QStringList lines = w.item(name.toLatin1().constData())->text(0).split(QLatin1Char('\n'));
  QCOMPARE(lines.front(), name);
  QVERIFY2(lines.back().endsWith(details), qPrintable(lines.back()));
  QVERIFY2(w.item(name.toLatin1().constData())->parent() != nullptr, "it stands under its study");
}

void TestDerivedWindow::theyAreCountedAgainWhenMoreIsOpen() {
  NEED_REFERENCES();
  References2d w({keyObjects});
  QVERIFY(w.has("its picture is not here"));
  w.window.open({QString::fromStdString(dataPath(ct))});
  QTRY_VERIFY_WITH_TIMEOUT(!w.item("its picture is not here"), longest);
  QVERIFY(w.item("Key objects: Of Interest"));
}

void TestDerivedWindow::aKeyObjectGoesToItsPicture() {
  NEED_REFERENCES();
  References2d w({"dicom-2d/sc-rgb-41.dcm", ct, keyObjects});
  QVERIFY(w.has("Key objects: Of Interest") && w.has("CT (1)") && w.showsFrame());
  w.click("Key objects: Of Interest");
  QVERIFY(w.shows([](const FlatView& v) {
    return tests::frameIn(&v) && tests::frameIn(&v)->slice->series.modality == "CT" &&
           tests::frameIn(&v)->key.series == v.state().series;
  }));
  QVERIFY(w.saysOnView("\u2605 Key image"));
  QCOMPARE(w.workspace().keyImages.size(), std::size_t(0));
  w.shot("key-object");
}

void TestDerivedWindow::aReportIsRead() {
  NEED_REFERENCES();
  References2d w({"dicom-2d/sr-tid1500-groups-on-CT_small.dcm", "dicom-2d/sc-rgb-41.dcm", ct});
  QVERIFY(w.has("Report") && w.has("CT (1)") && w.showsFrame());
  w.click("Report");
  QTRY_VERIFY_WITH_TIMEOUT(w.child<ReportDialog>("reportDialog"), longest);
  auto* text = w.child<QTextBrowser>("reportText");
  const QString said = text->toPlainText();
  for (const char* part : {"LungNodule0001", "10 mm", "Aorta0001", "20 mm", "-119.07", "HU", "Vertebra0001",
                           "200 mm\u00b3", "123.5, 234.1, -23.7 mm"})
    QVERIFY2(said.contains(QString::fromUtf8(part)), qPrintable(said));
  if (const QString shots = qEnvironmentVariable("VOLUMEN_SHOTS"); !shots.isEmpty())
    w.child<ReportDialog>("reportDialog")->grab().save(shots + QStringLiteral("/report.png"));
  // Follows the first link by the keyboard instead of the mouse.
  text->setFocus();
  QTest::keyClick(text, Qt::Key_Tab);
  QTest::keyClick(text, Qt::Key_Return);
  QVERIFY(w.shows([](const FlatView& v) {
    return tests::frameIn(&v) && tests::frameIn(&v)->slice->series.modality == "CT";
  }));
}

void TestDerivedWindow::aReportSaysWhatIsNotHere() {
  NEED_REFERENCES();
  References2d w({"dicom-2d/sr-tid1500-on-CT_small.dcm"});
  QVERIFY(w.has("Report"));
  QVERIFY2(w.child<Banner>("banner")->isHidden(), "there is something to see");
  w.click("Report");
  QTRY_VERIFY_WITH_TIMEOUT(w.child<ReportDialog>("reportDialog"), longest);
  auto* text = w.child<QTextBrowser>("reportText");
  QVERIFY2(text->toPlainText().contains(QStringLiteral("is not here")), qPrintable(text->toPlainText()));
  QVERIFY(!text->toHtml().contains(QStringLiteral("href")));
}

// The patient's name is shown even if the view shows pictures of another patient.
void TestDerivedWindow::aReportNamesItsPatient() {
  NEED_REFERENCES();
  References2d w({"dicom-2d/sr-tid1500-groups-on-CT_small.dcm", "dicom-2d/sc-rgb-41.dcm", ct});
  QVERIFY(w.has("Report") && w.has("CT (1)") && w.showsFrame());
  w.click("Report");
  QTRY_VERIFY_WITH_TIMEOUT(w.child<ReportDialog>("reportDialog"), longest);
  auto* dialog = w.child<ReportDialog>("reportDialog");
  auto* other = dialog->findChild<QLabel*>(QStringLiteral("reportOther"));
  QVERIFY(dialog->windowTitle().endsWith(QStringLiteral(" - CompressedSamples, CT1 (1CT1)")));
  QVERIFY(other->isVisibleTo(dialog));
  QVERIFY(other->text().contains(QStringLiteral("This report is of CompressedSamples, CT1 (1CT1).")));
  w.click("CT (1)");
  QTRY_VERIFY_WITH_TIMEOUT(!other->isVisibleTo(dialog), longest);
  w.child<QAction>("hideNames")->trigger();
  QVERIFY(dialog->windowTitle().endsWith(QStringLiteral(" - (name hidden)")));
  w.child<QAction>("hideNames")->trigger();
}

void TestDerivedWindow::anObjectAloneSaysWhatItIs_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QString>("said");
  QTest::newRow("presentation state")
      << QString::fromLatin1(presentation) << QStringLiteral("it says how pictures are to be shown");
  QTest::newRow("key objects") << QString::fromLatin1(keyObjects) << QStringLiteral("they mark pictures");
  QTest::newRow("segmentation") << QStringLiteral("dicom-2d/seg-on-CT_small.dcm")
                                << QStringLiteral("regions that tint slices");
  QTest::newRow("structure set") << QStringLiteral("pet-ct/sts019-rtstruct-ct.dcm")
                                 << QStringLiteral("outlines of regions over slices");
}

void TestDerivedWindow::anObjectAloneSaysWhatItIs() {
  NEED_REFERENCES();
  QFETCH(QString, file);
  QFETCH(QString, said);
  NEED_DATA(dataPath(file.toStdString()));
  References2d w({file.toLatin1().constData()});
  auto* banner = w.child<Banner>("banner");
  QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible(), longest);
  QVERIFY2(
      banner->sentence().contains(said) && banner->sentence().contains(QStringLiteral("Open the pictures")),
      qPrintable(banner->sentence()));
}

void TestDerivedWindow::aReportAloneIsShown() {
  NEED_REFERENCES();
  References2d w({"dicom-2d/sr-tid1500-on-CT_small.dcm"});
  QTRY_VERIFY_WITH_TIMEOUT(w.child<ReportDialog>("reportDialog"), longest);
  QVERIFY(w.child<Banner>("banner")->isHidden());
}

void TestDerivedWindow::whatIsForOpenPicturesIsShownAtOnce() {
  NEED_REFERENCES();
  References2d w({ct});
  QVERIFY(w.has("CT (1)"));
  w.window.open({QString::fromStdString(dataPath("dicom-2d/seg-on-CT_small.dcm"))});
  QTRY_COMPARE_WITH_TIMEOUT(w.workspace().regions.size(), std::size_t(1), longest);
  w.window.open({QString::fromStdString(dataPath(presentation))});
  QVERIFY(w.isPresented());
}

void TestDerivedWindow::aPictureWithoutPixelsIsNamed() {
  NEED_REFERENCES();
  References2d w({"dicom-2d/pr-without-pixels"});
  QVERIFY(w.has("Presentation state: PRESENTATION"));
  w.child<Banner>("banner")->hide();
  w.click("Presentation state: PRESENTATION");
  const QString said = w.child<Banner>("banner")->sentence();
  QVERIFY2(said.contains(QStringLiteral("can be shown")) && said.contains(QStringLiteral("cr.dcm")) &&
               said.contains(QStringLiteral("without pixel data")),
           qPrintable(said));
  QVERIFY(w.workspace().series.empty());
}

void TestDerivedWindow::lettersOfProjections_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QStringList>("letters");  // left, right, top, bottom
  QTest::newRow("MLO, P\\FL") << QStringLiteral("dicom-2d/mg-sigmoid-voilut3.dcm")
                              << QStringList{QStringLiteral("A"), QStringLiteral("P"), QStringLiteral("SR"),
                                             QStringLiteral("IL")};
  QTest::newRow("CC, R\\P") << QStringLiteral("dicom-2d/mg-ermf-overlay-shutter.dcm")
                            << QStringList{QStringLiteral("L"), QStringLiteral("R"), QStringLiteral("A"),
                                           QStringLiteral("P")};
  QTest::newRow("not said") << QStringLiteral("dicom-2d/cr-hip-mono2-jpeg12.dcm")
                            << QStringList{QString(), QString(), QString(), QString()};
}

void TestDerivedWindow::lettersOfProjections() {
  NEED_REFERENCES();
  QFETCH(QString, file);
  QFETCH(QStringList, letters);
  References2d w({file.toLatin1().constData()});
  QVERIFY(w.showsFrame());
  const Overlays o = w.view()->overlays();
  QCOMPARE((QStringList{o.left, o.right, o.top, o.bottom}), letters);
  w.shot(qPrintable(QStringLiteral("letters-") + QString::fromLatin1(QTest::currentDataTag()).left(2)));
}

VOLUMEN_TEST(TestDerivedWindow);
#include "tst_derived_window.moc"
