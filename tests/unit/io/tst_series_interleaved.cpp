// Guards design.md 7: several kinds of pictures along one line, at positions of their own, become separate
// volumes or are named, whatever attribute separates them. Pictures that belong together stay together.
// VOLUMEN_RANDOM_CASES=5000 for more, VOLUMEN_RANDOM_SEED for others.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "io/dicom/separators.h"
#include "io/load.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/series_attributes.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSeriesInterleaved : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everySeparatorIsTried();
  void kindsArePureOrNamed_data();
  void kindsArePureOrNamed();
  void whatBelongsTogetherStays_data();
  void whatBelongsTogetherStays();
};

namespace {

using May = SeriesAttribute::May;
constexpr int localizer = 100, unsaid = -1;

/// A series of several kinds, each a stack of its own (regular) or scattered over the positions of one stack.
struct Interleaved {
  std::vector<const SeriesAttribute*> of;  // attributes in which the kinds differ
  std::vector<double> z;                   // position of each picture
  std::vector<int> kind;                   // kind of each picture
  bool isRegular = true, isWhole = true, hasLocalizers = false;
  bool isMr = false;
};

class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  int pick(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  bool in100(int percent) { return pick(0, 99) < percent; }

 private:
  std::mt19937 random_;
};

/// Adds each kind as a stack with its own step and start.
void stackRegularly(Interleaved& made, int kinds, Chance& chance) {
  const double step = chance.pick(2, 10) * 0.5;
  const bool sameStep = chance.in100(70);
  for (int k = 0; k < kinds; ++k) {
    const double own = sameStep ? step : step * chance.pick(1, 3);
    const double offset = step * (k + (chance.in100(50) ? 0 : 0.1 * chance.pick(1, 8))) / kinds;
    const int count = chance.pick(3, 10), from = chance.in100(60) ? 0 : chance.pick(0, 3);
    for (int n = from; n < from + count; ++n) made.z.push_back(offset + n * own), made.kind.push_back(k);
  }
}

/// Adds the positions of one stack, each with a picture of any kind.
void scatter(Interleaved& made, int kinds, Chance& chance) {
  made.isRegular = false;
  const double step = chance.pick(2, 10) * 0.5;
  const int count = chance.pick(6, 16);
  for (int n = 0; n < count; ++n) made.z.push_back(n * step), made.kind.push_back(chance.pick(0, kinds - 1));
}

Interleaved randomKinds(unsigned seed) {
  Chance chance(seed);
  Interleaved made;
  const auto all = seriesAttributes();
  const int kinds = chance.pick(2, 3);
  for (int n = chance.pick(1, 2); n > 0; --n)
    made.of.push_back(&all[std::size_t(chance.pick(0, int(all.size()) - 1))]);
  if (made.of.size() > 1 && std::string(made.of[0]->keyword) == made.of[1]->keyword) made.of.pop_back();
  if (chance.in100(60))
    stackRegularly(made, kinds, chance);
  else
    scatter(made, kinds, chance);
  for (std::size_t n = made.z.size(); n-- > 0;)
    if (made.z.size() > 4 && chance.in100(seed % 3 == 0 ? 10 : 0)) {
      made.z.erase(made.z.begin() + std::ptrdiff_t(n)),
          made.kind.erase(made.kind.begin() + std::ptrdiff_t(n));
      made.isWhole = false;
    }
  made.isMr = chance.in100(50);
  if (!chance.in100(25)) return made;
  made.hasLocalizers = true;
  for (int n = chance.pick(1, 3); n > 0; --n)
    made.z.push_back(chance.pick(-3, 40)), made.kind.push_back(localizer);
  return made;
}

/// Returns what each picture's file states of its kind: a number for each attribute, -1 if it states nothing.
std::vector<std::vector<int>> whatIsSaid(const Interleaved& made, unsigned seed) {
  Chance chance(seed + 1);
  const int lacking = chance.in100(20) ? 15 : 0, lackingKind = chance.in100(25) ? 0 : unsaid;
  std::vector<std::vector<int>> all;
  for (const int kind : made.kind) {
    std::vector<int> said;
    for (std::size_t n = 0; n < made.of.size(); ++n)
      said.push_back(kind == localizer                              ? localizer
                     : kind == lackingKind || chance.in100(lacking) ? unsaid
                                                                    : kind);
    all.push_back(said);
  }
  return all;
}

void write(const DicomFolder& folder, const Interleaved& made, const std::vector<std::vector<int>>& said) {
  for (std::size_t n = 0; n < made.z.size(); ++n) {
    DicomPicture p = sliceAt(made.z[n], int(n));
    p.instance = int(n * 7 % made.z.size()) + 1;
    p.edit = [&, n](DcmDataset& data) {
      data.putAndInsertString(DCM_Modality, made.isMr ? "MR" : "CT");
      if (made.kind[n] == localizer) data.putAndInsertString(DCM_ImageType, "ORIGINAL\\PRIMARY\\LOCALIZER");
      for (std::size_t a = 0; a < made.of.size(); ++a)
        if (said[n][a] >= 0 && said[n][a] != localizer) made.of[a]->write(data, said[n][a]);
    };
    folder.add(numbered("f", int(n * 5 % 11 * 100 + n)), p);
  }
}

/// Returns whether values repeat in the same order, three times or more.
bool isPeriodic(const std::vector<int>& values) {
  for (std::size_t period = 2; period <= values.size() / 3; ++period)
    if (std::equal(values.begin() + std::ptrdiff_t(period), values.end(), values.begin())) return true;
  return false;
}

/// Returns whether slices with these values may be one acquisition as far as an attribute shows.
bool mayBeOne(const SeriesAttribute& attribute, const std::vector<int>& values) {
  if (std::set<int>(values.begin(), values.end()).size() < 2) return true;
  if (attribute.may == May::stay) return false;
  return attribute.may == May::change ? comesBack(values) < 2 : !isPeriodic(values);
}

}  // namespace

