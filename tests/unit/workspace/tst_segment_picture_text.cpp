// Guards segment.md, "See segments in 3D": the text of a PNG about segments.
#include "results/segments/segment_picture_text.h"
#include "tests/unit/suite.h"
#include "viewer/segment/occupancy.h"

using namespace volumen;

class TestSegmentPictureText : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void namesThoseDrawn_data();
  void namesThoseDrawn();
  void saysWhereTheVolumeIs_data();
  void saysWhereTheVolumeIs();
};

void TestSegmentPictureText::namesThoseDrawn_data() {
  QTest::addColumn<bool>("drawn");
  QTest::addColumn<QString>("says");
  QTest::newRow("surfaces") << true << QStringLiteral("Bone\nTwo lines, opacity 0.25");
  QTest::newRow("a projection, which shows none") << false << QString();
}

void TestSegmentPictureText::namesThoseDrawn() {
  QFETCH(bool, drawn);
  QFETCH(QString, says);
  BitMask none({.size = {4, 4, 4}}), some = none;
  some.set({1, 2, 2});
  const auto field = [](const BitMask& mask) {
    return std::make_shared<const OccupancyField>(occupancyOf(mask, surfaceSigma));
  };
  const Segment bone{.number = 1, .label = "Bone"}, empty{.number = 2, .label = "Empty"},
      lines{.number = 3, .label = "Two\nlines", .opacity = 0.25}, clear{.number = 4, .opacity = 0};
  const std::vector<SegmentInScene> all{
      {&bone, field(some)}, {&empty, field(none)}, {&lines, field(some)}, {&clear, field(some)}};
  const PictureText text = textOfSegments(segmentsInPicture(all, {}), drawn);
  QCOMPARE(text.size(), std::size_t(drawn ? 1 : 0));
  if (!drawn) return;
  QCOMPARE(text[0].first, std::string("volumen-segments"));
  QCOMPARE(QString::fromStdString(text[0].second), says);
}

void TestSegmentPictureText::saysWhereTheVolumeIs_data() {
  QTest::addColumn<int>("where");
  QTest::addColumn<double>("margin");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, TissueShown::Where where, double margin, const char* says) {
    QTest::newRow(name) << int(where) << margin << QString::fromLatin1(says);
  };
  using enum TissueShown::Where;
  row("everywhere", everywhere, 2, "");
  row("inside", inside, 0, "only inside the segments that are shown");
  row("inside, grown", inside, 2.5, "only inside the segments that are shown and within 2.5 mm of them");
  row("outside", outside, 0, "not inside the segments that are shown");
  row("outside, grown", outside, 3, "not inside the segments that are shown nor within 3 mm of them");
}

void TestSegmentPictureText::saysWhereTheVolumeIs() {
  QFETCH(int, where);
  QFETCH(double, margin);
  QFETCH(QString, says);
  const PictureText text = textOfSegments(segmentsInPicture({}, {TissueShown::Where(where), margin}), true);
  QCOMPARE(text.empty(), says.isEmpty());
  if (says.isEmpty()) return;
  QCOMPARE(text[0].first, std::string("volumen-tissue"));
  QCOMPARE(QString::fromStdString(text[0].second), says);
}

VOLUMEN_TEST(TestSegmentPictureText);
#include "tst_segment_picture_text.moc"
