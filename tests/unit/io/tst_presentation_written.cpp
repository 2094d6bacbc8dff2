// Guards export/presentation_state.h: how frames are shown leaves as a presentation state and is read back
// equal, on pictures of any modality; what such an object cannot hold is told.
#include <QFile>

#include "io/export/presentation_state.h"
#include "io/frames.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/random_presentation.h"
#include "tests/unit/io/study_sources.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

Result<Frame> firstFrame(const Series& series) { return loadFrame(series, 0); }

}  // namespace

class TestPresentationWritten : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void randomOnesComeBackEqual();
  void realSourcesGiveValidObjects_data();
  void realSourcesGiveValidObjects();
  void oneOfAnotherProgramComesBackEqual();
  void framesOfOneFileAreNamed();
  void withoutPicturesAllAreShownWhole();
  void layersGetNamesOfTheirOwn();
  void whatItCannotHoldIsTold();
  void longShapesAreWrittenWhole();
  void longTextsAreCut();
  void namesStayAsTheyAre_data() { addNames(); }
  void namesStayAsTheyAre();
  void whatCannotBeWrittenIsRefused();
};

void TestPresentationWritten::randomOnesComeBackEqual() {
  const NamedSlices in;
  const auto frame = firstFrame(in.series);
  QVERIFY(frame.ok());
  const Seeds seeds = seedsOf(200, 3000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    Presentation p = randomPresentation(in.series, chance);
    const bool isChecked = seed % 20 == 0;
    if (isChecked) p.areas = {{{}, {{1, 2}, {5, 6}}}};  // dciodvfy knows no areas beyond a turned picture
    const auto notes = writePresentationState(p, in.series, *frame, {}, in.out());
    QVERIFY2(notes, notes ? "" : notes.message().c_str());
    QVERIFY2(notes->empty(), qPrintable(QString::number(seed)));
    const auto read = loadPresentation(in.out());
    QVERIFY2(read, read ? "" : read.message().c_str());
    QCOMPARE(QString::fromStdString(Told().of(*read)).split(QLatin1Char(10)),
             QString::fromStdString(Told().of(p)).split(QLatin1Char(10)));
    if (isChecked) COMPARE_WITH_STANDARD(in.out(), in.series.files[0]);
    QVERIFY(QFile::remove(QString::fromStdString(in.out())));
  }
}

void TestPresentationWritten::realSourcesGiveValidObjects_data() {
  addRealSources();
  QTest::newRow("XA") << QStringLiteral("dicom-2d/xa-96frames.dcm");
}

// All that an object can hold, for the first picture. Ultrasound in colour is refused.
void TestPresentationWritten::realSourcesGiveValidObjects() {
  QFETCH(QString, source);
  NEED_DATA(dataPath());
  const Series series = seriesAt(dataPath(source.toStdString()));
  QVERIFY(!series.files.empty());
  const auto frame = firstFrame(series);
  QVERIFY2(frame, frame ? "" : frame.message().c_str());
  Chance chance(7);
  Presentation p;
  p.label = "SHOWN";
  p.greys.push_back(randomGreys(chance));
  p.greys[0].greys.push_back(randomTable(chance));
  p.values = {1, -1024, 0, {}, "HU"};
  p.turn = {1, true};
  for (int n = 0; n < 9; ++n) addAnnotations(p, chance, {});
  for (auto& part : p.annotations)
    for (GraphicText& text : part.texts) text.text = "12.3 mm";  // in any character set
  p.shutter = randomShutter(chance);
  const QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("pr.dcm")).toStdString();
  const auto notes = writePresentationState(p, series, *frame, {}, path);
  QCOMPARE(notes.ok(), !frame->colour());
  if (!notes) return;
  COMPARE_WITH_STANDARD(path, series.files[0]);
  QCOMPARE(notAsInSource(path, series.files[0]).join(QLatin1Char(10)), QString());
  const auto read = loadPresentation(path);
  QVERIFY2(read, read ? "" : read.message().c_str());
  QVERIFY2(read->warnings.empty(), read->warnings.empty() ? "" : read->warnings[0].c_str());
  const FramePresentation how =
      presentationOf(*read, series.sopInstanceUids[0], series.frames[0], frame->size);
  QCOMPARE(*how.area, (PixelBox{{0, 0}, frame->size - 1}));
  QCOMPARE(how.turn, p.turn);
}

