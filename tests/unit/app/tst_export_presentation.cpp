// Guards export.md: `volumen export --as gsps` writes a presentation state. `volumen slice` and DCMTK show
// the same greys with it as with the window itself. They draw shapes on the pixels on which they were
// measured.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QFile>
#include <QImage>
#include <QProcess>
#include <QTemporaryDir>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <set>

#include "io/frames.h"
#include "io/open.h"
#include "io/study/frame_series.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/app/export_case.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"
#include "viewer/measure/shape_json.h"

using namespace volumen;
using namespace volumen::tests;

class TestExportPresentation : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }
  void theSameIsShown_data();
  void theSameIsShown();
  void anotherProgramShowsTheSame();
  void onlyTheChosenImagesAreNamed();
  void shapesAreDrawnOnTheirPixels_data();
  void shapesAreDrawnOnTheirPixels();
  void shapesOnFramesAreDrawnThere();
  void whatCannotBeDrawnIsLeftOut();
  void picturesThatAreNotAlikeAreRefused();
  void wrongInputIsRefused_data();
  void wrongInputIsRefused();
  void anExistingFileStays();

 private:
  QString at(const char* name) const { return folder_->filePath(QString::fromLatin1(name)); }
  // Runs `export PATH --as gsps OPTIONS -o pr.dcm`.
  Outcome exported(const std::string& path, const QStringList& options) const {
    return runProgram(QStringList{QStringLiteral("export"), QString::fromStdString(path),
                                  QStringLiteral("--as"), QStringLiteral("gsps"), QStringLiteral("-o"),
                                  at("pr.dcm")} +
                      options);
  }
  QStringList roi(const std::vector<Shape>& shapes) const {
    QFile file(at("shapes.json"));
    if (file.open(QIODevice::WriteOnly)) file.write(QByteArray::fromStdString(shapesToJson(shapes)));
    return {QStringLiteral("--roi"), file.fileName()};
  }
  // Returns the bytes of the picture of `slice PATH --plane frame --index N OPTIONS`, or its error message.
  QByteArray pictureOf(const std::string& path, int index, const QStringList& options) const {
    const QString file = at("picture.png");
    const Outcome done =
        runProgram(QStringList{QStringLiteral("slice"), QString::fromStdString(path),
                               QStringLiteral("--plane"), QStringLiteral("frame"), QStringLiteral("--index"),
                               QString::number(index), QStringLiteral("-o"), file} +
                   options);
    return done.status == 0 ? contentsOf(file) : done.err;
  }
  QByteArray shownBy(const std::string& path, int index, const QStringList& more) const {
    return pictureOf(path, index, QStringList{QStringLiteral("--presentation"), at("pr.dcm")} + more);
  }
  std::unique_ptr<QTemporaryDir> folder_;
};

namespace {

const QString windowOption = QStringLiteral("--window"), imagesOption = QStringLiteral("--images");

// Returns the first volume at a path, or without volumes the first pictures as a series.
std::optional<Series> picturesOf(const std::string& path) {
  const Result<Study> study = openStudy(path);
  if (!study) return {};
  if (!study->volumes.empty()) return study->volumes.front();
  return frameSeries(*study).at(0);
}

// Returns the largest grey difference of two pictures; 256 if their sizes differ.
int mostApart(const QImage& a, const QImage& b) {
  if (a.size() != b.size() || a.isNull()) return 256;
  int most = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      most = std::max(most, std::abs(qGray(a.pixel(x, y)) - qGray(b.pixel(x, y))));
  return most;
}

bool isGreyPng(const QByteArray& bytes) {
  const QImage image = QImage::fromData(bytes);
  std::set<int> greys;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) greys.insert(qGray(image.pixel(x, y)));
  return greys.size() > 8;
}

double farthest(const std::vector<glm::dvec2>& found, const std::vector<glm::dvec2>& wanted) {
  if (found.size() != wanted.size()) return 1e9;
  double most = 0;
  for (std::size_t n = 0; n < found.size(); ++n) most = std::max(most, glm::distance(found[n], wanted[n]));
  return most;
}

}  // namespace

