// Guards import.md: the volumes of one file are named by what varies between them.
#include <QFile>
#include <QTemporaryDir>
#include <algorithm>
#include <cstring>
#include <map>

#include "io/files/image_file.h"
#include "io/study/series.h"
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
  void weightsStandBesideNifti_data();
  void weightsStandBesideNifti();
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

/// Returns a NIfTI file of three volumes of 2 x 2 x 2 bytes.
QByteArray threeNiftiVolumes() {
  QByteArray bytes(352 + 24, '\0');
  const auto put = [&](int at, auto value) { std::memcpy(bytes.data() + at, &value, sizeof value); };
  put(0, std::int32_t(348));
  for (const auto& [axis, size] : {std::pair(0, 4), {1, 2}, {2, 2}, {3, 2}, {4, 3}})
    put(40 + 2 * axis, std::int16_t(size));
  put(70, std::int16_t(2));  // unsigned bytes
  put(72, std::int16_t(8));
  for (int axis = 0; axis < 5; ++axis) put(76 + 4 * axis, 1.0f);
  put(108, 352.0f);
  std::memcpy(bytes.data() + 344, "n+1", 3);
  return bytes;
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

void TestVolumeNames::weightsStandBesideNifti_data() {
  QTest::addColumn<QString>("beside");
  QTest::addColumn<QByteArray>("weights");
  QTest::addColumn<QStringList>("names");
  QTest::addColumn<bool>("warned");
  const auto row = [](const char* name, const char* beside, const char* weights, const QStringList& names,
                      bool warned = false) {
    QTest::newRow(name) << QString::fromLatin1(beside) << QByteArray(weights) << names << warned;
  };
  const QStringList times{QStringLiteral("1||"), QStringLiteral("2||"), QStringLiteral("3||")};
  const QStringList directions{QStringLiteral("|0|direction 1"), QStringLiteral("|1000|direction 2"),
                               QStringLiteral("|995.5|direction 3")};
  row("one line", "a.bval", "0 1000 995.5\n", directions);
  row("a line each", "a.bval", "0\r\n1000\r\n995.5", directions);
  row("of another file", "b.bval", "0 1000 995.5", times);
  row("one too few", "a.bval", "0 1000", times, true);
  row("one too many", "a.bval", "0 1000 1000 1000", times, true);
  row("no numbers", "a.bval", "0 1000 x", times, true);
  row("negative", "a.bval", "0 1000 -1", times, true);
  row("not finite", "a.bval", "0 1000 inf", times, true);
  row("empty", "a.bval", "", times, true);
}

void TestVolumeNames::weightsStandBesideNifti() {
  QFETCH(QString, beside);
  QFETCH(QByteArray, weights);
  QFETCH(QStringList, names);
  QFETCH(bool, warned);
  const QTemporaryDir folder;
  QFile file(folder.filePath(beside));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(weights);
  file.close();
  QStringList found;
  bool told = false;
  for (const Series& s : volumesOf(folder.filePath(QStringLiteral("a.nii")), threeNiftiVolumes())) {
    found << QString::fromStdString(s.timePoint + "|" + s.bValue + "|" + s.label);
    told = told || std::ranges::any_of(s.warnings, [](const Warning& w) {
             return w.sentence.starts_with("a.bval is not used");
           });
  }
  QCOMPARE(found, names);
  QCOMPARE(told, warned);
}

// A row or more beyond the header's size is reported, with the number of bytes.
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
