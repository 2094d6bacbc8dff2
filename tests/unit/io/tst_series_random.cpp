// Guards design.md 7: random series of one to four dimensions (position and up to three attributes). They
// have several patients, studies and frames of reference, are shuffled, and have missing and copied files.
// Every voxel's value identifies its picture. A volume that mixes two pictures must report it. Some pictures
// lack attributes that others have. VOLUMEN_RANDOM_CASES=5000 for more, VOLUMEN_RANDOM_SEED for others.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "io/load.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/series_attributes.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSeriesRandom : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void volumesArePure_data();
  void volumesArePure();
};

namespace {

/// What a picture belongs to, equal for two pictures of one volume. -1 if the file does not state it.
using Origin = std::vector<int>;

/// Sizes of the dimensions: patients, studies, frames of reference, attributes, positions.
struct Dimensions {
  std::vector<int> sizes;
  std::vector<const SeriesAttribute*> of;  // attributes of the fourth to the last but one dimension
};

struct Case {
  std::vector<Origin> originOf;  // by value
  Dimensions dimensions;
  std::map<std::pair<Origin, int>, int> atPlace;  // number of pictures by origin and position
  QString words;
};

std::vector<int> permutation(int count, std::mt19937& random) {
  std::vector<int> all(std::size_t(count), 0);
  std::iota(all.begin(), all.end(), 0);
  std::shuffle(all.begin(), all.end(), random);
  return all;
}

Dimensions randomDimensions(std::mt19937& random) {
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
  Dimensions d;
  for (int n = 0; n < 3; ++n) d.sizes.push_back(pick(0, 5) == 0 ? pick(2, 3) : 1);
  std::set<std::string> used;
  for (int n = pick(0, 3); n > 0; --n) {
    const SeriesAttribute& attribute =
        seriesAttributes()[std::size_t(pick(0, int(seriesAttributes().size()) - 1))];
    if (!used.insert(attribute.keyword).second) continue;
    d.of.push_back(&attribute);
    d.sizes.push_back(pick(2, 4));
  }
  d.sizes.push_back(pick(1, 6));
  return d;
}

DicomPicture picture(const Dimensions& d, const Origin& origin, int place, int value, int number) {
  DicomPicture p = sliceAt(2.0 * place + 0.5 * origin[2], value);
  p.instance = number;
  p.edit = [&d, origin](DcmDataset& data) {
    data.putAndInsertString(DCM_PatientID, ("P" + QByteArray::number(origin[0])).constData());
    data.putAndInsertString(DCM_PatientName, ("Test^Case" + QByteArray::number(origin[0])).constData());
    data.putAndInsertString(DCM_StudyInstanceUID, ("1.2.3." + QByteArray::number(origin[1] + 1)).constData());
    data.putAndInsertString(DCM_FrameOfReferenceUID,
                            ("1.2.4." + QByteArray::number(origin[2] + 1)).constData());
    for (std::size_t n = 0; n < d.of.size(); ++n)
      if (origin[3 + n] >= 0) d.of[n]->write(data, origin[3 + n]);
  };
  return p;
}

/// Returns patient, study and frame of reference.
Origin whose(const Origin& origin) { return {origin.begin(), origin.begin() + 3}; }

/// Returns whether nothing shows that these ordered slices do not belong together. Their differences may
/// occur in a volume, and no position holds two pictures.
bool cannotBeTold(const Case& made, const std::vector<Origin>& slices) {
  const Origin& first = slices[0];
  std::vector<std::vector<int>> ofAttribute(first.size());
  for (const Origin& other : slices) {
    if (whose(other) != whose(first)) return false;
    for (std::size_t n = 3; n < other.size(); ++n) ofAttribute[n].push_back(other[n]);
  }
  for (std::size_t n = 3; n < first.size(); ++n) {
    const std::set<int> values(ofAttribute[n].begin(), ofAttribute[n].end());
    const SeriesAttribute::May may = made.dimensions.of[n - 3]->may;
    if (values.size() > 1 && (may == SeriesAttribute::May::stay ||
                              (may == SeriesAttribute::May::change && comesBack(ofAttribute[n]) > 1)))
      return false;
  }
  return std::ranges::none_of(
      made.atPlace, [&](const auto& place) { return place.first.first == whose(first) && place.second > 1; });
}

/// Writes a random series.
Case write(const DicomFolder& folder, unsigned seed) {
  std::mt19937 random(seed);
  const auto chance = [&](int percent) { return std::uniform_int_distribution(0, 99)(random) < percent; };
  const Dimensions d = randomDimensions(random);
  int count = 1;
  for (const int size : d.sizes) count *= size;
  const std::vector<int> numbers = permutation(count, random);
  const int missing = chance(50) ? 0 : 12, perVolume = chance(30) ? d.sizes.back() : count;
  const int lacking = chance(80) ? 0 : 5;
  Case made;
  made.dimensions = d;
  made.words = QStringLiteral("sizes");
  for (const int size : d.sizes) made.words += QStringLiteral(" %1").arg(size);
  for (const SeriesAttribute* a : d.of) made.words += QStringLiteral(", ") + QString::fromLatin1(a->keyword);
  for (int value = 0; value < count; ++value) {
    Origin origin;
    int rest = value;
    for (const int size : d.sizes) origin.push_back(rest % size), rest /= size;
    const int place = origin.back();
    origin.pop_back();
    for (std::size_t n = 3; n < origin.size(); ++n)
      if (chance(lacking)) origin[n] = -1;
    made.originOf.push_back(origin);
    if (chance(missing)) continue;
    ++made.atPlace[{whose(origin), place}];
    const std::string name = "f" + std::to_string(numbers[std::size_t(value)]);
    folder.add(name, picture(d, origin, place, value, numbers[std::size_t(value)] % perVolume + 1));
    if (chance(3)) std::filesystem::copy_file(folder.path(name), folder.path(name + "copy"));
  }
  return made;
}

}  // namespace