void TestExportPresentation::theSameIsShown_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("window");  // empty: only a probe is written, and the pictures keep their windows
  QTest::addColumn<int>("index");
  QTest::addColumn<bool>("isRounded");  // true if the window in stored values is rounded to 16 characters
  const auto row = [](const char* name, const char* path, const char* window, int index,
                      bool isRounded = false) {
    QTest::newRow(name) << QString::fromLatin1(path) << QString::fromLatin1(window) << index << isRounded;
  };
  row("CT in HU", "ct-chest-lidc0314-138", "40,400", 70);
  row("MR, oblique", "mr-head-ge-mprage-130", "300,700", 60);
  row("MR, its own windows", "mr-head-ge-mprage-130", "", 60);
  row("PET, a rescale a slice", "pet-ct/sts019-pet", "2,5", 30, true);
  row("CT, tilted", "dicom-geometry/ct-ge-tilt-varspacing-28", "40,400", 5);
  row("CT, its own two windows", "dicom-2d/ct-two-windows.dcm", "", 0);
  row("a chest, white on black", "dicom-2d/cr-chest-mono1-jpeg8.dcm", "128,200", 0);
  row("a hip, its own window", "dicom-2d/cr-hip-mono2-jpeg12.dcm", "", 0);
  row("teeth with a modality LUT", "dicom-2d/cr-dental-mono1-modalitylut.dcm", "400,700", 0);
  row("a breast, its own VOI LUTs", "dicom-2d/mg-sigmoid-voilut3.dcm", "", 0);
  row("a clip", "dicom-2d/xa-96frames.dcm", "100,150", 50);
}

void TestExportPresentation::theSameIsShown() {
  NEED_DATA(dataPath());
  QFETCH(QString, path);
  QFETCH(QString, window);
  QFETCH(int, index);
  QFETCH(bool, isRounded);
  const std::string data = dataPath(path.toStdString());
  const auto series = picturesOf(data);
  QVERIFY(series.has_value());
  const auto n = std::size_t(index);
  const ShapeFrame frame{series->sopInstanceUids.at(n), series->frames.at(n)};
  const QStringList through = window.isEmpty() ? QStringList() : QStringList{windowOption, window};
  const Shape probe{ShapeKind::probe, "", {{9, 9, 0}}, {}, {}, frame};
  const Outcome done = exported(data, window.isEmpty() ? roi({probe}) : through);
  QVERIFY2(done.status == 0, done.err);
  const QByteArray wanted = pictureOf(data, index, through);
  QVERIFY2(isGreyPng(wanted), wanted.left(500));
  const QByteArray shown = shownBy(data, index, {QStringLiteral("--no-graphics")});
  if (isRounded)
    QVERIFY(mostApart(QImage::fromData(shown), QImage::fromData(wanted)) <= 1);
  else
    QVERIFY(shown == wanted);
  const Result<Presentation> p = loadPresentation(at("pr.dcm").toStdString());
  QVERIFY2(p && p->warnings.empty(), p ? "" : p.message().c_str());
  if (window.isEmpty()) QCOMPARE(p->greys.at(0).greys.size(), loadFrame(*series, 0)->greys.size());
  NEED_DCIODVFY();
  QStringList errors = newErrors(at("pr.dcm"), series->files[0]);
  errors.removeIf([](const QString& error) { return error.contains(QLatin1String("(0x0008,0x1155)")); });
  QCOMPARE(errors, QStringList());
}

void TestExportPresentation::anotherProgramShowsTheSame() {
  NEED_DATA(dataPath());
  if (QStandardPaths::findExecutable(QStringLiteral("dcmp2pgm")).isEmpty())
    QSKIP("dcmp2pgm (package dcmtk) is not installed");
  const std::string data = dataPath("dicom-pydicom/test_files/CT_small.dcm");
  QCOMPARE(exported(data, {windowOption, QStringLiteral("40,400")}).status, 0);
  QProcess::execute(QStringLiteral("dcmp2pgm"),
                    {QStringLiteral("-p"), at("pr.dcm"), QString::fromStdString(data), at("other.pgm")});
  const QImage other(at("other.pgm"), "PGM");
  const QImage ours = QImage::fromData(pictureOf(data, 0, {windowOption, QStringLiteral("40,400")}));
  QVERIFY(mostApart(other, ours) <= 1);
}

void TestExportPresentation::onlyTheChosenImagesAreNamed() {
  NEED_DATA(dataPath());
  const std::string data = dataPath("dicom-2d/xa-96frames.dcm");
  const auto series = picturesOf(data);
  const QString uid = QString::fromStdString(series->sopInstanceUids[0]);
  const Outcome done = exported(data, {windowOption, QStringLiteral("100,150"), imagesOption,
                                       uid + QStringLiteral("/51,") + uid + QStringLiteral("/1")});
  QVERIFY2(done.status == 0, done.err);
  const Result<Presentation> p = loadPresentation(at("pr.dcm").toStdString());
  QVERIFY(p && p->pictures.size() == 1);
  QCOMPARE(p->pictures[0].frames, (std::vector{0, 50}));
  QVERIFY(isGreyPng(shownBy(data, 50, {})));
  QVERIFY(shownBy(data, 49, {}).contains("refers to other pictures"));
}

