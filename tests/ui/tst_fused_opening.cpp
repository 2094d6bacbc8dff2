// Guards that a PET and the CT of its study open fused: by folder, by one path each in any order, or by a
// drop. Those of two patients do not. Real files.
#include <QMimeData>

#include "tests/ui/fusion_window.h"
#include "tests/ui/gestures.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using OpenBoth = std::function<void(PetCtWindow&, const QStringList&)>;

void openAtOnce(PetCtWindow& w, const QStringList& paths) { w.window.open(paths); }

void dropBoth(PetCtWindow& w, const QStringList& paths) {
  QMimeData data;
  QList<QUrl> urls;
  for (const QString& path : paths) urls << QUrl::fromLocalFile(path);
  data.setUrls(urls);
  QVERIFY(tests::drop(data, &w.window));
}

// Reads the second series once the first is on screen, as from a slow disk.
void openSlowly(PetCtWindow& w, const QStringList& paths) {
  OpenIntent together;
  together.isShown = std::make_shared<bool>(false);
  for (const QString& path : paths) {
    w.window.document().loader.open(path, together);
    QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series() != nullptr, longest);
  }
}

}  // namespace

class TestFusedOpening : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aStudyOfBothOpensFused();
  void bothThatAreNamedOpenFused_data();
  void bothThatAreNamedOpenFused();
  void thoseOfTwoPatientsDoNot();
  void besideItThePetStandsAlone_data();
  void besideItThePetStandsAlone();
  void aGridOfOneSeriesIsNoLayoutToComeBackTo();
  void itsControlsAreSeenWithoutScrolling_data();
  void itsControlsAreSeenWithoutScrolling();
};

void TestFusedOpening::aStudyOfBothOpensFused() {
  const std::string data = tests::dataPath("pet-ct");
  NEED_DATA(data);
  const UsualLayouts usual;
  PetCtWindow w(QStringList{QString::fromStdString(data)});
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series() != nullptr, longest);
  QVERIFY(w.isFused());
  for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId})
    QTRY_VERIFY_WITH_TIMEOUT(!w.window.views()->viewAs<FlatView>(id)->picture().isNull(), longest);
  QVERIFY2(!w.child<QAction>("undo")->isEnabled(), "opening is no step");
}

void TestFusedOpening::bothThatAreNamedOpenFused_data() {
  QTest::addColumn<QStringList>("paths");
  QTest::addColumn<OpenBoth>("open");
  const QStringList ctAndPet{fusedFolder("ct"), fusedFolder("pet")}, petAndCt{ctAndPet[1], ctAndPet[0]};
  QTest::newRow("the CT first") << ctAndPet << OpenBoth(openAtOnce);
  QTest::newRow("the PET first") << petAndCt << OpenBoth(openAtOnce);
  QTest::newRow("dropped, the CT first") << ctAndPet << OpenBoth(dropBoth);
  QTest::newRow("dropped, the PET first") << petAndCt << OpenBoth(dropBoth);
  QTest::newRow("the PET is read late") << ctAndPet << OpenBoth(openSlowly);
  QTest::newRow("the CT is read late") << petAndCt << OpenBoth(openSlowly);
}

void TestFusedOpening::bothThatAreNamedOpenFused() {
  QFETCH(QStringList, paths);
  QFETCH(OpenBoth, open);
  NEED_DATA(tests::dataPath("pet-ct"));
  const UsualLayouts usual;
  PetCtWindow w;
  open(w, paths);
  QTRY_VERIFY_WITH_TIMEOUT(w.isFused(), longest);
  for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId})
    QTRY_VERIFY_WITH_TIMEOUT(!w.window.views()->viewAs<FlatView>(id)->picture().isNull(), longest);
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series() != nullptr, longest);
}

void TestFusedOpening::thoseOfTwoPatientsDoNot() {
  const std::string chest = tests::dataPath("ct-chest-lidc0314-138");
  NEED_DATA(chest);
  const UsualLayouts usual;
  PetCtWindow w(QStringList{QString::fromStdString(chest), fusedFolder("pet")});
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series() && w.window.document().open.volumes().size() == 2,
                           longest);
  QTRY_VERIFY_WITH_TIMEOUT(!w.window.document().loader.isBusy(), longest);
  QCOMPARE(w.modality(w.workspace().view(sceneViewId).series), std::string("CT"));
  QVERIFY(w.look(axialViewId).overlay.empty());
}

void TestFusedOpening::besideItThePetStandsAlone_data() {
  QTest::addColumn<int>("focus");
  QTest::newRow("a plane in focus") << int(axialViewId);
  QTest::newRow("3D in focus") << int(sceneViewId);
}

void TestFusedOpening::besideItThePetStandsAlone() {
  QFETCH(int, focus);
  const std::string data = tests::dataPath("pet-ct");
  NEED_DATA(data);
  const UsualLayouts usual;
  const auto showsBoth = [](PetCtWindow& w) {
    return w.workspace().layout == Layout::two &&
           w.modality(w.workspace().view(firstComparedId).series) == "CT" &&
           w.modality(w.look(firstComparedId).overlay) == "PT" &&
           w.modality(w.workspace().view(firstComparedId + 1).series) == "PT";
  };
  {
    PetCtWindow w(QStringList{QString::fromStdString(data)});
    QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series() && w.isFused(), longest);
    w.window.session().setFocus(focus);
    QTest::keyClick(w.window.focusWidget(), Qt::Key_4, Qt::AltModifier);
    QVERIFY(showsBoth(w));
    for (const ViewId id : {firstComparedId, firstComparedId + 1})
      QTRY_VERIFY_WITH_TIMEOUT(!w.window.views()->viewAs<FlatView>(id)->picture().isNull(), longest);
    w.shot("fused-two");
    w.window.close();
  }
  // This layout is used from then on.
  PetCtWindow again(QStringList{QString::fromStdString(data)});
  QTRY_VERIFY_WITH_TIMEOUT(showsBoth(again), longest);
}

void TestFusedOpening::aGridOfOneSeriesIsNoLayoutToComeBackTo() {
  const std::string chest = tests::dataPath("ct-chest-lidc0314-138");
  NEED_DATA(chest);
  const UsualLayouts usual;
  QSettings().setValue(QStringLiteral("layouts/CT"), QStringLiteral("two"));
  PetCtWindow w(QStringList{QString::fromStdString(chest)});
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series() != nullptr, longest);
  QCOMPARE(w.workspace().layout, Layout::planes);
}

void TestFusedOpening::itsControlsAreSeenWithoutScrolling_data() {
  QTest::addColumn<QSize>("size");
  QTest::newRow("a laptop") << QSize(1366, 768);
  QTest::newRow("a usual window") << QSize(1440, 900);
}

void TestFusedOpening::itsControlsAreSeenWithoutScrolling() {
  QFETCH(QSize, size);
  const std::string data = tests::dataPath("pet-ct");
  NEED_DATA(data);
  const UsualLayouts usual;
  PetCtWindow w;
  w.window.resize(size);
  w.window.open({QString::fromStdString(data)});
  QTRY_VERIFY_WITH_TIMEOUT(w.isFused(), longest);
  w.window.session().setFocus(axialViewId);
  for (const char* control : {"overlayButton", "overlayColours", "overlayOpacityRow"}) {
    auto* widget = w.child<QWidget>(control);
    QVERIFY2(widget, control);
    QTRY_VERIFY2(widget->isVisible() && widget->visibleRegion().boundingRect() == widget->rect(), control);
  }
}

VOLUMEN_TEST(TestFusedOpening);
#include "tst_fused_opening.moc"
