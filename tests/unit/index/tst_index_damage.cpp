// Guards import.md: an index with any damaged bytes either works or reports the damage. Queries change
// nothing, and an import repairs it.
#include <filesystem>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/index/index_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
namespace fs = std::filesystem;

namespace {

using Bytes = std::vector<std::uint8_t>;

// Damages a few bytes, a block or the end. Half of the damage hits the first page, which describes the
// tables.
Bytes damaged(Bytes bytes, Chance& chance) {
  const int head = 4096, size = int(bytes.size());
  const auto place = [&] { return chance.below(chance.oneIn(2) ? head : size); };
  const int kind = chance.below(6);
  if (kind == 0) {
    bytes.resize(std::size_t(chance.oneIn(2) ? chance.below(size) : chance.below(size / head) * head));
    return bytes;
  }
  const int from = place(), count = kind < 4 ? 1 + chance.below(4) : 512;
  for (int n = 0; n < count; ++n) {
    const int at = kind < 4 ? place() : std::min(size - 1, from + n);
    bytes[std::size_t(at)] = kind == 5 ? 0 : std::uint8_t(chance.below(256));
  }
  return bytes;
}

bool saysDamage(const std::string& sentence) {
  return sentence.find("`volumen import PATH` makes") != std::string::npos;
}

// Runs every query of an index. Returns the message of the first error.
std::string ask(const Index& index) {
  const auto studies = index.studies();
  if (!studies) return studies.message();
  for (const IndexedStudy& study : *studies) {
    const auto series = index.series(study.id);
    if (!series) return series.message();
    if (const auto files = index.files(study.id); !files) return files.message();
  }
  return {};
}

}  // namespace

class TestIndexDamage : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void byChanceIsToldAndMended();
  void whatAQuickLookLeavesOutIsMended();

 private:
  std::string database() const { return folder_->index() + "/index.sqlite"; }
  // Replaces the database and removes files that were set aside.
  void replaceBy(const Bytes& bytes) const {
    fs::remove_all(folder_->index());
    fs::create_directories(folder_->index());
    writeAll(database(), bytes);
  }
  std::unique_ptr<IndexFolder> folder_;
};

void TestIndexDamage::init() {
  folder_ = std::make_unique<IndexFolder>();
  for (int n = 0; n < 40; ++n) {
    const std::string study = "1." + std::to_string(n % 5);
    folder_->add({"f" + std::to_string(n / 20) + "/i" + std::to_string(n), "P" + std::to_string(n % 5), study,
                  study + ".1", n});
  }
  folder_->import();
}

void TestIndexDamage::byChanceIsToldAndMended() {
  const Bytes whole = readAll(database());
  const std::string undisturbed = tests::contentsOf(folder_->open());
  const Seeds seeds = seedsOf(40, 400);
  int told = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const Bytes spoilt = damaged(whole, chance);
    replaceBy(spoilt);
    const std::string where = "seed " + std::to_string(seed) + ": ";
    {
      const Result<Index> index = Index::openAsItIs(folder_->index());
      const std::string said = index ? ask(*index) : index.message();
      QVERIFY2(said.empty() || saysDamage(said), (where + said).c_str());
      told += said.empty() ? 0 : 1;
    }
    QVERIFY2(fs::exists(database()), where.c_str());
    QVERIFY2(readAll(database()) == spoilt, where.c_str());
    {
      Result<Index> index = Index::open(folder_->index());
      QVERIFY2(index.ok(), (where + (index ? "" : index.message())).c_str());
      const auto report = index->import({folder_->data()});
      QVERIFY2(report.ok(), (where + (report ? "" : report.message())).c_str());
      QCOMPARE(report->added + report->changed + report->unchanged, 40);
      if (!index->notice().empty()) QCOMPARE(tests::contentsOf(*index), undisturbed);
    }
    const Result<Index> after = Index::openAsItIs(folder_->index());
    QVERIFY2(after.ok(), (where + (after ? "" : after.message())).c_str());
    QVERIFY2(ask(*after).empty(), (where + ask(*after)).c_str());
    QVERIFY2(folder_->open().notice().empty(), where.c_str());
  }
  if (qEnvironmentVariableIsSet("VOLUMEN_FIGURES")) qInfo("%d of %d damages were told", told, seeds.count);
}

// Opening does not notice an SQLite index that disagrees with its table. Writing does.
void TestIndexDamage::whatAQuickLookLeavesOutIsMended() {
  const Bytes whole = readAll(database());
  const std::string text(whole.begin(), whole.end());
  int mended = 0;
  for (std::size_t at = text.find("i39"); at != std::string::npos; at = text.find("i39", at + 1)) {
    Bytes spoilt = whole;
    spoilt[at + 1] = '8';
    replaceBy(spoilt);
    {
      Index index = folder_->open();
      for (const char* gone : {"f1", "f0"}) fs::rename(folder_->data(gone), folder_->data(gone) + "-away");
      const auto without = index.import({folder_->data()});
      for (const char* gone : {"f1", "f0"}) fs::rename(folder_->data(gone) + "-away", folder_->data(gone));
      QVERIFY2(without.ok(), without ? "" : without.message().c_str());
      mended += index.notice().empty() ? 0 : 1;
    }
    Index index = folder_->open();
    const auto report = index.import({folder_->data()});
    QVERIFY2(report.ok(), report ? "" : report.message().c_str());
    QVERIFY(ask(index).empty());
    QCOMPARE(index.import({folder_->data()})->unchanged, 40);
  }
  QVERIFY(mended > 0);
}

VOLUMEN_TEST(TestIndexDamage);
#include "tst_index_damage.moc"
