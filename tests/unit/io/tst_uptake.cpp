// Guards slices.md 4: the factors to SUV of every PET of the data and of random attributes, against
// independent calculations. VOLUMEN_RANDOM_CASES and VOLUMEN_RANDOM_SEED set the number and first seed of
// random cases.
#include <QDateTime>

#include "io/open.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/pet_series.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestUptake : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyPetOfTheData_data();
  void everyPetOfTheData();
  void byChance();
};

namespace {

void set(DcmItem& item, const DcmTagKey& tag, const std::string& text) {
  item.putAndInsertString(tag, text.c_str());
}

std::string number(double x) { return QString::number(x, 'g', 15).toStdString(); }

// The following functions calculate uptakes from raw attributes with DCMTK and Qt, without any of io/.

QString textOf(DcmItem& item, const DcmTagKey& tag) {
  OFString text;
  item.findAndGetOFStringArray(tag, text, true);
  return QString::fromLatin1(text.c_str()).trimmed();
}

/// Returns the seconds of a TM since midnight.
double secondsOf(const QString& text) {
  return 3600 * text.mid(0, 2).toInt() + 60 * text.mid(2, 2).toInt() + text.mid(4).toDouble();
}

/// Returns seconds since a fixed day in the past.
double momentOf(DcmItem& item, const DcmTagKey& date, const DcmTagKey& time) {
  const QDate day = QDate::fromString(textOf(item, date), QStringLiteral("yyyyMMdd"));
  return 86400.0 * double(day.toJulianDay()) + secondsOf(textOf(item, time));
}

/// Returns the SUVbw of a value of 1; empty if attributes are missing.
std::optional<double> uptakeOfOne(const std::vector<std::string>& files) {
  double first = HUGE_VAL;
  DcmFileFormat file;
  for (const std::string& path : files) {
    file.loadFile(path.c_str());
    first = std::min(first, momentOf(*file.getDataset(), DCM_AcquisitionDate, DCM_AcquisitionTime));
  }
  DcmDataset& data = *file.getDataset();
  const QString units = textOf(data, DCM_Units);
  if (units == QStringLiteral("GML")) return 1;
  const QStringList corrected = textOf(data, DCM_CorrectedImage).split(QLatin1Char('\\'));
  if (!corrected.contains(QStringLiteral("ATTN")) || !corrected.contains(QStringLiteral("DECY"))) return {};
  const double philips = textOf(data, DcmTagKey(0x7053, 0x1000)).toDouble();
  if (units == QStringLiteral("CNTS")) return philips > 0 ? std::optional(philips) : std::nullopt;
  DcmItem* tracer = nullptr;
  data.findAndGetSequenceItem(DCM_RadiopharmaceuticalInformationSequence, tracer);
  const double weight = textOf(data, DCM_PatientWeight).toDouble();
  if (units != QStringLiteral("BQML") || !tracer || !(weight > 0)) return {};
  const double dose = textOf(*tracer, DCM_RadionuclideTotalDose).toDouble(),
               halfLife = textOf(*tracer, DCM_RadionuclideHalfLife).toDouble();
  const double scan = std::min(momentOf(data, DCM_SeriesDate, DCM_SeriesTime), first),
               injected = secondsOf(textOf(*tracer, DCM_RadiopharmaceuticalStartTime));
  if (textOf(data, DCM_DecayCorrection) == QStringLiteral("ADMIN")) return weight * 1000 / dose;
  if (textOf(data, DCM_DecayCorrection) != QStringLiteral("START")) return {};
  return weight * 1000 / dose * std::pow(0.5, -(std::fmod(scan, 86400) - injected) / halfLife);
}

}  // namespace

void TestUptake::everyPetOfTheData_data() {
  QTest::addColumn<int>("known");  // volumes with a known SUVbw
  QTest::addColumn<int>("volumes");
  QTest::newRow("pet-ct/pet-bqml-fdg.dcm") << 1 << 1;
  QTest::newRow("pet-ct/pet-bqml-flt028.dcm") << 1 << 1;
  QTest::newRow("pet-ct/sts019-pet") << 1 << 1;
  QTest::newRow("field-cases/c28-suv-bqml") << 1 << 1;
  QTest::newRow("field-cases/c28-suv-cnts-factor") << 1 << 1;
  QTest::newRow("field-cases/c41-tiny-slopes") << 0 << 1;
  QTest::newRow("field-cases/c66q-frame-reference-time") << 0 << 3;
}

void TestUptake::everyPetOfTheData() {
  NEED_DATA(dataPath());
  QFETCH(int, known);
  QFETCH(int, volumes);
  const Result<Study> study = openStudy(dataPath(QTest::currentDataTag()));
  QVERIFY(study.ok());
  int all = 0, found = 0;
  for (const Series& series : study->volumes) {
    if (series.modality != "PT") {
      QVERIFY(series.suv == SuvFactors{});
      continue;
    }
    ++all;
    const std::optional<double> expected = uptakeOfOne(series.files), bw = series.suv.bodyWeight;
    QCOMPARE(bw.has_value(), expected.has_value());
    QVERIFY(bw || !series.suv.why.empty());
    if (!bw) continue;
    ++found;
    QVERIFY2(isNear(*bw, *expected), qPrintable(QString::number(*bw / *expected, 'g', 12)));
  }
  QCOMPARE(all, volumes);
  QCOMPARE(found, known);
}