void TestSeriesRandom::volumesArePure_data() {
  QTest::addColumn<unsigned>("seed");
  const Seeds seeds = seedsOf(150, 1000);
  for (int n = seeds.first; n < seeds.behindLast(); ++n) QTest::addRow("seed %d", n) << unsigned(n);
  QTest::newRow("found: two positions that lack different times") << 4242284u;
}

void TestSeriesRandom::volumesArePure() {
  QFETCH(unsigned, seed);
  const DicomFolder folder;
  const Case made = write(folder, seed);
  const Study study = folder.open();
  std::size_t mixed = 0;
  for (const Series& s : study.volumes) {
    const auto loaded = loadSeries(s);
    QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
    std::vector<Origin> slices;
    for (const float value : firstOfEachSlice(*loaded->acquired))
      slices.push_back(made.originOf[std::size_t(value)]);
    const std::set<Origin> origins(slices.begin(), slices.end());
    if (origins.size() == 1) continue;
    ++mixed;
    const bool told =
        std::ranges::any_of(s.warnings, [](const Warning& w) { return w.kind == WarningKind::notSeparated; });
    QString found = made.words;
    for (const SplitBy& by : s.splitBy) found += QStringLiteral("; ") + QString::fromStdString(by.words);
    for (const Origin& origin : origins) {
      found += QStringLiteral(" |");
      for (const int n : origin) found += QStringLiteral(" %1").arg(n);
    }
    QVERIFY2(told || cannotBeTold(made, slices), qPrintable(found));
  }
  if (qEnvironmentVariableIsSet("VOLUMEN_FIGURES"))
    qInfo("%s: %zu volumes, %zu images, %zu mixed", qPrintable(made.words), study.volumes.size(),
          study.images.size(), mixed);
}

VOLUMEN_TEST(TestSeriesRandom);
#include "tst_series_random.moc"
