// Guards import.md and slices.md 2: a grayscale presentation state (PS3.3 A.33.1) is read as written, and the
// frame it refers to is shown by it alone.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "io/frames.h"
#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/dicom_objects.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestPresentation : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aMadeOneIsReadWhole();
  void aRealOneIsReadWhole();
  void greysAreThoseOfTheState_data();
  void greysAreThoseOfTheState();
  void pixelsLieWhereTheyAreTurnedTo();
  void otherPicturesAreRefused();
  void whatItLeavesOutIsIdentity_data();
  void whatItLeavesOutIsIdentity();
  void inversionIsNotTakenTwice();
  void partsHoldForTheirPicturesOnly();
  void areaCountedFromZeroIsTheWholePicture();
  void whatIsNotUnderstoodIsLeftOut_data();
  void whatIsNotUnderstoodIsLeftOut();
};

namespace {

Result<PresentedFrame> ctSmallShown() {
  const Result<Study> study = openStudy(dataPath("dicom-pydicom/test_files/CT_small.dcm"));
  const Result<Presentation> state = loadPresentation(dataPath("dicom-2d/made-here/pr-on-CT_small.dcm"));
  if (!study || !state) return Error{state ? study.message() : state.message()};
  return loadFrame(study->volumes.at(0), 0, *state);
}

/// A slice and a presentation state that refers to it.
class Pair {
 public:
  explicit Pair(const std::function<void(DcmItem&)>& edit, const char* photometric = "MONOCHROME2") {
    DicomPicture slice = sliceAt(0, 1);
    slice.pixels.clear();
    for (unsigned n = 0; n < 12; ++n) slice.pixels.push_back(std::uint16_t(n * 100));
    slice.bitsStored = 12;
    slice.edit = [=](DcmDataset& data) {
      put(data, 0x0008, 0x0018, "1.2.3.99");
      put(data, 0x0028, 0x0004, photometric);
      put(data, 0x0028, 0x1052, "-1000");
      put(data, 0x0028, 0x1053, "2");
    };
    folder_.add("slice", slice);
    writeObject(folder_.path("pr"), presentationClass, [&](DcmItem& data) {
      DcmItem& picture = addItem(addItem(data, 0x0008, 0x1115), 0x0008, 0x1140);
      put(picture, 0x0008, 0x1155, "1.2.3.99");
      edit(data);
    });
  }
  Result<Presentation> state() const { return loadPresentation(folder_.path("pr")); }
  Result<PresentedFrame> shown() const {
    const Study study = folder_.open();
    const Result<Presentation> read = state();
    if (!read) return read.error();
    return loadFrame(study.volumes.at(0), 0, *read);
  }

 private:
  DicomFolder folder_;
};

std::uint8_t byteAt(const Frame& frame, int x, int y) {
  const std::vector<float> value{valueAt(frame, x, y)};
  return greyBytes(value, frame.greys.front().mapping)[0];
}

}  // namespace

void TestPresentation::aMadeOneIsReadWhole() {
  NEED_DATA(dataPath());
  const Result<Presentation> p = loadPresentation(dataPath("dicom-2d/made-here/pr-on-CT_small.dcm"));
  QVERIFY2(p, p ? "" : p.message().c_str());
  QVERIFY(p->warnings.empty() && p->inverted);
  QCOMPARE(p->label, std::string("TEST"));
  QCOMPARE(p->creator, std::string("Test^Made^Here"));
  QCOMPARE(p->date, std::string("20261123"));
  QCOMPARE(p->values.slope, 1.0);
  QCOMPARE(p->values.intercept, -1024.0);
  QCOMPARE(p->greys.at(0).greys.at(0).mapping.window, (Window{300, 2000}));
  QCOMPARE(p->greys[0].greys[0].name, std::string("PR BONE"));
  QCOMPARE(p->turn, (PictureTurn{1, true}));
  QCOMPARE(p->areas.at(0).area, (PixelBox{{0, 0}, {127, 127}}));
  QCOMPARE(p->shutter.shapes.size(), std::size_t(1));
  QCOMPARE(p->shutter.shapes[0].from, glm::dvec2(11, 16));
  QCOMPARE(p->shutter.shapes[0].to, glm::dvec2(118, 113));
  QCOMPARE(p->shutter.grey, 0.f);
  QCOMPARE(p->layers.size(), std::size_t(2));
  QCOMPARE(p->layers[0].name, std::string("MEASURE"));
  QCOMPARE(p->layers[1].grey, float(40000 / 65535.0));
  const auto& graphics = p->annotations.at(0).graphics;
  QCOMPARE(graphics.size(), std::size_t(3));
  QVERIFY(graphics[0].type == GraphicType::polyline && graphics[0].points.size() == 5);
  QVERIFY(graphics[1].type == GraphicType::circle && graphics[2].type == GraphicType::point);
  QCOMPARE(graphics[1].points[1], glm::dvec2(64, 44));  // centre 64, 64, radius 20
  const auto& texts = p->annotations.at(1).texts;
  QCOMPARE(texts.size(), std::size_t(2));
  QVERIFY(texts[0].anchor && texts[0].anchor->visible && texts[0].anchor->point == glm::dvec2(51, 51));
  QVERIFY(texts[1].box && texts[1].box->units == AnnotationUnits::display && !texts[1].anchor);
}

