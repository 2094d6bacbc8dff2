// Guards texts on the picture and on the curve's axis. They are readable on any background, never overlap,
// and are left out if they would mislead.
#include <QStaticText>
#include <algorithm>
#include <cmath>

#include "results/pictures/overlays.h"
#include "results/pictures/picture_font.h"
#include "results/pictures/readable_text.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/overlays/view_overlays.h"
#include "ui/widgets/tissues.h"

using namespace volumen;

namespace {

Overlays everything() {
  Overlays o;
  o.topLeft << QStringLiteral("Featherstonehaugh, Maximilian Bartholomew (0123456789)")
            << QStringLiteral("CT Thorax with contrast, arterial phase 1.0 B31f (204)");
  o.topRight << QStringLiteral("From posterior-right-superior") << QStringLiteral("Zoom 100 %")
             << QStringLiteral("Perspective");
  o.bottomRight = QStringLiteral("standard - 1234 ms");
  o.warning = QStringLiteral("Not calibrated: no measurements in mm, no orientation");
  o.left = QStringLiteral("RAS");
  o.right = QStringLiteral("LPI");
  o.top = QStringLiteral("SPR");
  o.bottom = QStringLiteral("IAL");
  o.mmPerPixel = 0.5;
  return o;
}

double luminanceOf(QRgb pixel) {
  const auto linear = [](int byte) {
    const double part = byte / 255.0;
    return part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(qRed(pixel)) + 0.7152 * linear(qGreen(pixel)) + 0.0722 * linear(qBlue(pixel));
}

double contrastOf(QRgb a, QRgb b) {
  const auto [darker, lighter] = std::minmax({luminanceOf(a), luminanceOf(b)});
  return (lighter + 0.05) / (darker + 0.05);
}

}  // namespace

class TestOverlays : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void eachWarningHasItsLine();
  void noLettersWhereSidesAreNotKnown();
  void nothingTouchesAnythingElse_data();
  void nothingTouchesAnythingElse();
  void allOfItFindsRoomInAUsualView();
  void datesAreWhole_data();
  void datesAreWhole();
  void lettersAndHaloHaveOneOrder_data();
  void lettersAndHaloHaveOneOrder();
  void textIsReadableOnAnything_data();
  void textIsReadableOnAnything();
  void textsHaveContrastOnAnyGrey_data();
  void textsHaveContrastOnAnyGrey();
  void tissuesAreNamedWhereTheyAre_data();
  void tissuesAreNamedWhereTheyAre();
};

void TestOverlays::noLettersWhereSidesAreNotKnown() {
  const LoadedSeriesPtr known = tests::ballSeries();
  auto unknown = std::make_shared<LoadedSeries>(*known);
  unknown->series.warnings = {{"Of a transducer.", WarningKind::noDirections}};
  const Camera camera;
  QVERIFY(!viewOverlays(*known, camera, {100, 100}).left.isEmpty());
  const Overlays o = viewOverlays(*unknown, camera, {100, 100});
  QCOMPARE(o.left + o.right + o.top + o.bottom, QString());
  QCOMPARE(viewOverlays(*known, camera, {100, 100}).topRight.size(), 1);
  QCOMPARE(o.topRight, QStringList());
  QVERIFY(o.mmPerPixel > 0);
  QCOMPARE(placeText(known->series, {12, 3.5, 100}), QStringLiteral("L 12.0, P 3.5, S 100.0 mm"));
  QCOMPARE(placeText(unknown->series, {12, 3.5, -100}), QStringLiteral("x 12.0, y 3.5, z -100.0 mm"));
}

void TestOverlays::nothingTouchesAnythingElse_data() {
  QTest::addColumn<QSize>("size");
  QTest::addColumn<bool>("cube");
  for (int width : {1, 20, 60, 100, 200, 320, 450, 586, 840, 1900})
    for (int height : {1, 20, 60, 100, 200, 320, 600, 1300})
      for (bool cube : {false, true})
        QTest::addRow("%d x %d%s", width, height, cube ? ", with the cube" : "")
            << QSize(width, height) << cube;
}

void TestOverlays::nothingTouchesAnythingElse() {
  QFETCH(QSize, size);
  QFETCH(bool, cube);
  Overlays overlays = everything();
  if (cube) overlays.taken.emplace_back(8, size.height() - 118, 132, 110);
  const QRectF area(QPointF(), size);
  const PlacedOverlays placed = placeOverlays(overlays, area, pictureFont());
  std::vector<QRectF> rects = overlays.taken;
  for (const PlacedText& text : placed.texts) rects.push_back(text.rect);
  if (!placed.scaleBar.isEmpty()) rects.push_back(placed.scaleBar);
  for (std::size_t n = 0; n < rects.size(); ++n) {
    if (n >= overlays.taken.size()) QVERIFY(area.contains(rects[n]));
    for (std::size_t m = 0; m < n; ++m) QVERIFY(!rects[n].intersects(rects[m]));
  }
  // The texts can be painted, too.
  QImage image(size, QImage::Format_RGB32);
  QPainter painter(&image);
  paintOverlays(painter, overlays, area);
}