void TestPresentationWritten::oneOfAnotherProgramComesBackEqual() {
  NEED_DATA(dataPath());
  const Series series = seriesAt(dataPath("dicom-pydicom/test_files/CT_small.dcm"));
  const auto p = loadPresentation(dataPath("dicom-2d/made-here/pr-on-CT_small.dcm"));
  const auto frame = firstFrame(series);
  QVERIFY(p && frame);
  const QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("pr.dcm")).toStdString();
  const auto notes = writePresentationState(*p, series, *frame, {}, path);
  QVERIFY2(notes, notes ? "" : notes.message().c_str());
  const auto read = loadPresentation(path);
  QVERIFY(read.ok());
  QCOMPARE(QString::fromStdString(Told().of(*read)).split(QLatin1Char(10)),
           QString::fromStdString(Told().of(*p)).split(QLatin1Char(10)));
}

void TestPresentationWritten::framesOfOneFileAreNamed() {
  NEED_DATA(dataPath());
  const Series series = seriesAt(dataPath("dicom-2d/xa-96frames.dcm"));
  const auto frame = firstFrame(series);
  QVERIFY2(frame, frame ? "" : frame.message().c_str());
  Presentation p;
  p.pictures = {{series.sopInstanceUids[0], series.seriesUid, {0, 5}, {}}};
  p.greys.push_back(
      {{{series.sopInstanceUids[0], {}, {5}, {}}}, {{"", {{100, 50}, WindowFunction::linear, {}, false}}}});
  const QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("pr.dcm")).toStdString();
  const auto notes = writePresentationState(p, series, *frame, {}, path);
  QVERIFY2(notes, notes ? "" : notes.message().c_str());
  const auto read = loadPresentation(path);
  QVERIFY(read.ok());
  QCOMPARE(read->pictures[0].frames, std::vector<int>({0, 5}));
  QVERIFY(greysFor(*read, series.sopInstanceUids[0], 5) && !greysFor(*read, series.sopInstanceUids[0], 0));
  COMPARE_WITH_STANDARD(path, series.files[0]);
}

void TestPresentationWritten::withoutPicturesAllAreShownWhole() {
  const NamedSlices in;
  QVERIFY(writePresentationState({}, in.series, *firstFrame(in.series), {}, in.out()).ok());
  const auto read = loadPresentation(in.out());
  QVERIFY(read && read->pictures.size() == 3 && read->warnings.empty());
  QCOMPARE(read->label, std::string("VOLUMEN"));
  QCOMPARE(read->areas.at(0).area, (PixelBox{{0, 0}, {7, 7}}));
  ReadObject object(in.out());
  QCOMPARE(object[DCM_Modality], std::string("PR"));
  QCOMPARE(object[DCM_PresentationLUTShape], std::string("IDENTITY"));
  OFString spacing;
  QVERIFY(object.item(DCM_DisplayedAreaSelectionSequence)
              ->findAndGetOFStringArray(DCM_PresentationPixelSpacing, spacing)
              .good());
  QCOMPARE(std::string(spacing.c_str()), std::string("0.5\\0.7"));
}

void TestPresentationWritten::layersGetNamesOfTheirOwn() {
  const NamedSlices in;
  Presentation p;
  Presentation::Annotations part;
  for (const char* layer : {"", "lengths of lesion 1", "LENGTHS OF LESION 2",
                            "gr\xc3\xb6\xc3\x9f"
                            "e"})
    part.graphics.push_back({GraphicType::point, AnnotationUnits::pixel, {{1, 1}}, false, layer});
  p.annotations.push_back(part);
  QVERIFY(writePresentationState(p, in.series, *firstFrame(in.series), {}, in.out()).ok());
  const auto read = loadPresentation(in.out());
  QVERIFY(read && read->layers.size() == 4 && read->annotations.size() == 4);
  QCOMPARE(read->layers[1].name, std::string("LENGTHS OF LESIO"));
  for (std::size_t n = 0; n < 4; ++n) {
    QCOMPARE(read->annotations[n].graphics.at(0).layer, read->layers[n].name);
    for (std::size_t m = 0; m < n; ++m) QVERIFY(read->layers[n].name != read->layers[m].name);
  }
  COMPARE_WITH_STANDARD(in.out(), in.series.files[0]);
}