void TestExportPresentation::shapesAreDrawnOnTheirPixels_data() {
  QTest::addColumn<QString>("path");
  QTest::newRow("CT") << QStringLiteral("ct-chest-lidc0314-138");
  QTest::newRow("MR, oblique") << QStringLiteral("mr-head-ge-mprage-130");
  QTest::newRow("MR, a slice is missing") << QStringLiteral("mr-head-siemens-gap-175");
  QTest::newRow("MR, enhanced multi-frame") << QStringLiteral("dicom-geometry/mr-enh-philips-phmag");
}

void TestExportPresentation::shapesAreDrawnOnTheirPixels() {
  NEED_DATA(dataPath());
  QFETCH(QString, path);
  const std::string data = dataPath(path.toStdString());
  const auto series = picturesOf(data);
  QVERIFY(series && series->acquired.size.z > 2);
  const VoxelGeometry& grid = series->acquired;
  const int slice =
      series->regular ? 0 : grid.size.z / 2;  // in regular series, the first slice is drawn as acquired
  const double x = grid.size.x / 2, y = grid.size.y / 2;
  const auto p = [&](double a, double b) { return grid.patientFromVoxel({x + a, y + b, slice}); };
  const glm::dmat3& step = grid.patientFromVoxelStep;
  const ShapePlane plane{p(0, 0), glm::normalize(step[0]), glm::normalize(step[1])};
  const Outcome done =
      exported(data, QStringList{QStringLiteral("--series"), QString::fromStdString(series->id)} +
                         roi({{ShapeKind::length, "lesion", {p(-10, 0), p(10, 5)}, {}, {}, {}},
                              {ShapeKind::cobb, "", {p(-10, 0), p(10, 1), p(-10, 8), p(10, 9)}, {}, {}, {}},
                              {ShapeKind::ellipse, "", {p(-4, -2), p(4, 2)}, plane, {}, {}},
                              {ShapeKind::rectangle, "", {p(-4, -2), p(4, 2)}, plane, {}, {}},
                              {ShapeKind::freehand, "", {p(0, 0), p(9, 0), p(9, 7)}, plane, {}, {}},
                              {ShapeKind::probe, "", {p(3, 4)}, {}, {}, {}},
                              {ShapeKind::arrow, "look", {p(0, 0), p(12, 0)}, {}, {}, {}},
                              {ShapeKind::label, "here", {p(2, 2)}, {}, {}, {}}}));
  QVERIFY2(done.status == 0, done.err);
  const Result<Presentation> made = loadPresentation(at("pr.dcm").toStdString());
  QVERIFY2(made && made->warnings.empty(), made ? "" : made.message().c_str());
  QCOMPARE(made->layers.size(), std::size_t(1));
  QCOMPARE(made->layers[0].name, std::string("MEASUREMENTS"));
  const bool isMultiFrame = series->sopInstanceUids[0] == series->sopInstanceUids[1];
  const auto n = std::size_t(slice);
  const FramePresentation how =
      presentationOf(*made, series->sopInstanceUids[n], series->frames[n], {grid.size.x, grid.size.y});
  for (const Presentation::Annotations& part : made->annotations) {
    QCOMPARE(part.of.at(0).sopInstanceUid, series->sopInstanceUids[n]);
    QCOMPARE(part.of[0].frames, isMultiFrame ? std::vector{series->frames[n]} : std::vector<int>());
  }
  const auto at = [&](double a, double b) { return glm::dvec2(x + a + 0.5, y + b + 0.5); };
  const std::vector<std::vector<glm::dvec2>> wanted = {
      {at(-10, 0), at(10, 5)},
      {at(-10, 0), at(10, 1)},
      {at(-10, 8), at(10, 9)},
      {at(-4, 0), at(4, 0), at(0, -2), at(0, 2)},
      {at(-4, -2), at(4, -2), at(4, 2), at(-4, 2), at(-4, -2)},
      {at(0, 0), at(9, 0), at(9, 7), at(0, 0)},
      {at(3, 4)},
      {at(12, 0), at(0, 0), at(3.6, 1.44), at(0, 0), at(3.6, -1.44)}};
  QCOMPARE(how.graphics.size(), wanted.size());
  for (std::size_t g = 0; g < wanted.size(); ++g)
    QVERIFY2(farthest(how.graphics[g].points, wanted[g]) < 1e-3, qPrintable(QString::number(g)));
  QCOMPARE(how.graphics[3].type, GraphicType::ellipse);
  QCOMPARE(how.graphics[6].type, GraphicType::point);
  QCOMPARE(how.texts.size(), std::size_t(8));
  const double mm = glm::distance(p(-10, 0), p(10, 5));
  QCOMPARE(QString::fromStdString(how.texts[0].text),
           QStringLiteral("lesion\r\n%1 mm").arg(mm, 0, 'f', mm >= 10 ? 1 : 2));
  QVERIFY(QString::fromStdString(how.texts[1].text).endsWith(QChar(0xb0)));
  QVERIFY(how.texts[2].text.starts_with("Area "));
  QCOMPARE(how.texts[6].text, std::string("look"));
  QCOMPARE(how.texts[7].text, std::string("here"));
  QVERIFY(how.texts[7].anchor && glm::distance(how.texts[7].anchor->point, at(2, 2)) < 1e-3);
  NEED_DCIODVFY();
  QCOMPARE(newErrors(this->at("pr.dcm"), series->files[0]), QStringList());
}