void TestOverlays::allOfItFindsRoomInAUsualView() {
  const Overlays overlays = everything();
  const PlacedOverlays placed = placeOverlays(overlays, {0, 0, 1200, 800}, pictureFont());
  QCOMPARE(int(placed.texts.size()), int(overlays.topLeft.size() + overlays.topRight.size() + 6));
  for (const PlacedText& text : placed.texts)
    QVERIFY2(!text.text.contains(QChar(0x2026)), qPrintable(text.text));
  QVERIFY(!placed.scaleBar.isEmpty());
  QCOMPARE(placed.scaleBarMm, 100.0);
}

void TestOverlays::datesAreWhole_data() {
  QTest::addColumn<int>("width");
  QTest::addColumn<bool>("hasRoom");
  QTest::newRow("room for the time") << 400 << true;
  QTest::newRow("none beside the number") << 140 << true;
  QTest::newRow("none but below the others") << 110 << true;
  QTest::newRow("none at all") << 70 << false;
}

// Half a date may be taken for another one.
void TestOverlays::datesAreWhole() {
  QFETCH(int, width);
  QFETCH(bool, hasRoom);
  Overlays overlays;
  overlays.topLeft = {QStringLiteral("Featherstonehaugh (4711)"), QStringLiteral("2026-03-14 10:22:31"),
                      QStringLiteral("CT Thorax (1)")};
  overlays.topRight = {QStringLiteral("Axial"), QStringLiteral("13 / 26"), QStringLiteral("I 5.0 mm")};
  QStringList dates;
  for (const PlacedText& text : placeOverlays(overlays, QRectF(0, 0, width, 200), pictureFont()).texts)
    if (text.text.startsWith(QLatin1Char('2'))) dates << text.text.left(10);
  QCOMPARE(dates, hasRoom ? QStringList{QStringLiteral("2026-03-14")} : QStringList());
}

// In mixed Hebrew and Latin text on white, bright letters lie inside their dark halo, so both have one order.
void TestOverlays::lettersAndHaloHaveOneOrder_data() {
  QTest::addColumn<QString>("text");
  QTest::newRow("Latin") << QStringLiteral("Doe, Jane (12345)");
  QTest::newRow("Hebrew") << QString::fromUtf8(
      "\u05e9\u05e8\u05d5\u05df, \u05d3\u05d1\u05d5\u05e8\u05d4 (SCSHBRW)");
  QTest::newRow("Arabic") << QString::fromUtf8(
      "\u0642\u0628\u0627\u0646\u064a, \u0644\u0646\u0632\u0627\u0631 (SCSARAB)");
}

void TestOverlays::lettersAndHaloHaveOneOrder() {
  QFETCH(QString, text);
  const auto drawn = [&](const QColor& ground, Qt::LayoutDirection direction) {
    QImage image(300, 40, QImage::Format_RGB32);
    image.fill(ground);
    QPainter painter(&image);
    painter.setLayoutDirection(direction);
    paintReadable(painter, {20, 10}, text, Qt::white);
    painter.end();
    return image;
  };
  const QImage white = drawn(Qt::white, Qt::LeftToRight), black = drawn(Qt::black, Qt::LeftToRight);
  QCOMPARE(drawn(Qt::white, Qt::RightToLeft), white);
  int letters = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 300; ++x) {
      if (qGray(black.pixel(x, y)) < 250) continue;
      ++letters;
      int darkest = 255;  // of the background near by
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) darkest = std::min(darkest, qGray(white.pixel(x + dx, y + dy)));
      QVERIFY2(darkest < 110, qPrintable(QStringLiteral("%1, %2: %3").arg(x).arg(y).arg(darkest)));
    }
  QVERIFY(letters > 5);
}

void TestOverlays::textIsReadableOnAnything_data() {
  QTest::addColumn<QColor>("ground");
  QTest::newRow("white") << QColor(Qt::white);
  QTest::newRow("bone") << QColor(0xf0, 0xe4, 0xc8);
  QTest::newRow("grey") << QColor(0x80, 0x80, 0x80);
  QTest::newRow("black") << QColor(Qt::black);
}

void TestOverlays::textIsReadableOnAnything() {
  QFETCH(QColor, ground);
  Overlays overlays;
  overlays.topLeft << QStringLiteral("IIIIIIIIIIIIIIII");
  QImage image(300, 60, QImage::Format_RGB32);
  image.fill(ground);
  QPainter painter(&image);
  painter.setFont(pictureFont());
  paintOverlays(painter, overlays, QRectF(0, 0, 300, 60));
  painter.end();
  // Strokes are bright, with dark pixels on both sides.
  int strokes = 0;
  const QRectF text = placeOverlays(overlays, {0, 0, 300, 60}, pictureFont()).texts.at(0).rect;
  const int y = int(text.center().y());
  for (int x = int(text.left()) + 1; x < text.right(); ++x) {
    const auto grey = [&](int at) { return qGray(image.pixel(at, y)); };
    if (grey(x) < 200 || grey(x) < grey(x - 1) || grey(x) < grey(x + 1)) continue;
    ++strokes;
    const int left = std::min(grey(x - 1), grey(x - 2)), right = std::min(grey(x + 1), grey(x + 2));
    QVERIFY2(left < 90 && right < 90, qPrintable(QStringLiteral("%1, %2").arg(left).arg(right)));
  }
  QVERIFY(strokes >= 8);
}