void TestPresentationWritten::whatItCannotHoldIsTold() {
  const NamedSlices in;
  Presentation p;
  p.shutter.shapes.resize(2);
  p.greys.push_back({{},
                     {{"a", {{1, 2}, WindowFunction::linear, {}, false}},
                      {"b", {{3, 4}, WindowFunction::sigmoid, {}, false}}}});
  p.annotations.push_back(
      {{},
       {{GraphicType::polyline, AnnotationUnits::pixel, std::vector<glm::dvec2>(70000), false, "A"}},
       {{"no place", {}, {}, "A"}}});
  const auto notes = writePresentationState(p, in.series, *firstFrame(in.series), {}, in.out());
  QVERIFY2(notes, notes ? "" : notes.message().c_str());
  QCOMPARE(notes->size(), std::size_t(4));
  const auto read = loadPresentation(in.out());
  QVERIFY(read && read->shutter.shapes.size() == 1 && read->greys.at(0).greys.size() == 1);
}

// 20,000 points are 160 kB, which Explicit VR cannot say.
void TestPresentationWritten::longShapesAreWrittenWhole() {
  const NamedSlices in;
  Chance chance(1);
  Presentation p;
  Graphic line{GraphicType::polyline, AnnotationUnits::pixel, {}, false, "A"};
  for (int n = 0; n < 20000; ++n) line.points.push_back(randomPoint(chance));
  p.annotations.push_back({{}, {line}, {}});
  QVERIFY(writePresentationState(p, in.series, *firstFrame(in.series), {}, in.out()).ok());
  const auto read = loadPresentation(in.out());
  QVERIFY(read && read->warnings.empty());
  QVERIFY(read->annotations.at(0).graphics.at(0).points == line.points);
}

// The VR counts characters, not bytes.
void TestPresentationWritten::longTextsAreCut() {
  const NamedSlices in;
  const auto withText = [](int characters) {
    Presentation p;
    const std::string text = QString(characters, QChar(0x00fc)).toStdString();
    p.annotations.push_back(
        {{}, {}, {{text, {}, GraphicText::Anchor{{2, 2}, AnnotationUnits::pixel, false}, "A"}}});
    return p;
  };
  for (const int characters : {1024, 1500}) {
    const std::string path = in.out() + std::to_string(characters);
    const auto notes =
        writePresentationState(withText(characters), in.series, *firstFrame(in.series), {}, path);
    QVERIFY2(notes, notes ? "" : notes.message().c_str());
    QCOMPARE(notes->size(), std::size_t(characters > 1024));
    const auto read = loadPresentation(path);
    QVERIFY(read);
    QCOMPARE(read->annotations.at(0).texts.at(0).text, withText(1024).annotations[0].texts[0].text);
  }
}

void TestPresentationWritten::namesStayAsTheyAre() {
  QFETCH(QByteArray, set);
  QFETCH(QByteArray, name);
  const NamedSlices in(set.toStdString(), name.toStdString());
  QVERIFY(writePresentationState({}, in.series, *firstFrame(in.series), {}, in.out()).ok());
  QCOMPARE(notAsInSource(in.out(), in.series.files[0]).join(QLatin1Char(10)), QString());
  COMPARE_WITH_STANDARD(in.out(), in.series.files[0]);
}

void TestPresentationWritten::whatCannotBeWrittenIsRefused() {
  const NamedSlices in;
  const auto frame = firstFrame(in.series);
  const auto refused = [&](const Presentation& p, const Frame& of, const char* words) {
    const auto notes = writePresentationState(p, in.series, of, {}, in.out());
    return !notes && notes.message().find(words) != std::string::npos &&
           !QFile::exists(QString::fromStdString(in.out()));
  };
  Presentation p;
  Frame colour = *frame;
  colour.rgb = std::vector<std::uint8_t>(192);
  QVERIFY(refused(p, colour, "in colour"));
  p.pictures = {{"1.2.99", {}, {}, {}}};
  QVERIFY(refused(p, *frame, "has no picture 1.2.99"));
  p.pictures = {{in.series.sopInstanceUids[0], {}, {}, {}}};
  p.areas.push_back({{{in.series.sopInstanceUids[1], {}, {}, {}}}, {}});
  QVERIFY(refused(p, *frame, "does not list"));
  writeAll(in.out(), {1});
  const auto notes = writePresentationState({}, in.series, *frame, {}, in.out());
  QVERIFY(!notes && notes.message().find("is there already") != std::string::npos);
  QVERIFY(readAll(in.out()) == std::vector<std::uint8_t>({1}));
}

VOLUMEN_TEST(TestPresentationWritten);
#include "tst_presentation_written.moc"
