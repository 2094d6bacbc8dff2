// Guards design.md 7: random series of one to four dimensions (place and up to three attributes), of several
// patients, studies and frames of reference, shuffled, with files missing and copied. Every voxel's value
// names the picture it comes from, so that a volume that mixes two is seen: it must say so.
// VOLUMEN_RANDOM_CASES=5000 for more, VOLUMEN_RANDOM_SEED for others.
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

/// Writes value `n` of an attribute.
struct Attribute {
  const char* name;
  void (*write)(DcmDataset&, int n);
  bool mayVary = false;  // within a volume, from place to place
};

void text(DcmDataset& data, const DcmTag& tag, const QByteArray& value) {
  QVERIFY(data.putAndInsertString(tag, value.constData()).good());
}

const Attribute attributes[] = {
    {"echo time", [](DcmDataset& d, int n) { text(d, DCM_EchoTime, QByteArray::number(2.5 * (n + 1))); }},
    {"time point",
     [](DcmDataset& d, int n) { text(d, DCM_TemporalPositionIdentifier, QByteArray::number(n + 1)); }},
    {"phase", [](DcmDataset& d,
                 int n) { d.putAndInsertFloat32(DCM_NominalPercentageOfCardiacPhase, 12.5f * float(n)); }},
    {"b", [](DcmDataset& d, int n) { d.putAndInsertFloat64(DCM_DiffusionBValue, 500.0 * n); }},
    {"b of GE",
     [](DcmDataset& d, int n) {
       text(d, DcmTag(0x0043, 0x0010, EVR_LO), "GEMS_PARM_01");
       text(d, DcmTag(0x0043, 0x1039, EVR_IS), QByteArray::number(1000000000 + 500 * n) + "\\8\\0\\0");
     }},
    {"b of Siemens",
     [](DcmDataset& d, int n) {
       text(d, DcmTag(0x0019, 0x0011, EVR_LO), "SIEMENS MR HEADER");
       text(d, DcmTag(0x0019, 0x110c, EVR_IS), QByteArray::number(400 * n));
     }},
    {"b of Philips",
     [](DcmDataset& d, int n) {
       text(d, DcmTag(0x2001, 0x0010, EVR_LO), "Philips Imaging DD 001");
       d.putAndInsertFloat32(DcmTag(0x2001, 0x1003, EVR_FL), 300.0f * float(n));
     }},
    {"image type",
     [](DcmDataset& d, int n) {
       constexpr const char* types[] = {"ORIGINAL\\PRIMARY\\M", "ORIGINAL\\PRIMARY\\P", "DERIVED\\PRIMARY\\W",
                                        "DERIVED\\PRIMARY\\F"};
       text(d, DCM_ImageType, types[n]);
     },
     true},
    {"kernel", [](DcmDataset& d,
                  int n) { text(d, DCM_ConvolutionKernel, "B" + QByteArray::number(30 + 20 * n) + "f"); }},
    {"kVp", [](DcmDataset& d, int n) { text(d, DCM_KVP, QByteArray::number(80 + 20 * n)); }},
    {"flip angle", [](DcmDataset& d, int n) { text(d, DCM_FlipAngle, QByteArray::number(3 + 9 * n)); }},
    {"inversion time",
     [](DcmDataset& d, int n) { text(d, DCM_InversionTime, QByteArray::number(100 + 80 * n)); }, true},
    {"repetition time",
     [](DcmDataset& d, int n) { text(d, DCM_RepetitionTime, QByteArray::number(500 + 150 * n)); }, true},
    {"acquisition", [](DcmDataset& d, int n) { text(d, DCM_AcquisitionNumber, QByteArray::number(n + 1)); },
     true},
    {"trigger time", [](DcmDataset& d, int n) { text(d, DCM_TriggerTime, QByteArray::number(33.5 * n)); },
     true},
    {"frame reference time",
     [](DcmDataset& d, int n) { text(d, DCM_FrameReferenceTime, QByteArray::number(1000 + 20000 * n)); },
     true},
    {"acquisition time",
     [](DcmDataset& d, int n) { text(d, DCM_AcquisitionTime, "1000" + QByteArray::number(10 + 5 * n)); },
     true},
    {"content time",
     [](DcmDataset& d, int n) { text(d, DCM_ContentTime, "1105" + QByteArray::number(10 + 7 * n) + ".25"); },
     true},
};

