// Guards the memory of volumes and derived data: its length, its promised zeros, and equal behaviour with and
// without huge pages.
#include <algorithm>
#include <cstdint>

#include "tests/unit/suite.h"
#include "viewer/volume/buffer.h"

using namespace volumen;

namespace {
constexpr std::size_t hugePage = std::size_t(2) << 20;
}

class TestBuffer : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void zerosAreAllThere_data() { sizes(); }
  void zerosAreAllThere();
  void aWishKeepsWhatIsWritten_data() { sizes(); }
  void aWishKeepsWhatIsWritten();
  void bytesBehindTheLastCanBeRead_data() { sizes(); }
  void bytesBehindTheLastCanBeRead();

 private:
  static void sizes();
};

void TestBuffer::sizes() {
  QTest::addColumn<qulonglong>("bytes");
  for (const std::size_t bytes : {std::size_t(0), std::size_t(1), hugePage - 1, hugePage, hugePage + 1,
                                  2 * hugePage - 1, 2 * hugePage, 5 * hugePage + 4097})
    QTest::addRow("%zu bytes", bytes) << qulonglong(bytes);
}

void TestBuffer::zerosAreAllThere() {
  QFETCH(qulonglong, bytes);
  {
    std::vector<std::uint8_t> before(bytes, 0xa5);  // dirties memory that may be handed out again
    QCOMPARE(before.size(), std::size_t(bytes));
  }
  const auto values = zeros<std::uint8_t>(bytes);
  QCOMPARE(values.size(), std::size_t(bytes));
  QVERIFY(std::ranges::all_of(values, [](std::uint8_t v) { return v == 0; }));
  QVERIFY(values.capacity() == values.size());
}

void TestBuffer::aWishKeepsWhatIsWritten() {
  QFETCH(qulonglong, bytes);
  std::vector<std::uint8_t> values(bytes);
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = std::uint8_t(n * 7 + n / 4096);
  const std::vector<std::uint8_t> expected = values;
  wantHugePages(values.data(), values.size());
  QCOMPARE(values, expected);
}

void TestBuffer::bytesBehindTheLastCanBeRead() {
  QFETCH(qulonglong, bytes);
  const Buffer<std::uint8_t> buffer{std::size_t(bytes)};
  QCOMPARE(reinterpret_cast<std::uintptr_t>(buffer.data()) % 64, std::uintptr_t(0));
  const std::uint8_t* behind = buffer.data() + bytes;
  QVERIFY(std::all_of(behind, behind + 64, [](std::uint8_t v) { return v == 0; }));
}

VOLUMEN_TEST(TestBuffer);
#include "tst_buffer.moc"