// A separator added to the table must also be added to the generator.
void TestSeriesInterleaved::everySeparatorIsTried() {
  for (const dicom::Separator& separator : dicom::separators()) {
    const std::string keyword = separator.keyword;
    const bool isOfFrames = keyword.ends_with("Vector") || keyword == "DimensionIndexValues";
    const bool isTried = std::ranges::any_of(seriesAttributes(),
                                             [&](const SeriesAttribute& a) { return a.keyword == keyword; });
    QVERIFY2(isOfFrames || isTried, keyword.c_str());
  }
}

void TestSeriesInterleaved::kindsArePureOrNamed_data() {
  QTest::addColumn<unsigned>("seed");
  const Seeds seeds = seedsOf(200, 2000);
  for (int n = seeds.first; n < seeds.behindLast(); ++n) QTest::addRow("seed %d", n) << unsigned(n);
}

void TestSeriesInterleaved::kindsArePureOrNamed() {
  QFETCH(unsigned, seed);
  const DicomFolder folder;
  const Interleaved made = randomKinds(seed);
  const auto said = whatIsSaid(made, seed);
  write(folder, made, said);
  QString words;
  for (const SeriesAttribute* a : made.of) words += QString::fromLatin1(a->keyword) + QStringLiteral(" ");
  const Study study = folder.open();
  std::size_t pictures = 0;
  for (const Image& image : study.images) pictures += std::size_t(image.frames);
  for (const Series& s : study.volumes) {
    const auto loaded = loadSeries(s);
    QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
    std::vector<std::vector<int>> ofAttribute(made.of.size());
    QString found = words + (made.isRegular ? QStringLiteral("regular:") : QStringLiteral("scattered:"));
    for (const float value : firstOfEachSlice(*loaded->acquired)) {
      const std::size_t n = std::size_t(value);
      found += QStringLiteral(" %1@%2").arg(said[n][0]).arg(made.z[n]);
      for (std::size_t a = 0; a < made.of.size(); ++a) ofAttribute[a].push_back(said[n][a]);
    }
    pictures += ofAttribute[0].size();
    const bool isTold =
        std::ranges::any_of(s.warnings, [](const Warning& w) { return w.kind == WarningKind::notSeparated; });
    bool mayBe = std::ranges::count(ofAttribute[0], localizer) % std::ptrdiff_t(ofAttribute[0].size()) == 0;
    QVERIFY2(mayBe, qPrintable(found + QStringLiteral(" a localizer is a slice")));
    for (std::size_t a = 0; a < made.of.size(); ++a) mayBe = mayBe && mayBeOne(*made.of[a], ofAttribute[a]);
    QVERIFY2(isTold || mayBe, qPrintable(found));
  }
  std::set<std::string> unread;  // lacking a rescale that others have
  for (const Series& s : study.volumes)
    for (const Unread& u : s.unread) unread.insert(u.path);
  QCOMPARE(pictures + unread.size(), made.z.size());
}

