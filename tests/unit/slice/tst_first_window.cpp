// Guards slices.md 2 and 3: the initial window of a view, and its DICOM function.
#include <cmath>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/slice/first_window.h"

using namespace volumen;
using namespace volumen::tests;

class TestFirstWindow : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theFilesFirstElseNearlyAllValues_data();
  void theFilesFirstElseNearlyAllValues();
  void aBackgroundOfZeroDoesNotCount_data();
  void aBackgroundOfZeroDoesNotCount();
  void linearForIntegersOfDicom_data();
  void linearForIntegersOfDicom();
};

namespace {

// Returns 8000 values: 2000 of -2000, then 0 to 5999.
template <class T>
VolumePtr volumeOf8000(VolumeAttributes attributes, double slope = 1) {
  VolumeParts parts;
  parts.geometry.size = {20, 20, 20};
  std::vector<T> values(2000, T(-2000));
  for (int n = 0; n < 6000; ++n) values.push_back(T(n));
  parts.values = std::move(values), parts.slope = slope, parts.attributes = std::move(attributes);
  return volumeFrom(std::move(parts));
}

}  // namespace

void TestFirstWindow::theFilesFirstElseNearlyAllValues_data() {
  QTest::addColumn<std::vector<Window>>("windows");
  QTest::addColumn<bool>("padded");
  QTest::addColumn<QString>("unit");
  QTest::addColumn<double>("centre");
  QTest::addColumn<double>("width");
  QTest::newRow("the first of two") << std::vector<Window>{{40, 400}, {300, 1500}} << true << QString() << 40.
                                    << 400.;
  QTest::newRow("the first that is one")
      << std::vector<Window>{{40, 0}, {300, 1500}} << false << QStringLiteral("HU") << 300. << 1500.;
  // Ranks 8 and 7992 of 8000 are -2000 and 5991.
  QTest::newRow("none: nearly all") << std::vector<Window>{} << false << QString() << 1995.5 << 7991.;
  // Padding leaves 6000 values, with ranks 6 and 5994.
  QTest::newRow("none: nearly all but padding")
      << std::vector<Window>{} << true << QStringLiteral("SUV") << 2999. << 5988.;
  QTest::newRow("none, of HU: soft tissue")
      << std::vector<Window>{} << false << QStringLiteral("HU") << 40. << 400.;
}

void TestFirstWindow::theFilesFirstElseNearlyAllValues() {
  QFETCH(std::vector<Window>, windows);
  QFETCH(bool, padded);
  VolumeAttributes attributes;
  attributes.windows = windows;
  QFETCH(QString, unit);
  if (padded) attributes.padding = {-2000, -2000};
  const Window window = firstWindow(*volumeOf8000<std::int16_t>(attributes), unit.toStdString());
  QTEST(window.centre, "centre");
  QTEST(window.width, "width");
}

void TestFirstWindow::aBackgroundOfZeroDoesNotCount_data() {
  QTest::addColumn<int>("zeros");
  QTest::addColumn<QString>("unit");
  QTest::addColumn<double>("brightest");
  // Tissue is 100 to 199, and 39 voxels are 30000.
  QTest::newRow("half of it") << 4000 << QString() << 198.;
  QTest::newRow("a few") << 400 << QString() << 30000.;
  QTest::newRow("activity") << 4000 << QStringLiteral("Bq/ml") << 30000.;
}

void TestFirstWindow::aBackgroundOfZeroDoesNotCount() {
  QFETCH(int, zeros);
  QFETCH(QString, unit);
  VolumeParts parts;
  parts.geometry.size = {20, 20, 20};
  std::vector<std::int16_t> values(std::size_t(zeros), 0);
  values.resize(std::size_t(zeros) + 39, 30000);
  while (values.size() < 8000) values.push_back(std::int16_t(100 + values.size() % 100));
  parts.values = std::move(values);
  const Window window = firstWindow(*volumeFrom(std::move(parts)), unit.toStdString());
  QFETCH(double, brightest);
  const double bright = window.centre + window.width / 2;
  QVERIFY2(std::abs(bright - brightest) <= 2, qPrintable(QString::number(bright)));
}

void TestFirstWindow::linearForIntegersOfDicom_data() {
  QTest::addColumn<bool>("dicom");
  QTest::addColumn<bool>("integers");
  QTest::addColumn<double>("width");
  QTest::addColumn<bool>("linear");
  QTest::newRow("integers of DICOM") << true << true << 400. << true;
  QTest::newRow("narrowest") << true << true << 1. << true;
  QTest::newRow("too narrow") << true << true << 0.9 << false;
  QTest::newRow("floats") << true << false << 400. << false;
  QTest::newRow("another format") << false << true << 400. << false;
}

void TestFirstWindow::linearForIntegersOfDicom() {
  QFETCH(bool, dicom);
  QFETCH(bool, integers);
  QFETCH(double, width);
  const VolumePtr volume = integers ? volumeOf8000<std::int16_t>({}) : volumeOf8000<float>({});
  const GreyMapping grey = windowGrey(*volume, dicom, {40, width});
  QVERIFY((grey.window == Window{40, width}) && grey.table.grey.empty() && !grey.inverted);
  QTEST(grey.function == WindowFunction::linear, "linear");
}

VOLUMEN_TEST(TestFirstWindow);
#include "tst_first_window.moc"
