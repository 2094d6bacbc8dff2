// Guards what the list of windows of a series offers: those of its file first, each once.
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "ui/workspace/windows.h"

using namespace volumen;
using namespace volumen::tests;

class TestWindowChoices : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void windowsOfTheFileComeOnce_data();
  void windowsOfTheFileComeOnce();
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

VOLUMEN_TEST(TestWindowChoices);
#include "tst_window_choices.moc"