void TestSeriesInterleaved::whatBelongsTogetherStays_data() {
  using Edit = std::function<void(DcmDataset&, int)>;
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QList<double>>("z");
  const QList<double> even{0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22};
  const auto text = [](const DcmTagKey& tag, const QByteArray& words) {
    return Edit([tag, words](DcmDataset& data, int n) {
      const QByteArrayList values = words.split(' ');
      if (!values[n].isEmpty() && values[n] != "-") data.putAndInsertString(tag, values[n].constData());
    });
  };
  const auto row = [&](const char* name, const DcmTagKey& tag, const char* values) {
    QTest::newRow(name) << text(tag, values) << even;
  };
  row("contrast that begins in the middle", DCM_ContrastBolusAgent, "- - - - - A A A A A A A");
  row("thickness rounded here and there", DCM_SliceThickness, "2 2 1.99 2 2.01 2 1.99 2 2 2.01 2 1.99");
  row("one slice of another thickness", DCM_SliceThickness, "2 2 2 2 4 2 2 2 2 2 2 2");
  row("a description that was changed on the way", DCM_SeriesDescription, "a a a a a a b b b b b b");
  row("times that jitter", DCM_AcquisitionTime,
      "100000 100001 100000 100001 100000 100001 100000 100001 100000 100001 100000 100001");
  row("one image type that differs", DCM_ImageType,
      "ORIGINAL ORIGINAL DERIVED ORIGINAL ORIGINAL ORIGINAL ORIGINAL ORIGINAL ORIGINAL ORIGINAL ORIGINAL "
      "ORIGINAL");
  row("tube currents of a modulated scan", DCM_XRayTubeCurrent,
      "100 110 100 90 100 110 100 90 100 110 100 90");
  row("trigger times of a heart that is not even", DCM_TriggerTime,
      "812 800 805 812 805 800 812 800 800 805 812 805");
  row("repetition times of the same", DCM_RepetitionTime, "812 800 812 800 800 812 800 812 812 800 812 800");
  row("inversion times of slices in turn", DCM_InversionTime, "60 90 30 90 30 60 30 60 90 60 90 30");
  row("acquisitions one behind the other", DCM_AcquisitionNumber, "1 1 1 1 2 2 2 2 3 3 3 3");
  QTest::newRow("slices of an MR acquired in turn, two minutes apart") << Edit([](DcmDataset& data, int n) {
    data.putAndInsertString(DCM_Modality, "MR");
    data.putAndInsertString(DCM_AcquisitionTime, n % 2 ? "100200" : "100000");
    data.putAndInsertString(DCM_ContentTime, n % 2 ? "100210" : "100010");
  }) << even;
  QTest::newRow("thick slices between thin ones")
      << text(DCM_SliceThickness, "1 1 1 1 4 4 4 4 1 1 1 1")
      << QList<double>{0, 1, 2, 3, 5.5, 9.5, 13.5, 17.5, 20, 21, 22, 23};
}

void TestSeriesInterleaved::whatBelongsTogetherStays() {
  using Edit = std::function<void(DcmDataset&, int)>;
  QFETCH(Edit, edit);
  QFETCH(QList<double>, z);
  const DicomFolder folder;
  for (int n = 0; n < z.size(); ++n) {
    DicomPicture p = sliceAt(z[n], n);
    p.edit = [&](DcmDataset& data) { edit(data, n); };
    folder.add(numbered("f", n), p);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  for (const Warning& warning : study.volumes[0].warnings)
    QVERIFY2(warning.kind != WarningKind::notSeparated, warning.sentence.c_str());
}

VOLUMEN_TEST(TestSeriesInterleaved);
#include "tst_series_interleaved.moc"