/// What a picture is of: two pictures of one volume have it alike.
using Origin = std::vector<int>;

/// How many there are along each dimension: patients, studies, frames of reference, attributes, places.
struct Dimensions {
  std::vector<int> sizes;
  std::vector<const Attribute*> of;  // of the fourth to the last but one
};

struct Case {
  std::vector<Origin> originOf;  // of a value
  Dimensions dimensions;
  std::map<std::pair<Origin, int>, int> atPlace;  // how many pictures: whose they are, where
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
  std::set<const Attribute*> used;
  for (int n = pick(0, 3); n > 0; --n) {
    const Attribute* attribute = &attributes[pick(0, int(std::size(attributes)) - 1)];
    const bool isB = attribute->name[0] == 'b';
    const bool twice =
        std::ranges::any_of(used, [&](const Attribute* a) { return isB && a->name[0] == 'b'; });
    if (twice || !used.insert(attribute).second) continue;
    d.of.push_back(attribute);
    d.sizes.push_back(pick(2, 4));
  }
  d.sizes.push_back(pick(1, 6));
  return d;
}

DicomPicture picture(const Dimensions& d, const Origin& origin, int place, int value, int number) {
  DicomPicture p = sliceAt(2.0 * place + 0.5 * origin[2], value);
  p.instance = number;
  p.edit = [&d, origin](DcmDataset& data) {
    text(data, DCM_PatientID, "P" + QByteArray::number(origin[0]));
    text(data, DCM_PatientName, "Test^Case" + QByteArray::number(origin[0]));
    text(data, DCM_StudyInstanceUID, "1.2.3." + QByteArray::number(origin[1] + 1));
    text(data, DCM_FrameOfReferenceUID, "1.2.4." + QByteArray::number(origin[2] + 1));
    for (std::size_t n = 0; n < d.of.size(); ++n) d.of[n]->write(data, origin[3 + n]);
  };
  return p;
}

/// Patient, study and frame of reference.
Origin whose(const Origin& origin) { return {origin.begin(), origin.begin() + 3}; }

/// Whether nobody can tell that these do not belong together: what they differ in may vary in a volume, and
/// no place holds two pictures.
bool cannotBeTold(const Case& made, const std::set<Origin>& origins) {
  const Origin& first = *origins.begin();
  for (const Origin& other : origins) {
    if (whose(other) != whose(first)) return false;
    for (std::size_t n = 3; n < other.size(); ++n)
      if (other[n] != first[n] && !made.dimensions.of[n - 3]->mayVary) return false;
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
  Case made;
  made.dimensions = d;
  made.words = QStringLiteral("sizes");
  for (const int size : d.sizes) made.words += QStringLiteral(" %1").arg(size);
  for (const Attribute* a : d.of) made.words += QStringLiteral(", ") + QString::fromLatin1(a->name);
  for (int value = 0; value < count; ++value) {
    Origin origin;
    int rest = value;
    for (const int size : d.sizes) origin.push_back(rest % size), rest /= size;
    const int place = origin.back();
    origin.pop_back();
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
    std::set<Origin> origins;
    for (const float value : firstOfEachSlice(*loaded->acquired))
      origins.insert(made.originOf[std::size_t(value)]);
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
    QVERIFY2(told || cannotBeTold(made, origins), qPrintable(found));
  }
  if (qEnvironmentVariableIsSet("VOLUMEN_FIGURES"))
    qInfo("%s: %zu volumes, %zu images, %zu mixed", qPrintable(made.words), study.volumes.size(),
          study.images.size(), mixed);
}

VOLUMEN_TEST(TestSeriesRandom);
#include "tst_series_random.moc"