void TestPresentation::aRealOneIsReadWhole() {
  NEED_DATA(dataPath());
  const Result<Presentation> p = loadPresentation(dataPath("dicom-2d/pr-without-pixels/pr.dcm"));
  QVERIFY2(p, p ? "" : p.message().c_str());
  QVERIFY(p->warnings.empty() && !p->inverted && p->shutter.shapes.empty());
  QCOMPARE(p->greys.at(0).greys.at(0).mapping.window, (Window{2048, 4096}));
  const auto& part = p->annotations.at(0);
  QVERIFY(part.of.empty());
  QVERIFY(part.graphics.at(0).type == GraphicType::ellipse && part.graphics[0].points.size() == 4);
  QVERIFY(part.texts.at(0).text.find("Area: 119.58 cm\xc2\xb2") != std::string::npos);
  QVERIFY(part.texts[0].anchor && !part.texts[0].anchor->visible && part.texts[0].box);
  // The area counts from 0 and covers all of a picture of 2688 x 2688.
  const FramePresentation how = presentationOf(*p, p->pictures[0].sopInstanceUid, 0, {2688, 2688});
  QCOMPARE(*how.area, (PixelBox{{0, 0}, {2687, 2687}}));
}

void TestPresentation::greysAreThoseOfTheState_data() {
  QTest::addColumn<int>("x");
  QTest::addColumn<int>("y");
  QTest::addColumn<float>("value");
  QTest::addColumn<int>("grey");
  QTest::newRow("soft tissue, inverted once") << 51 << 51 << 70.f << 157;
  QTest::newRow("bone") << 64 << 64 << 904.f << 50;
}

void TestPresentation::greysAreThoseOfTheState() {
  NEED_DATA(dataPath());
  QFETCH(int, x);
  QFETCH(int, y);
  QFETCH(float, value);
  QFETCH(int, grey);
  const Result<PresentedFrame> shown = ctSmallShown();
  QVERIFY2(shown, shown ? "" : shown.message().c_str());
  QCOMPARE(valueAt(shown->frame, x, y), value);
  QCOMPARE(int(byteAt(shown->frame, x, y)), grey);
  QCOMPARE(shown->frame.unit, std::string("HU"));
}

void TestPresentation::pixelsLieWhereTheyAreTurnedTo() {
  NEED_DATA(dataPath());
  const Result<PresentedFrame> shown = ctSmallShown();
  QVERIFY(shown.ok());
  const PresentedGrid grid(shown->how, shown->frame.size);
  QCOMPARE(grid.size(), glm::ivec2(128, 128));
  for (int y : {0, 20, 127})
    for (int x : {0, 11, 127}) QCOMPARE(grid.pixelAt({x, y}), glm::ivec2(y, x));
  const auto hidden = [&](int x, int y) { return shown->frame.shutter.at(std::size_t(y * 128 + x)); };
  QVERIFY(hidden(11, 14) && !hidden(11, 15) && hidden(9, 20) && !hidden(10, 20));  // columns 11.., rows 16..
  QVERIFY(hidden(118, 50) && !hidden(117, 50) && hidden(50, 113) && !hidden(50, 112));
  // The anchor 51, 51 is on the diagonal, the point 90, 40 to one side of it.
  QCOMPARE(grid.displayed({90, 40}, AnnotationUnits::pixel), glm::dvec2(40, 90));
  QCOMPARE(grid.displayed({0.5, 0.25}, AnnotationUnits::display), glm::dvec2(64, 32));
}

