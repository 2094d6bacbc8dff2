// Guards packed_bits.h: bits are packed and unpacked in order, from any position and in any number (PS3.5
// 8.1.1).
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "viewer/segment/packed_bits.h"

using namespace volumen;
using namespace volumen::tests;

class TestPackedBits : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theLowestBitOfAByteIsFirst();
  void rowsComeBack();
};

void TestPackedBits::theLowestBitOfAByteIsFirst() {
  BitPacker packer;
  QVERIFY(packer.bytes().empty());
  packer.add(0b101, 3);
  packer.add(0b1, 1);
  packer.add(0b1000001, 7);
  const std::vector<std::uint8_t> expected{0b00011101, 0b00000100};
  QCOMPARE(packer.bytes(), expected);
  QVERIFY(bitAt(expected, 0) && !bitAt(expected, 1) && bitAt(expected, 10) && !bitAt(expected, 11));
}

// Packs consecutive rows of any length and compares with packing bit by bit.
void TestPackedBits::rowsComeBack() {
  const Seeds seeds = seedsOf(500, 5000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const auto length = std::size_t(1 + chance.below(200)), rows = std::size_t(1 + chance.below(9));
    std::vector<std::uint8_t> bits(length * rows);
    BitPacker packer;
    for (std::size_t row = 0; row < rows; ++row) {
      std::vector<std::uint64_t> words((length + 63) / 64);
      for (std::size_t n = 0; n < length; ++n) {
        bits[row * length + n] = std::uint8_t(chance.below(2));
        words[n / 64] |= std::uint64_t(bits[row * length + n]) << n % 64;
      }
      packer.add(words, length);
    }
    const std::vector<std::uint8_t> bytes = packer.bytes();
    QCOMPARE(packer.size(), bits.size());
    QCOMPARE(bytes.size(), (bits.size() + 15) / 16 * 2);
    for (std::size_t n = 0; n < 8 * bytes.size(); ++n)
      if ((bytes[n / 8] >> n % 8 & 1) != (n < bits.size() ? bits[n] : 0))
        QFAIL(qPrintable(QString::number(seed)));
    for (std::size_t row = 0; row < rows; ++row) {
      std::vector<std::uint8_t> values(length);
      unpackBits(bytes, row * length, values);
      std::vector<std::uint64_t> words((length + 63) / 64, ~std::uint64_t(0));
      unpackWords(bytes, row * length, length, words);
      for (std::size_t n = 0; n < 64 * words.size(); ++n) {
        const int bit = n < length ? bits[row * length + n] : 0;
        if (int(words[n / 64] >> n % 64 & 1) != bit || (n < length && values[n] != bit))
          QFAIL(qPrintable(QStringLiteral("seed %1, row %2, bit %3").arg(seed).arg(row).arg(n)));
      }
    }
  }
}

VOLUMEN_TEST(TestPackedBits);
#include "tst_packed_bits.moc"