void TestOverlays::textsHaveContrastOnAnyGrey_data() {
  QTest::addColumn<QColor>("colour");
  for (const auto& [name, colour] : {std::pair("texts", 0xf2f4f6),
                                     {"warnings", 0xffc85a},
                                     {"a late clip", 0xff6b6b},
                                     {"measurements", 0xffbf69},
                                     {"the selected one", 0x4aa3ff},
                                     {"axial planes", 0xff5c5c},
                                     {"coronal planes", 0x5ce07a},
                                     {"sagittal planes", 0xf5d94a},
                                     {"black of a file", 0x000000},
                                     {"grey of a file", 0x808080},
                                     {"dark blue of a file", 0x0000c0}})
    QTest::newRow(name) << QColor(QRgb(colour));
}

// Measures contrast between letters and their surroundings, as WCAG 2.1, 1.4.3 defines it.
void TestOverlays::textsHaveContrastOnAnyGrey() {
  QFETCH(QColor, colour);
  const QString text = QStringLiteral("LIVER Doe, Jane 12.5 mm");
  const QSize size(220, 40);
  const auto paint = [&](const QColor& ground, const auto& draw) {
    QImage image(size, QImage::Format_RGB32);
    image.fill(ground);
    QPainter painter(&image);
    QFont font;
    font.setPixelSize(15);
    painter.setFont(font);
    draw(painter);
    return image;
  };
  QImage letters = paint(Qt::black, [&](QPainter& painter) {
    painter.setPen(Qt::white);
    QStaticText line(text);
    line.setTextFormat(Qt::PlainText);
    painter.drawStaticText(QPointF(6, 8), line);
  });
  for (int grey = 0; grey <= 255; grey += 15) {
    const QImage image = paint(QColor(grey, grey, grey), [&](QPainter& painter) {
      paintReadable(painter, QPointF(6, 8), text, colour);
    });
    int compared = 0;
    double least = 21;
    for (int y = 1; y < size.height() - 1; ++y)
      for (int x = 1; x < size.width() - 1; ++x) {
        if (qGray(letters.pixel(x, y)) < 250) continue;
        for (const QPoint by : {QPoint(1, 0), QPoint(-1, 0), QPoint(0, 1), QPoint(0, -1)}) {
          const QPoint beside = QPoint(x, y) + by;
          if (qGray(letters.pixel(beside)) > 0) continue;
          ++compared;
          least = std::min(least, contrastOf(image.pixel(x, y), image.pixel(beside)));
        }
      }
    QVERIFY(compared > 30);
    QVERIFY2(least >= 4.5, qPrintable(QStringLiteral("%1:1 on grey %2").arg(least).arg(grey)));
  }
}

void TestOverlays::tissuesAreNamedWhereTheyAre_data() {
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  QTest::addColumn<QStringList>("names");
  const auto row = [](const char* what, double low, double high, const char* names) {
    QTest::newRow(what) << low << high << QString::fromLatin1(names).split(QLatin1Char(' '));
  };
  row("all values: no contrast where bone is", -1024, 3071, "lung bone");
  row("soft tissue", -200, 300, "fat muscle");
  row("close up on contrast", 150, 420, "contrast");
  row("far out", -30000, 30000, "bone");
}

void TestOverlays::tissuesAreNamedWhereTheyAre() {
  QFETCH(double, low);
  QFETCH(double, high);
  QFETCH(QStringList, names);
  const ValueAxis axis{low, high, 40, 280};
  const auto width = [](const QString& name) { return 6.0 * double(name.size()); };
  QStringList found;
  for (const TissueLabel& label : tissueLabels(axis, width)) {
    found << label.name;
    // From its first to its last letter, the nearest tissue at or below is its own.
    for (const double x : {label.left, label.left + width(label.name)}) {
      QString below;
      for (const Tissue& tissue : tissuesHu)
        if (tissue.value <= axis.valueAt(x)) below = QLatin1String(tissue.name);
      QCOMPARE(below, label.name);
    }
  }
  QCOMPARE(found, names);
}

void TestOverlays::eachWarningHasItsLine() {
  Overlays o;
  o.warning = QStringLiteral("Gantry tilt\nSlices interpolated");
  const PlacedOverlays placed = placeOverlays(o, {0, 0, 400, 300}, pictureFont());
  QCOMPARE(placed.texts.size(), std::size_t(2));
  QVERIFY(placed.texts[1].rect.top() >= placed.texts[0].rect.bottom());
  QVERIFY(placed.texts[0].warning && placed.texts[1].warning);
}

VOLUMEN_TEST(TestOverlays);
#include "tst_overlays.moc"
