// Guards slices.md 2 (stored integers stay as they are): values, greys and windows are those of floats.
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/suite.h"
#include "viewer/slice/pixel_values.h"

using namespace volumen;

class TestPixelValues : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void integersMeanTheSameAsFloats_data();
  void integersMeanTheSameAsFloats();
  void theWindowHoldsNearlyAllValues_data();
  void theWindowHoldsNearlyAllValues();
  void withoutValuesThereIsAWindow();
};

namespace {

template <class T>
std::vector<T> chance(std::size_t count, double low, double high) {
  std::mt19937 random(11);
  std::normal_distribution<double> value((low + high) / 2, (high - low) / 5);
  std::vector<T> values(count);
  for (T& v : values) v = T(std::clamp(value(random), low, high));
  return values;
}

PixelValues valuesOf(const QString& type, std::size_t count) {
  if (type == QLatin1String("uint8")) return {chance<std::uint8_t>(count, 0, 255), 2, 1};
  if (type == QLatin1String("int16")) return {chance<std::int16_t>(count, -2000, 3000), 0.5, -10};
  if (type == QLatin1String("uint16, falling")) return {chance<std::uint16_t>(count, 0, 4095), -1, 4095};
  if (type == QLatin1String("uint16")) return {chance<std::uint16_t>(count, 0, 65535), 1, 0};
  return chance<float>(count, -1, 1);
}

const char* const types[] = {"uint8", "int16", "uint16", "uint16, falling", "float32"};

}  // namespace

void TestPixelValues::integersMeanTheSameAsFloats_data() {
  QTest::addColumn<QString>("type");
  QTest::addColumn<int>("count");
  for (const char* type : types)
    for (const int count : {100, 70000})
      QTest::newRow(qPrintable(QStringLiteral("%1, %2 pixels").arg(QLatin1String(type)).arg(count)))
          << QString::fromLatin1(type) << count;
}

void TestPixelValues::integersMeanTheSameAsFloats() {
  QFETCH(QString, type);
  QFETCH(int, count);
  const PixelValues values = valuesOf(type, std::size_t(count));
  QCOMPARE(values.size(), std::size_t(count));
  std::vector<float> floats;
  for (std::size_t n = 0; n < values.size(); ++n) floats.push_back(values[n]);
  QVERIFY(values.floats() == floats);
  QCOMPARE(values.anyNegative(), std::ranges::any_of(floats, [](float v) { return v < 0; }));
  const GreyMapping mappings[] = {{{100, 300}, WindowFunction::linear, {}, false},
                                  {{0, 1}, WindowFunction::linearExact, {}, true},
                                  {{500, 900}, WindowFunction::sigmoid, {}, false},
                                  {{}, WindowFunction::linear, {-5, {0, 0.5f, 0.2f, 1}}, false}};
  for (const GreyMapping& mapping : mappings)
    QVERIFY(values.greyBytes(mapping) == greyBytes(floats, mapping));
}

void TestPixelValues::theWindowHoldsNearlyAllValues_data() {
  QTest::addColumn<QString>("type");
  QTest::addColumn<bool>("isPadded");
  for (const char* type : types)
    for (const bool isPadded : {false, true})
      QTest::newRow(qPrintable(QLatin1String(type) + QLatin1String(isPadded ? ", padded" : "")))
          << QString::fromLatin1(type) << isPadded;
}

// By definition: the values of these ranks of all that are sorted.
void TestPixelValues::theWindowHoldsNearlyAllValues() {
  QFETCH(QString, type);
  QFETCH(bool, isPadded);
  const PixelValues values[] = {valuesOf(type, 70001), valuesOf(type, 1234)};
  const std::optional<ValueRange> padding =
      isPadded ? std::optional(ValueRange{double(values[0][0]), double(values[0][0]) + 50}) : std::nullopt;
  SharedWindow shared;
  std::vector<float> all;
  for (const PixelValues& each : values) {
    shared.add(each, padding);
    std::ranges::copy_if(each.floats(), std::back_inserter(all),
                         [&](float v) { return !isPadding(padding, v); });
  }
  std::ranges::sort(all);
  const auto ranked = [&](std::size_t perMille) {
    return double(all[(perMille * all.size() + 999) / 1000 - 1]);
  };
  const Window window = shared.window();
  QCOMPARE(window.centre, (ranked(1) + ranked(999)) / 2);
  QCOMPARE(window.width, ranked(999) - ranked(1));
}

void TestPixelValues::withoutValuesThereIsAWindow() {
  SharedWindow shared;
  QVERIFY(shared.window() == (Window{0.5, 1}));
  shared.add(std::vector<float>{std::nanf(""), 7}, ValueRange{7, 7});
  QVERIFY(shared.window() == (Window{0.5, 1}));
}

VOLUMEN_TEST(TestPixelValues);
#include "tst_pixel_values.moc"
