// Guards the DICOM attributes of a picture. They follow the picture in focus until another is chosen, and
// rows are copied with tabs.
#include <QCheckBox>
#include <QClipboard>
#include <QPushButton>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTreeWidget>

#include "io/export/dicom_series.h"
#include "tests/ui/derived_2d.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/key_images.h"
#include "ui/workspace/picture_in_focus.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A head in planes with the axial view in focus, and the attributes dialog.
struct Attributes : References2d {
  explicit Attributes(const QString& folder) : References2d({}) { window.open({folder}); }

  bool open() {
    if (!settle()) return false;
    child<QAction>("layoutPlanes")->trigger();
    session().setFocus(axialViewId);
    if (!shows([](const FlatView& v) { return v.series() != nullptr; })) return false;
    child<QAction>("attributes")->trigger();
    return dialog() != nullptr;
  }
  QDialog* dialog() { return child<QDialog>("attributesDialog"); }
  QTreeWidget* rows() { return child<QTreeWidget>("attributesTree"); }
  QTreeWidgetItem* row(const char* name) {
    return rows()->findItems(QLatin1String(name), Qt::MatchExactly | Qt::MatchRecursive, 1).value(0);
  }
  QString value(const char* name) { return row(name) ? row(name)->text(3) : QString(); }
  // Returns the UID of the slice on screen.
  QString uidSeen() {
    const std::optional<int> picture = view()->stack().seen.index;
    const Series& series = *workspace().series.at(view()->state().series).series;
    return picture ? QString::fromStdString(series.sopInstanceUids.at(std::size_t(*picture))) : QString();
  }
};

QStringList copiedRows() { return QApplication::clipboard()->text().split(QLatin1Char('\n')); }

}  // namespace

class TestAttributes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void theyFollowTheView();
  void whereTheCrosshairIsCounts();
  void namesAreHiddenAtOnce();
  void rowsAreCopied();
  void onlyDicomHasThem();

 private:
  QTemporaryDir dir_;
  QString head_;
};

void TestAttributes::initTestCase() {
  head_ = dir_.filePath(QStringLiteral("head"));
  QVERIFY(writeDicomSeries(**makePhantom("ct-head:24"), {}, head_.toStdString()));
}

void TestAttributes::theyFollowTheView() {
  Attributes w(head_);
  QVERIFY(w.open());
  auto* follow = w.child<QCheckBox>("attributesFollow");
  auto* slice = w.child<QSpinBox>("attributesSlice");
  QVERIFY(follow->isChecked());
  QVERIFY(!w.uidSeen().isEmpty());
  QTRY_COMPARE_WITH_TIMEOUT(w.value("SOPInstanceUID"), w.uidSeen(), longest);
  const QString first = w.uidSeen();
  w.view()->scroll(3);
  QVERIFY(w.uidSeen() != first);
  QTRY_COMPARE_WITH_TIMEOUT(w.value("SOPInstanceUID"), w.uidSeen(), longest);
  QVERIFY(follow->isChecked());
  // A picture chosen by hand stays.
  const QString seen = w.uidSeen();
  slice->setFocus();
  QTest::keyClick(slice, slice->value() == slice->maximum() ? Qt::Key_Down : Qt::Key_Up);
  QVERIFY(!follow->isChecked());
  QTRY_VERIFY_WITH_TIMEOUT(!w.value("SOPInstanceUID").isEmpty() && w.value("SOPInstanceUID") != seen,
                           longest);
  const int chosen = slice->value();
  w.view()->scroll(2);
  QCOMPARE(slice->value(), chosen);
  follow->click();
  QTRY_COMPARE_WITH_TIMEOUT(w.value("SOPInstanceUID"), w.uidSeen(), longest);
}

// A plane across the slices shows attributes of the slice at its crosshair.
void TestAttributes::whereTheCrosshairIsCounts() {
  Attributes w(head_);
  QVERIFY(w.open());
  for (const int steps : {0, 4, -7}) {
    w.view()->scroll(steps);
    const std::optional<int> picture = w.view()->stack().seen.index;
    QVERIFY(picture);
    for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId, sceneViewId})
      QCOMPARE(pictureOf(w.workspace(), id), picture);
  }
}

void TestAttributes::namesAreHiddenAtOnce() {
  Attributes w(head_);
  QVERIFY(w.open());
  QTRY_COMPARE_WITH_TIMEOUT(w.value("SOPInstanceUID"), w.uidSeen(), longest);
  const auto hide = [&](bool on) {
    w.session().prefer([on](Preferences& preferences) { preferences.hideNames = on; });
  };
  hide(true);
  QVERIFY2(w.value("SOPInstanceUID") != w.uidSeen(), "not until it is read again");
  QTRY_COMPARE_WITH_TIMEOUT(w.value("SOPInstanceUID"), QStringLiteral("(hidden)"), longest);
  QCOMPARE(w.value("Modality"), QStringLiteral("CT"));
  hide(false);
  QTRY_COMPARE_WITH_TIMEOUT(w.value("SOPInstanceUID"), w.uidSeen(), longest);
}

void TestAttributes::rowsAreCopied() {
  Attributes w(head_);
  QVERIFY(w.open());
  QTRY_VERIFY_WITH_TIMEOUT(w.row("Modality"), longest);
  QApplication::setActiveWindow(w.dialog());
  w.rows()->setFocus();
  QTRY_VERIFY(w.rows()->hasFocus());
  w.rows()->clearSelection();
  w.row("Rows")->setSelected(true);
  w.row("Modality")->setSelected(true);
  QApplication::clipboard()->clear();
  QTest::keyClick(w.rows(), Qt::Key_C, Qt::ControlModifier);
  const QString modality = QStringLiteral("(0008,0060)\tModality\tCS\tCT");
  QCOMPARE(copiedRows().size(), 2);
  QCOMPARE(copiedRows().front(), modality);  // in the order of the file
  QCOMPARE(copiedRows().back().section(QLatin1Char('\t'), 0, 2), QStringLiteral("(0028,0010)\tRows\tUS"));
  // Copies all visible rows.
  w.child<QLineEdit>("attributesSearch")->setText(QStringLiteral("modality"));
  auto* all = w.child<QPushButton>("attributesCopyAll");
  QTest::mouseClick(all, Qt::LeftButton);
  QVERIFY(copiedRows().contains(modality));
  for (const QString& row : copiedRows())
    QVERIFY(row.contains(QStringLiteral("modality"), Qt::CaseInsensitive));
  w.child<QLineEdit>("attributesSearch")->clear();
  QTest::mouseClick(all, Qt::LeftButton);
  int count = 0;
  for (QTreeWidgetItemIterator it(w.rows()); *it; ++it) ++count;
  QCOMPARE(copiedRows().size(), count);
}

void TestAttributes::onlyDicomHasThem() {
  Journey w;
  auto* banner = w.child<Banner>("banner");
  w.child<QAction>("attributes")->trigger();
  QCOMPARE(banner->sentence(), QStringLiteral("Open a series first."));
  w.window.open({QStringLiteral("phantom:sphere:16")});
  QVERIFY(w.settle());
  w.child<QAction>("attributes")->trigger();
  QCOMPARE(banner->sentence(), QStringLiteral("Only pictures of DICOM files have attributes."));
}

VOLUMEN_TEST(TestAttributes);
#include "tst_attributes.moc"
