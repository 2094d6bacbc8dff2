// Guards the passes over rows of stored values: on every CPU target they give the numbers of plain loops.
// Rows may end within a vector, and nothing after the row is changed. Stands here because this room names the
// targets.
#include <algorithm>
#include <limits>
#include <random>

#include "tests/fixtures/cpu_targets.h"
#include "tests/unit/suite.h"
#include "viewer/volume/extremes.h"

using namespace volumen;
using namespace volumen::tests;

class TestExtremes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void equalPlainLoops_data();
  void equalPlainLoops();
};

namespace {

// Returns values over the whole range of a type, including its limits. Their distances exceed the signed
// type.
template <class T>
std::vector<T> chance(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<T> values(count);
  for (T& v : values) {
    if constexpr (std::is_floating_point_v<T>)
      v = std::uniform_real_distribution<T>(-1e30f, 1e30f)(random);
    else
      v = T(random());
  }
  values[seed % count] = std::numeric_limits<T>::max();
  values[(seed + count / 2) % count] =
      std::numeric_limits<T>::lowest() / (std::is_floating_point_v<T> ? 2 : 1);
  return values;
}

template <class T>
bool rangeIsRight(std::size_t count) {
  const std::vector<T> values = chance<T>(count, 3);
  return rowPasses<T>().rangeOf(values.data(), count) ==
         std::pair(*std::min_element(values.begin(), values.end()),
                   *std::max_element(values.begin(), values.end()));
}

// One more element follows the row, which must not change.
template <class T>
bool rangesAreRight(std::size_t count) {
  const std::vector<T> values = chance<T>(count + 1, 5), before = chance<T>(count + 1, 6);
  std::vector<T> low = before, high = before, lowest = before, highest = before;
  rowPasses<T>().takeInRange(values.data(), count, low.data(), high.data());
  for (std::size_t n = 0; n < count; ++n) {
    lowest[n] = std::min(before[n], values[n]);
    highest[n] = std::max(before[n], values[n]);
  }
  return low == lowest && high == highest;
}

template <class T>
bool distancesAreRight(std::size_t count) {
  const std::vector<T> a = chance<T>(count + 1, 7), b = chance<T>(count + 1, 8);
  std::vector<Distance<T>> most(count + 1, Distance<T>(1)), expected = most;
  rowPasses<T>().takeInDistance(a.data(), b.data(), count, most.data());
  for (std::size_t n = 0; n < count; ++n)
    expected[n] = std::max(expected[n], Distance<T>(a[n] < b[n] ? b[n] - a[n] : a[n] - b[n]));
  return most == expected;
}

template <class T>
bool allAreRight(std::size_t count) {
  return rangeIsRight<T>(count) && rangesAreRight<T>(count) && distancesAreRight<T>(count);
}

}  // namespace

void TestExtremes::equalPlainLoops_data() {
  QTest::addColumn<int>("type");
  QTest::addColumn<int>("count");
  const char* const types[] = {"uint8", "int16", "uint16", "float"};
  for (int type = 0; type < 4; ++type)
    for (int count : {1, 3, 16, 63, 64, 65, 300})
      QTest::addRow("%d of %s", count, types[type]) << type << count;
}

void TestExtremes::equalPlainLoops() {
  QFETCH(int, type);
  QFETCH(int, count);
  const auto n = std::size_t(count);
  onEveryCpuTarget([&] {
    QVERIFY2(type == 0   ? allAreRight<std::uint8_t>(n)
             : type == 1 ? allAreRight<std::int16_t>(n)
             : type == 2 ? allAreRight<std::uint16_t>(n)
                         : allAreRight<float>(n),
             kernelTarget());
  });
}

VOLUMEN_TEST(TestExtremes);
#include "tst_extremes.moc"