void TestExportPresentation::shapesOnFramesAreDrawnThere() {
  NEED_DATA(dataPath());
  const std::string data = dataPath("dicom-2d/xa-96frames.dcm");
  const auto series = picturesOf(data);
  const ShapeFrame sixth{series->sopInstanceUids[0], 5};
  const Outcome done =
      exported(data, roi({{ShapeKind::length, "", {{40, 60, 0}, {70, 100, 0}}, {}, {}, sixth}}));
  QVERIFY2(done.status == 0, done.err);
  const Result<Presentation> p = loadPresentation(at("pr.dcm").toStdString());
  QVERIFY(p && p->annotations.size() == 1);
  QCOMPARE(p->annotations[0].of.at(0).frames, std::vector{5});
  QVERIFY(farthest(p->annotations[0].graphics.at(0).points, {{40.5, 60.5}, {70.5, 100.5}}) < 1e-6);
  QCOMPARE(p->annotations[0].texts.at(0).text, std::string("50 px"));
  const QStringList bare = {QStringLiteral("--no-graphics")};
  const QImage with = QImage::fromData(shownBy(data, 5, {})),
               without = QImage::fromData(shownBy(data, 5, bare));
  QVERIFY(with.pixelColor(55, 80) != without.pixelColor(55, 80));  // the middle of the line
  QVERIFY(with.pixelColor(5, 5) == without.pixelColor(5, 5));
  const QImage fifth = QImage::fromData(shownBy(data, 4, {})),
               plain = QImage::fromData(shownBy(data, 4, bare));
  QVERIFY(fifth.convertToFormat(QImage::Format_RGB32) == plain.convertToFormat(QImage::Format_RGB32));
}

void TestExportPresentation::whatCannotBeDrawnIsLeftOut() {
  NEED_DATA(dataPath());
  const std::string data = dataPath("mr-head-ge-mprage-130");
  const auto series = picturesOf(data);
  const auto p = [&](double x, double y, double z) { return series->acquired.patientFromVoxel({x, y, z}); };
  const Shape deep{ShapeKind::length, "deep", {p(90, 90, 3), p(99, 99, 40)}, {}, {}, {}};
  const Shape flat{ShapeKind::length, "flat", {p(90, 90, 3), p(99, 99, 3)}, {}, {}, {}};
  const Shape label{ShapeKind::label, "", {p(90, 90, 3)}, {}, {}, {}};
  const Outcome some = exported(data, roi({deep, label, flat}));
  QVERIFY2(some.status == 0, some.err);
  QVERIFY(
      some.err.contains("[0] (length \"deep\") does not lie within one slice as acquired and is left out."));
  QVERIFY(some.err.contains("[1] (label) has no text and is left out."));
  QCOMPARE(loadPresentation(at("pr.dcm").toStdString())->annotations.size(), std::size_t(1));
  QVERIFY(QFile::remove(at("pr.dcm")));
  const Outcome none = exported(data, roi({deep}));
  QVERIFY2(none.status == 1 && none.err.contains("No shape in it can be drawn"), none.err);
  const QStringList elsewhere = {imagesOption, QString::fromStdString(series->sopInstanceUids[7]),
                                 windowOption, QStringLiteral("300,700")};
  const Outcome window = exported(data, roi({flat}) + elsewhere);
  QVERIFY2(window.status == 0 && window.err.contains("is on none of the pictures and is left out."),
           window.err);
  QVERIFY(loadPresentation(at("pr.dcm").toStdString())->annotations.empty());
}

