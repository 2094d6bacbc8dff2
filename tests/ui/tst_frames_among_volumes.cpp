// Guards slices.md 2 in the window: frames beside volumes, in the list and in layouts.
#include <QLabel>
#include <QSlider>
#include <QTemporaryDir>

#include "tests/ui/frames_window.h"

using namespace volumen;
using volumen::tests::clipFile;
using volumen::tests::dataFile;
using volumen::tests::Frames;
using volumen::tests::longest;

class TestFramesAmongVolumes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aVolumeAndAClipInTurn();
  void aVolumeIsShownAsFramesAndBack();
  void aPictureIsShownAsASliceAndBack();
  void theListTellsFrames();
  void layoutsSayWhyNothingComes();
  void namesAreHidden();
  void aFileThatWentIsASentence();
  void theSliderChoosesStepsInFramesToo();
};

void TestFramesAmongVolumes::aVolumeAndAClipInTurn() {
  NEED_FILES();
  Frames w({"../pet-ct/sts019-ct", clipFile});
  QVERIFY(w.settle());
  w.child<QAction>("layoutPlanes")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(w.item("34 frames") != nullptr, longest);
  for (int turn = 0; turn < 3; ++turn) {
    w.choose("34 frames");
    QVERIFY(w.shows());
    QVERIFY(!w.window.view()->isVisible());
    QVERIFY(w.view()->hasFocus());
    QVERIFY(w.window.windowTitle().contains(QStringLiteral("US")));
    w.choose("47 slices");
    QTRY_VERIFY_WITH_TIMEOUT(!showsFrames(w.view()->state().kind) && !w.view()->picture().isNull(), longest);
    QVERIFY(w.window.view()->isVisible());
    QVERIFY(w.session().series());
  }
  for (int step = 0; step < 5; ++step) w.child<QAction>("undo")->trigger();
  QVERIFY(w.shows());
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.window.view()->isVisible());
}

void TestFramesAmongVolumes::aVolumeIsShownAsFramesAndBack() {
  NEED_FILES();
  Frames w({"ct-two-windows.dcm"});
  QVERIFY(w.shows());
  QAction* asFrames = w.child<QAction>("showAsFrames");
  QVERIFY2(asFrames->isEnabled() && asFrames->isChecked(), "one slice opens as a picture");
  QCOMPARE(qGray(w.seen(256, 256)), 246);
  QVERIFY(w.after([&] { QTest::keyClick(w.view(), Qt::Key_2, Qt::ControlModifier); }));
  QCOMPARE(qGray(w.seen(256, 256)), 85);
  QCOMPARE(w.said(256, 256).section(QLatin1Char(' '), 0, 1), QStringLiteral("202 HU"));
  QVERIFY2(!w.view()->overlays().left.isEmpty(), "it lies somewhere in the patient");
  asFrames->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(w.session().series() != nullptr, longest);
  QVERIFY(!asFrames->isChecked());
  QVERIFY2(w.view()->isVisible() && !showsFrames(w.view()->state().kind), "the slice as a plane");
  asFrames->trigger();
  QVERIFY(w.shows());
  QVERIFY(asFrames->isChecked());
}

// The picture was never in memory as a volume.
void TestFramesAmongVolumes::aPictureIsShownAsASliceAndBack() {
  NEED_FILES();
  Frames w({"us-palette-cine-10.dcm", "mg-ermf-overlay-shutter.dcm"});
  QVERIFY(w.shows());
  QTRY_VERIFY_WITH_TIMEOUT(w.item("1 frame") != nullptr, longest);
  w.choose("1 frame");
  QVERIFY(w.shows());
  QAction* asFrames = w.child<QAction>("showAsFrames");
  QVERIFY(asFrames->isChecked());
  asFrames->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(w.session().series() && !asFrames->isChecked(), longest);
  QVERIFY(w.view()->isVisible() && !showsFrames(w.view()->state().kind));
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.shows());
  QVERIFY(asFrames->isChecked());
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.shows());
  QVERIFY(tests::frameIn(w.view())->colour());
}

