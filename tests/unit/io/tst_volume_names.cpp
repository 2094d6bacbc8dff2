// Guards import.md: the volumes of one file are named by what varies between them.
#include <QFile>
#include <QTemporaryDir>
#include <algorithm>
#include <map>

#include "io/files/image_file.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestVolumeNames : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void namesSayWhatVaries_data();
  void namesSayWhatVaries();
  void realDiffusionHasItsShells();
  void surplusIsWarnedOf();
};

namespace {

std::vector<Series> volumesOf(const QString& path, const QByteArray& content) {
  QFile file(path);
  if (!file.open(QIODevice::WriteOnly)) qFatal("no temporary file");
  file.write(content);
  file.close();
  const auto found = readImageFileHeaders(path.toStdString());
  if (!found) qWarning("%s", found.message().c_str());
  return found ? *found : std::vector<Series>();
}

}  // namespace

void TestVolumeNames::namesSayWhatVaries_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::addColumn<QStringList>("names");  // timePoint|bValue|label
  const auto row = [](const char* title, const char* name, const QByteArray& content,
                      const QStringList& names) {
    QTest::newRow(title) << QString::fromLatin1(name) << content << names;
  };
  const QByteArray data(48, '\1');
  const auto nrrd = [&](const char* fields, const char* keys = "") {
    return QByteArray("NRRD0005\ntype: uchar\ndimension: 4\nencoding: raw\n") + fields + keys + "\n" + data;
  };
  const char* list = "sizes: 3 2 2 2\nkinds: list domain domain domain\n";
  row("nrrd: vectors", "a.nrrd", nrrd("sizes: 3 2 2 2\nkinds: vector domain domain domain\n"),
      {QStringLiteral("||component x"), QStringLiteral("||component y"), QStringLiteral("||component z")});
  row("nrrd: time", "a.nrrd", nrrd("sizes: 2 2 2 3\nkinds: domain domain domain time\n"),
      {QStringLiteral("1||"), QStringLiteral("2||"), QStringLiteral("3||")});
  row("nrrd: a list", "a.nrrd", nrrd(list),
      {QStringLiteral("||1 of 3"), QStringLiteral("||2 of 3"), QStringLiteral("||3 of 3")});
  row("nrrd: diffusion, the weight by the length of the gradient", "a.nrrd",
      nrrd(list,
           "modality:=DWMRI\nDWMRI_b-value:=1000\nDWMRI_gradient_0000:=0 0 0\nDWMRI_gradient_0001:=1 0 0\n"
           "DWMRI_gradient_0002:=0 0.5 0.5\n"),
      {QStringLiteral("|0|direction 1"), QStringLiteral("|1000|direction 2"),
       QStringLiteral("|500|direction 3")});
  row("nrrd: diffusion without a gradient", "a.nrrd",
      nrrd(list, "modality:=DWMRI\nDWMRI_b-value:=1000\nDWMRI_gradient_0000:=0 0 0\n"),
      {QStringLiteral("||direction 1"), QStringLiteral("||direction 2"), QStringLiteral("||direction 3")});
  const QByteArray meta = "NDims = 4\nDimSize = 2 2 2 3\nElementSpacing = 1 1 1 1\nElementType = MET_UCHAR\n";
  row("meta: time", "a.mha", meta + "ElementDataFile = LOCAL\n" + data,
      {QStringLiteral("1||"), QStringLiteral("2||"), QStringLiteral("3||")});
  row("meta: channels and time", "a.mha",
      QByteArray(meta).replace("2 2 2 3", "2 2 2 2") +
          "ElementNumberOfChannels = 2\nElementDataFile = LOCAL\n" + data,
      {QStringLiteral("1||component x"), QStringLiteral("1||component y"), QStringLiteral("2||component x"),
       QStringLiteral("2||component y")});
}

void TestVolumeNames::namesSayWhatVaries() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  QFETCH(QStringList, names);
  const QTemporaryDir folder;
  QStringList found;
  for (const Series& s : volumesOf(folder.filePath(name), content))
    found << QString::fromStdString(s.timePoint + "|" + s.bValue + "|" + s.label);
  QCOMPARE(found, names);
}

void TestVolumeNames::realDiffusionHasItsShells() {
  const std::string path = dataPath("nrrd-format-tests/slicer/multishell-DWI-451dir.nhdr");
  NEED_DATA(path);
  const auto found = readImageFileHeaders(path);
  QVERIFY(found.ok());
  QCOMPARE(found->size(), std::size_t(451));
  std::map<std::string, int> shells;
  for (const Series& s : *found) ++shells[s.bValue];
  QVERIFY(!shells.contains(""));
  QVERIFY(shells.size() > 2);
  QVERIFY(shells.contains("0"));
  QCOMPARE((*found)[450].label, std::string("direction 451"));
}

// A row or more behind what the header promises: told, with the number.
void TestVolumeNames::surplusIsWarnedOf() {
  const QTemporaryDir folder;
  const QByteArray header =
      "NRRD0005\ntype: uchar\ndimension: 3\nsizes: 4 2 2\nspacings: 1 1 1\nencoding: raw\n\n";
  const auto warned = [&](int bytes) {
    const auto found = volumesOf(folder.filePath(QStringLiteral("a.nrrd")), header + QByteArray(bytes, '\1'));
    return found.size() == 1 && std::ranges::any_of(found[0].warnings, [](const Warning& w) {
             return w.sentence == "a.nrrd holds 4 bytes more than its header promises; they are not shown.";
           });
  };
  QVERIFY(!warned(16));
  QVERIFY(!warned(17));
  QVERIFY(warned(20));
}

VOLUMEN_TEST(TestVolumeNames);
#include "tst_volume_names.moc"