void TestExportPresentation::picturesThatAreNotAlikeAreRefused() {
  const DicomFolder scans;
  const auto add = [&](const char* name, int instance, int columns) {
    DicomPicture picture{.instance = instance, .columns = columns, .orientation = ""};
    picture.pixels.resize(std::size_t(2 * columns * picture.rows));
    picture.edit = [=](DcmDataset& data) {
      data.findAndDeleteElement(DCM_ImagePositionPatient);
      data.putAndInsertString(DCM_NumberOfFrames, "2");
      data.putAndInsertString(DCM_SOPInstanceUID, ("1.2.3.4.5." + std::to_string(instance)).c_str());
    };
    scans.add(name, picture);
  };
  add("a", 1, 4);
  add("b", 2, 5);
  const QStringList window = {windowOption, QStringLiteral("1,2")};
  const Outcome both = exported(scans.path(), window);
  QVERIFY2(both.status == 1 && both.err.contains("differs from the first picture"), both.err);
  QVERIFY(!QFile::exists(at("pr.dcm")));
  const Outcome one =
      exported(scans.path(), window + QStringList{imagesOption, QStringLiteral("1.2.3.4.5.2")});
  QVERIFY2(one.status == 0, one.err);
  QCOMPARE(loadPresentation(at("pr.dcm").toStdString())->areas.at(0).area, (PixelBox{{0, 0}, {4, 2}}));
}

void TestExportPresentation::wrongInputIsRefused_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("options");
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("says");
  const char* const chest = "dicom-2d/cr-chest-mono1-jpeg8.dcm";
  const auto row = [](const char* name, const char* path, const char* options, int status, const char* says) {
    QTest::newRow(name) << QString::fromLatin1(path) << QString::fromLatin1(options) << status
                        << QByteArray(says);
  };
  row("nothing to show", chest, "", 2, "--as gsps needs --window C,W or --roi FILE.");
  row("half a window", chest, "--window 40", 2, "--window");
  row("a window without width", chest, "--window 40,0", 2, "the width must be above 0");
  row("a title", chest, "--window 4,9 --title 113000", 2, "--title does not go with --as gsps.");
  row("no shapes there", chest, "--roi /nowhere/at/all", 1, "Cannot read the shapes");
  row("no such image", chest, "--window 4,9 --images 1.2.3", 1,
      "No image here has the SOPInstanceUID 1.2.3.");
  row("a frame that is no number", chest, "--window 4,9 --images 1.2.3/x", 2, "is not UID or UID/FRAME");
  row("no such series", chest, "--window 4,9 --series 7.7", 1, "--series 7.7 names no series");
  row("colour", clip, "--window 4,9", 1, "holds a picture in colour");
  row("NIfTI", "nifti-meta/niftireader/5D_zeros.nii.gz", "--window 4,9", 1, "holds no DICOM images");
  row("tiles of one image", "dicom-geometry/mr-mosaic-siemens", "--window 4,9", 1, "is a mosaic");
  row("a shape in a volume", "dicom-2d/xa-96frames.dcm", "--roi SHAPES", 1, "it lies in a volume");
}

void TestExportPresentation::wrongInputIsRefused() {
  NEED_DATA(dataPath());
  QFETCH(QString, path);
  QFETCH(QString, options);
  QFETCH(int, status);
  QFETCH(QByteArray, says);
  options.replace(QLatin1String("SHAPES"),
                  roi({{ShapeKind::length, "", {{0, 0, 0}, {9, 9, 0}}, {}, {}, {}}}).value(1));
  const QStringList words = options.split(QLatin1Char(' '), Qt::SkipEmptyParts);
  const Outcome done = exported(dataPath(path.toStdString()), words);
  QVERIFY2(done.status == status && done.err.contains(says), done.err);
  QVERIFY(!QFile::exists(at("pr.dcm")));
}

void TestExportPresentation::anExistingFileStays() {
  NEED_DATA(dataPath());
  QFile file(at("pr.dcm"));
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write("mine") == 4);
  file.close();
  const Outcome done =
      exported(dataPath("dicom-2d/ct-two-windows.dcm"), {windowOption, QStringLiteral("40,400")});
  QVERIFY2(done.status == 1 && done.err.contains("is there already"), done.err);
  QCOMPARE(contentsOf(at("pr.dcm")), QByteArray("mine"));
}

VOLUMEN_TEST(TestExportPresentation);
#include "tst_export_presentation.moc"