void TestPresentation::otherPicturesAreRefused() {
  NEED_DATA(dataPath());
  const Result<Study> study = openStudy(dataPath("dicom-2d/ct-two-windows.dcm"));
  const Result<Presentation> state = loadPresentation(dataPath("dicom-2d/made-here/pr-on-CT_small.dcm"));
  QVERIFY(study.ok() && state.ok());
  const Result<PresentedFrame> shown = loadFrame(study->volumes.at(0), 0, *state);
  QVERIFY(!shown.ok() && shown.message().find("refers to other pictures.") != std::string::npos);
}

void TestPresentation::whatItLeavesOutIsIdentity_data() {
  QTest::addColumn<bool>("rescale");
  QTest::addColumn<bool>("window");
  QTest::addColumn<float>("value");  // real value of stored 300
  QTest::addColumn<int>("grey");
  QTest::newRow("neither: stored values, all of 12 bits") << false << false << 300.f << 19;
  QTest::newRow("no window: all values of 12 bits") << true << false << 400.f << 19;
  QTest::newRow("no rescale: a window of stored values") << false << true << 300.f << 255;
  QTest::newRow("both") << true << true << 400.f << 255;
}

void TestPresentation::whatItLeavesOutIsIdentity() {
  QFETCH(bool, rescale);
  QFETCH(bool, window);
  QFETCH(float, value);
  QFETCH(int, grey);
  const Pair pair([&](DcmItem& data) {
    if (rescale) put(data, 0x0028, 0x1053, "1"), put(data, 0x0028, 0x1052, "100");
    DcmItem& voi = addItem(data, 0x0028, 0x3110);
    if (window) put(voi, 0x0028, 0x1050, "100"), put(voi, 0x0028, 0x1051, "200");
  });
  const Result<PresentedFrame> shown = pair.shown();
  QVERIFY2(shown, shown ? "" : shown.message().c_str());
  QCOMPARE(valueAt(shown->frame, 3, 0), value);
  QCOMPARE(int(byteAt(shown->frame, 3, 0)), grey);
}

void TestPresentation::inversionIsNotTakenTwice() {
  for (const char* photometric : {"MONOCHROME1", "MONOCHROME2"})
    for (const char* shape : {"IDENTITY", "INVERSE"}) {
      const Pair pair([&](DcmItem& data) { put(data, 0x2050, 0x0020, shape); }, photometric);
      const Result<PresentedFrame> shown = pair.shown();
      QVERIFY(shown.ok());
      QCOMPARE(int(byteAt(shown->frame, 0, 0)), std::string(shape) == "INVERSE" ? 255 : 0);
    }
}

void TestPresentation::partsHoldForTheirPicturesOnly() {
  const Pair pair([&](DcmItem& data) {
    for (const char* uid : {"1.2.3.100", "1.2.3.99"}) {
      const bool mine = std::string(uid) == "1.2.3.99";
      DcmItem& voi = addItem(data, 0x0028, 0x3110);
      put(addItem(voi, 0x0008, 0x1140), 0x0008, 0x1155, uid);
      put(voi, 0x0028, 0x1050, mine ? "10" : "20");
      put(voi, 0x0028, 0x1051, "30");
      DcmItem& annotation = addItem(data, 0x0070, 0x0001);
      put(addItem(annotation, 0x0008, 0x1140), 0x0008, 0x1155, uid);
      DcmItem& point = addItem(annotation, 0x0070, 0x0009);
      put(point, 0x0070, 0x0005, "PIXEL");
      put(point, 0x0070, 0x0023, "POINT");
      putFloats(point, 0x0070, 0x0022, {mine ? 1.5f : 2.5f, 0});
    }
  });
  const Result<PresentedFrame> shown = pair.shown();
  QVERIFY(shown.ok());
  QCOMPARE(shown->frame.greys[0].mapping.window, (Window{10, 30}));
  QCOMPARE(shown->how.graphics.size(), std::size_t(1));
  QCOMPARE(shown->how.graphics[0].points[0], glm::dvec2(1.5, 0));
}

