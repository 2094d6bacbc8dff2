// Guards the windows offered for a series: those of its file first, each once.
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "ui/workspace/windows.h"

using namespace volumen;
using namespace volumen::tests;

Q_DECLARE_METATYPE(volumen::WindowCounts)

class TestWindowChoices : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void windowsOfTheFileComeOnce_data();
  void windowsOfTheFileComeOnce();
  void noDigitDependsOnTheFile_data();
  void noDigitDependsOnTheFile();
};

void TestWindowChoices::windowsOfTheFileComeOnce_data() {
  QTest::addColumn<std::vector<Window>>("windows");
  QTest::addColumn<QStringList>("names");  // up to those of tissues
  const auto row = [&](const char* name, const std::vector<Window>& windows, QStringList names) {
    names.prepend(QStringLiteral("Automatic"));
    QTest::newRow(name) << windows << names;
  };
  const Window soft{40, 400}, lung{-450, 2000};
  row("none", {}, {});
  row("one", {soft}, {QStringLiteral("From file (400 / 40)")});
  row("two", {soft, lung},
      {QStringLiteral("From file, 1 (400 / 40)"), QStringLiteral("From file, 2 (2000 / -450)")});
  row("one twice", {lung, lung}, {QStringLiteral("From file (2000 / -450)")});
  row("the first again", {soft, lung, soft},
      {QStringLiteral("From file, 1 (400 / 40)"), QStringLiteral("From file, 2 (2000 / -450)")});
}

void TestWindowChoices::windowsOfTheFileComeOnce() {
  QFETCH(std::vector<Window>, windows);
  QFETCH(QStringList, names);
  const VolumePtr made = volumeOf<std::int16_t>({2, 2, 2}, glm::dmat3(1), [](glm::dvec3) { return 0; });
  VolumeParts parts{made->geometry(), made->stored(), 1, 0, {}};
  parts.attributes.windows = windows;
  LoadedSeries series;
  series.series.unit = "HU";
  series.volume = volumeFrom(std::move(parts));
  QStringList offered;
  for (const NamedWindow& choice : windowChoices(series)) offered << choice.name;
  QVERIFY(offered.size() > names.size());
  QCOMPARE(offered.mid(0, names.size()), names);
  QCOMPARE(offered[names.size()], QStringLiteral("Brain (80 / 40)"));
}

void TestWindowChoices::noDigitDependsOnTheFile_data() {
  QTest::addColumn<WindowCounts>("counts");
  QTest::addColumn<QString>("keys");
  const auto row = [](const char* name, WindowCounts counts, const char* keys) {
    QTest::newRow(name) << counts << QString::fromLatin1(keys);
  };
  row("a CT without", {0, 9, 0}, "0 1 2 3 4 5 6 7 8 9");
  row("a CT whose file has one", {1, 9, 0}, "0 Ctrl+1 1 2 3 4 5 6 7 8 9");
  row("one that has two", {2, 9, 0}, "0 Ctrl+1 Ctrl+2 1 2 3 4 5 6 7 8 9");
  row("with one of the user's", {1, 9, 1}, "0 Ctrl+1 1 2 3 4 5 6 7 8 - 9");
  row("a PET", {1, 4, 0}, "0 Ctrl+1 1 2 3 4");
  row("an MR, with one of the user's", {1, 0, 1}, "0 Ctrl+1 1");
  row("a radiograph", {2, 0, 0}, "0 1 2");
  row("more than there are digits", {10, 0, 0}, "0 1 2 3 4 5 6 7 8 9 -");
}

void TestWindowChoices::noDigitDependsOnTheFile() {
  QFETCH(WindowCounts, counts);
  QFETCH(QString, keys);
  QStringList found;
  const std::vector<WindowKey> all = windowKeys(counts);
  for (const WindowKey& key : all) found << (key.text().isEmpty() ? QStringLiteral("-") : key.text());
  QCOMPARE(found.join(QLatin1Char(' ')), keys);
  for (int n = 1; n <= std::min(counts.ofFile, 9); ++n) QCOMPARE(all[std::size_t(n)].withCtrl, n);
}

VOLUMEN_TEST(TestWindowChoices);
#include "tst_window_choices.moc"
