// Guards the index (import.md): after any changes of files, an import makes it match the folder. Runs
// VOLUMEN_RANDOM_CASES random operations (300) from VOLUMEN_RANDOM_SEED.
#include <filesystem>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/index/index_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
namespace fs = std::filesystem;

namespace {

/// Files by study. The study's name includes the patient.
using Listing = std::map<std::string, std::set<std::string>>;

/// Models the folder as a plain table and applies each operation to both.
class Model {
 public:
  explicit Model(std::uint64_t seed) : chance_(seed) {
    for (int n = 0; n < folders; ++n) fs::create_directories(folder_.data("f" + std::to_string(n)));
    index_.emplace(folder_.open());
  }

  void change() {
    const int what = chance_.below(10);
    if (what < 4 || files_.empty()) return write(newPath());
    const std::string path = anyPath();
    if (what < 5) return write(path);
    if (what < 7) {
      fs::remove(folder_.data(path));
      files_.erase(path);
      return;
    }
    if (what < 9) return rename(path, chance_.oneIn(4) ? anyPath() : newPath());
    forgetOne();
  }

  ImportReport import() {
    forgotten_.clear();  // an import restores them
    return folder_.import();
  }

  Listing expected() const {
    Listing listing;
    for (const auto& [path, study] : files_) listing[study].insert(folder_.data(path));
    return listing;
  }
  Listing found() const {
    Listing listing;
    for (const IndexedStudy& study : studiesIn(*index_)) {
      const std::vector<std::string> files = filesIn(*index_, study.id);
      int images = 0;
      for (const IndexedSeries& series : seriesIn(*index_, study.id)) images += series.images;
      if (std::size_t(images) != files.size() || study.images != images) listing["counts differ"];
      listing[study.studyUid].insert(files.begin(), files.end());
    }
    return listing;
  }
  bool forgottenAreHidden() const {
    for (const IndexedStudy& study : studiesIn(*index_))
      if (forgotten_.contains(study.studyUid)) return false;
    return true;
  }

 private:
  static constexpr int folders = 5, studies = 6;

  std::string newPath() {
    return "f" + std::to_string(chance_.below(folders)) + "/i" + std::to_string(next_++);
  }
  std::string anyPath() { return std::next(files_.begin(), chance_.below(int(files_.size())))->first; }
  void write(const std::string& path) {
    const int study = chance_.below(studies);
    const std::string uid = "1." + std::to_string(study);
    folder_.add(
        {path, "P" + std::to_string(study), uid, uid + "." + std::to_string(chance_.below(2)), next_++});
    files_[path] = uid;
  }
  void rename(const std::string& from, const std::string& to) {
    if (from == to) return;
    fs::rename(folder_.data(from), folder_.data(to));
    files_[to] = files_[from];
    files_.erase(from);
  }
  void forgetOne() {
    const std::vector<IndexedStudy> all = studiesIn(*index_);
    if (all.empty()) return;
    const IndexedStudy& study = all[std::size_t(chance_.below(int(all.size())))];
    QVERIFY(index_->forget({study.id}).ok());
    if (chance_.oneIn(2))
      QVERIFY(index_->undoForget({study.id}).ok());
    else
      forgotten_.insert(study.studyUid);
  }

  IndexFolder folder_;
  Chance chance_;
  std::optional<Index> index_;
  std::map<std::string, std::string> files_;  // study by path
  std::set<std::string> forgotten_;
  int next_ = 0;
};

}  // namespace

class TestIndexRandom : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void holdsWhatTheFolderHolds();
};

void TestIndexRandom::holdsWhatTheFolderHolds() {
  const auto [seed, operations] = seedsOf(300, 3000);
  Model model{std::uint64_t(seed)};
  Chance chance{std::uint64_t(seed) + 1000};
  for (int n = 0; n < operations; ++n) {
    model.change();
    if (QTest::currentTestFailed()) return;
    QVERIFY2(model.forgottenAreHidden(), qPrintable(QStringLiteral("operation %1").arg(n)));
    if (!chance.oneIn(5)) continue;
    const ImportReport report = model.import();
    QVERIFY(report.refused.empty());
    QVERIFY2(model.found() == model.expected(),
             qPrintable(QStringLiteral("operation %1, seed %2").arg(n).arg(seed)));
  }
}

VOLUMEN_TEST(TestIndexRandom);
#include "tst_index_random.moc"