void TestFramesAmongVolumes::theListTellsFrames() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  QTreeWidgetItem* clip = w.item("34 frames");
  QVERIFY(clip);
  QVERIFY(clip->toolTip(0).contains(QStringLiteral("cannot be shown in 3D")));
  const auto hasThumbnail = [&] {
    const QImage icon = clip->icon(0).pixmap(44, 44).toImage();
    for (int y = 0; y < icon.height(); ++y)
      for (int x = 0; x < icon.width(); ++x)
        if (qAlpha(icon.pixel(x, y)) && qGray(icon.pixel(x, y)) > 60) return true;
    return false;
  };
  QTRY_VERIFY_WITH_TIMEOUT(hasThumbnail(), longest);
  QVERIFY2(!w.item("Could not be read"), "what is shown is not listed as unread");
}

void TestFramesAmongVolumes::layoutsSayWhyNothingComes() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  w.child<QAction>("layoutPlanes")->trigger();
  QVERIFY(!w.window.view()->isVisible());
  const auto labels = w.window.findChildren<QLabel*>();
  QVERIFY(std::ranges::any_of(labels, [](QLabel* label) {
    return label->isVisible() && label->text().startsWith(QStringLiteral("Shown as frames alone"));
  }));
  QVERIFY(!w.child<QAction>("showAsFrames")->isEnabled());
}

void TestFramesAmongVolumes::namesAreHidden() {
  NEED_FILES();
  Frames w({"cr-hip-mono2-jpeg12.dcm"});
  QVERIFY(w.shows());
  QVERIFY(w.view()->overlays().topLeft.front().contains(QStringLiteral("CompressedSamples")));
  QVERIFY(w.window.windowTitle().contains(QStringLiteral("CompressedSamples")));
  w.child<QAction>("hideNames")->trigger();
  QVERIFY(!w.view()->overlays().topLeft.join(QString()).contains(QStringLiteral("Compressed")));
  QVERIFY(!w.window.windowTitle().contains(QStringLiteral("Compressed")));
  w.child<QAction>("hideNames")->trigger();
}

void TestFramesAmongVolumes::aFileThatWentIsASentence() {
  NEED_FILES();
  const QTemporaryDir folder;
  const QString copy = folder.filePath(QStringLiteral("clip.dcm"));
  QVERIFY(QFile::copy(dataFile("us-palette-cine-10.dcm"), copy));
  Frames w({});
  w.window.open({dataFile("sc-rgb-41.dcm"), copy});
  QVERIFY(w.shows());
  QTRY_VERIFY_WITH_TIMEOUT(w.item("10 frames") != nullptr, longest);
  QVERIFY(QFile::remove(copy));
  w.choose("10 frames");
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->failure().isEmpty(), longest);
  QVERIFY(w.view()->failure().contains(QStringLiteral("clip.dcm")));
  w.choose("1 frame");
  QVERIFY(w.shows());
  QVERIFY(w.view()->failure().isEmpty());
}

void TestFramesAmongVolumes::theSliderChoosesStepsInFramesToo() {
  NEED_FILES();
  Frames w({"../dicom-geometry/mr-qt2-multiecho-7"});
  QTRY_VERIFY_WITH_TIMEOUT(w.item("2 echoes") != nullptr, longest);
  w.choose("2 echoes");
  const auto echo = [&] { return seriesIn(w.workspace(), axialViewId)->echoTime; };
  QTRY_COMPARE_WITH_TIMEOUT(echo(), std::string("40"), longest);
  QVERIFY(w.shows());
  QVERIFY(w.press(Qt::Key_Down));
  const SeriesKey first = tests::frameIn(w.view())->key.series;
  const QImage picture = w.view()->picture();
  auto* slider = w.view()->findChild<QSlider*>();
  QVERIFY(slider && slider->isVisible());
  QCOMPARE(slider->maximum(), 1);
  const auto corner = [&] { return w.view()->overlays().topRight.join(QLatin1Char(' ')); };
  QVERIFY2(corner().contains(QStringLiteral("40 ms")), qPrintable(corner()));
  QVERIFY(w.press(Qt::Key_Right));
  QVERIFY(w.shows());
  QVERIFY(tests::frameIn(w.view())->key.series != first);
  QCOMPARE(tests::frameIn(w.view())->key.index, 1);
  QCOMPARE(slider->value(), 1);
  QVERIFY2(corner().contains(QStringLiteral("60 ms")), qPrintable(corner()));
  QVERIFY(w.view()->picture() != picture);
  slider->setValue(0);
  QVERIFY(w.shows());
  QCOMPARE(tests::frameIn(w.view())->key.series, first);
  QVERIFY(w.view()->picture() == picture);
}

VOLUMEN_TEST(TestFramesAmongVolumes);
#include "tst_frames_among_volumes.moc"