namespace {

// A random PET, and the factors of its values.
struct ChancePet {
  explicit ChancePet(Chance chance) : c(chance) {
    const double lives[] = {6586.2, 1223, 4080, 597.9, 122.2, 46923, 282276};
    halfLife = lives[c.below(7)];
    injected = QDateTime(QDate(2024, 2, 27), QTime(0, 0)).addSecs(c.below(3 * 86400));
    delay = int(std::min(c.between(0, 3 * 3600), 15 * halfLife));
    const double meters = size, index = weight / (meters * 100) / (meters * 100) * weight;
    lean = female ? 1.07 * weight - 148 * index : 1.10 * weight - 128 * index;
    surface = 0.007184 * std::exp(0.425 * std::log(weight) + 0.725 * std::log(100 * size));
  }

  QDateTime scan() const { return injected.addSecs(delay); }
  // Returns the uptake of 1 Bq/ml, per kg of body weight.
  double perKg() const { return 1000 / dose * (admin ? 1 : std::exp(std::log(2.0) * delay / halfLife)); }
  // Returns the uptake of 1 in the file's units, per kg of body weight.
  double ofOnePerKg() const {
    switch (kind) {
      case 0:
        return perKg();
      case 1:
        return factor / weight;
      case 2:
        return factor * perKg();
      case 3:
        return 1 / weight;
      case 4:
        return 1 / (10 * surface);
      default:
        return 1 / lean;
    }
  }

  void write(DcmDataset& d) {
    const char* units[] = {"BQML", "CNTS", "CNTS", "GML", "CM2ML", "GML"};
    const char* types[] = {"", "", "", "BW", "BSA", "LBMJAMES128"};
    set(d, DCM_Units, units[kind]);
    set(d, DCM_SUVType, types[kind]);
    set(d, DCM_DecayCorrection, admin ? "ADMIN" : "START");
    set(d, DCM_PatientWeight, number(weight));
    set(d, DCM_PatientSize, number(size));
    set(d, DCM_PatientSex, female ? "F" : "M");
    set(doseOf(d), DCM_RadionuclideTotalDose, number(dose));
    set(doseOf(d), DCM_RadionuclideHalfLife, number(halfLife));
    writeTimes(d);
    if (kind != 1 && kind != 2) return;
    d.putAndInsertString(DcmTag(0x7053, 0x0010, EVR_LO), "Philips PET Private Group");
    d.putAndInsertString(DcmTag(0x7053, kind == 1 ? 0x1000 : 0x1009, EVR_DS), number(factor).c_str());
  }

  void writeTimes(DcmDataset& d) {
    const auto text = [](const QDateTime& t, const char* form) {
      return t.toString(QLatin1String(form)).toStdString();
    };
    if (byDate)
      set(doseOf(d), DCM_RadiopharmaceuticalStartDateTime, text(injected, "yyyyMMddhhmmss"));
    else
      set(doseOf(d), DCM_RadiopharmaceuticalStartTime, text(injected, "hhmmss"));
    const QDateTime series = scan().addSecs(seriesLater ? 5000 : 0),
                    acquired = scan().addSecs((seriesLater && !ge ? 0 : 600) + 60 * written++);
    set(d, DCM_SeriesDate, text(series, "yyyyMMdd"));
    set(d, DCM_SeriesTime, text(series, "hhmmss"));
    set(d, DCM_AcquisitionDate, text(acquired, "yyyyMMdd"));
    set(d, DCM_AcquisitionTime, text(acquired, "hhmmss"));
    if (!ge) return;
    d.putAndInsertString(DcmTag(0x0009, 0x0010, EVR_LO), "GEMS_PETD_01");
    d.putAndInsertString(DcmTag(0x0009, 0x100d, EVR_DT), text(scan(), "yyyyMMddhhmmss.00").c_str());
  }

  Chance c;
  int kind = c.below(6), written = 0, delay = 0;
  bool admin = c.oneIn(4), byDate = c.oneIn(2), seriesLater = c.oneIn(2), ge = c.oneIn(2),
       female = c.oneIn(2);
  double weight = c.between(3, 170), size = c.between(0.6 + weight / 120, 2.1), dose = c.power(6, 9),
         factor = c.power(-4, 1), halfLife = 0, lean = 0, surface = 0;
  QDateTime injected;
};

}  // namespace

void TestUptake::byChance() {
  const Seeds seeds = seedsOf(60, 1000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    ChancePet pet{Chance(std::uint64_t(seed))};
    const SuvFactors found = petWith([&](DcmDataset& d) { pet.write(d); }).suv;
    const QByteArray name = "seed " + QByteArray::number(seed) + ": " + found.why.c_str();
    QVERIFY2(found.bodyWeight && found.leanBodyMass && found.bodySurface, name.constData());
    QVERIFY2(isNear(*found.bodyWeight, pet.ofOnePerKg() * pet.weight), name.constData());
    QVERIFY2(isNear(*found.leanBodyMass, pet.ofOnePerKg() * pet.lean), name.constData());
    QVERIFY2(isNear(*found.bodySurface, pet.ofOnePerKg() * pet.surface * 10), name.constData());
  }
}

VOLUMEN_TEST(TestUptake);
#include "tst_uptake.moc"