void TestPresentation::areaCountedFromZeroIsTheWholePicture() {
  const auto area = [](int fromX, int fromY, int toX, int toY) {
    return [=](DcmItem& data) {
      DcmItem& item = addItem(data, 0x0070, 0x005a);
      const Sint32 corners[] = {fromX, fromY, toX, toY};
      for (const bool last : {false, true}) {
        auto* corner = new DcmSignedLong(last ? DCM_DisplayedAreaBottomRightHandCorner
                                              : DCM_DisplayedAreaTopLeftHandCorner);
        corner->putSint32Array(corners + (last ? 2 : 0), 2);
        item.insert(corner);
      }
    };
  };
  QCOMPARE(*Pair(area(0, 0, 4, 3)).shown()->how.area, (PixelBox{{0, 0}, {3, 2}}));
  QCOMPARE(*Pair(area(2, 1, 4, 9)).shown()->how.area, (PixelBox{{1, 0}, {3, 8}}));
  QCOMPARE(*Pair(area(4, 3, 2, 1)).shown()->how.area, (PixelBox{{1, 0}, {3, 2}}));  // a turned picture
  QVERIFY(Pair(area(9, 9, 12, 12)).shown().message().find("no part") != std::string::npos);
  QVERIFY(Pair(area(-8000000, 1, 8000000, 200)).shown().message().find("268 million pixels") !=
          std::string::npos);
}

void TestPresentation::whatIsNotUnderstoodIsLeftOut_data() {
  QTest::addColumn<int>("what");
  QTest::addColumn<QString>("says");
  QTest::newRow("a circle of one point") << 0 << QStringLiteral("CIRCLE\" with 1 points");
  QTest::newRow("a graphic of an unknown type") << 1 << QStringLiteral("SPIRAL");
  QTest::newRow("points that are no numbers") << 2 << QStringLiteral("POINT\" with 0 points");
  QTest::newRow("units of slides") << 3 << QStringLiteral("POINT\" with 1 points");
  QTest::newRow("a text nowhere") << 4 << QStringLiteral("neither a box nor an anchor");
  QTest::newRow("a rotation by 45 degrees") << 5 << QStringLiteral("45 degrees");
  QTest::newRow("an area without corners") << 6 << QStringLiteral("displayed area");
  QTest::newRow("a presentation LUT") << 7 << QStringLiteral("Presentation LUT Sequence");
  QTest::newRow("a bitmap shutter") << 8 << QStringLiteral("BITMAP");
}

void TestPresentation::whatIsNotUnderstoodIsLeftOut() {
  QFETCH(int, what);
  QFETCH(QString, says);
  const Pair pair([&](DcmItem& data) {
    DcmItem& annotation = addItem(data, 0x0070, 0x0001);
    if (what <= 3) {
      constexpr const char* types[] = {"CIRCLE", "SPIRAL", "POINT", "POINT"};
      DcmItem& graphic = addItem(annotation, 0x0070, 0x0009);
      put(graphic, 0x0070, 0x0005, what == 3 ? "MATRIX" : "PIXEL");
      put(graphic, 0x0070, 0x0023, types[what]);
      putFloats(graphic, 0x0070, 0x0022, {what == 2 ? NAN : 1.f, 2.f});
    }
    if (what == 4) put(addItem(annotation, 0x0070, 0x0008), 0x0070, 0x0006, "lost");
    if (what == 5) putWord(data, 0x0070, 0x0042, 45);
    if (what == 6) put(addItem(data, 0x0070, 0x005a), 0x0070, 0x0100, "SCALE TO FIT");
    if (what == 7) put(addItem(data, 0x2050, 0x0010), 0x0028, 0x3003, "a LUT");
    if (what == 8) put(data, 0x0018, 0x1600, "BITMAP");
  });
  const Result<Presentation> state = pair.state();
  QVERIFY2(state, state ? "" : state.message().c_str());
  QCOMPARE(state->warnings.size(), std::size_t(1));
  QVERIFY2(
      state->warnings[0].find(says.toStdString()) != std::string::npos && state->warnings[0].ends_with("."),
      state->warnings[0].c_str());
  QVERIFY(pair.shown().ok());
}

VOLUMEN_TEST(TestPresentation);
#include "tst_presentation.moc"
