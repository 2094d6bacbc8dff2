// Guards design.md 7 on multi-frame pictures. Frames in different order at each position, and several files
// that each hold a stack, become pure volumes named by what separates them. VOLUMEN_RANDOM_CASES=5000 for
// more, VOLUMEN_RANDOM_SEED for others.
#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "io/load.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/dicom_frames.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSeriesFrames : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void framesOfOnePlaceArePure_data();
  void framesOfOnePlaceArePure();
  void filesOfStacksArePure_data();
  void filesOfStacksArePure();
};

namespace {

/// An attribute that separates frames. Writes value `n` (0 to 2) of frame `frame`.
struct FrameAttribute {
  const char* keyword;
  void (*write)(DcmDataset&, int frame, int n);
};

void word(DcmItem& item, const DcmTag& tag, const char* words, int n) {
  item.putAndInsertString(tag, QByteArray(words).split('|')[n].constData());
}

const FrameAttribute attributes[] = {
    {"ComplexImageComponent",
     [](DcmDataset& d, int f, int n) {
       word(group(d, f, DCM_MRImageFrameTypeSequence), DCM_ComplexImageComponent, "MAGNITUDE|PHASE|REAL", n);
     }},
    {"ImageType",
     [](DcmDataset& d, int f, int n) {
       word(group(d, f, DCM_CTImageFrameTypeSequence), DCM_FrameType,
            "ORIGINAL\\PRIMARY\\AXIAL\\NONE|DERIVED\\PRIMARY\\AXIAL\\MAX_IP|DERIVED\\PRIMARY\\AXIAL\\MIN_IP",
            n);
     }},
    {"AcquisitionContrast",
     [](DcmDataset& d, int f, int n) {
       word(group(d, f, DCM_MRImageFrameTypeSequence), DCM_AcquisitionContrast, "T1|T2|DIFFUSION", n);
     }},
    {"ASLContext",
     [](DcmDataset& d, int f, int n) {
       word(group(d, f, DCM_MRArterialSpinLabelingSequence), DCM_ASLContext, "LABEL|CONTROL|M_ZERO_SCAN", n);
     }},
    {"VelocityEncodingDirection",
     [](DcmDataset& d, int f, int n) {
       const Float64 direction[] = {n == 0 ? 1.0 : 0.0, n == 1 ? 1.0 : 0.0, n == 2 ? 1.0 : 0.0};
       group(d, f, DCM_MRVelocityEncodingSequence)
           .putAndInsertFloat64Array(DCM_VelocityEncodingDirection, direction, 3);
     }},
    {"DiffusionDirectionality",
     [](DcmDataset& d, int f, int n) {
       word(group(d, f, DCM_MRDiffusionSequence), DCM_DiffusionDirectionality, "NONE|DIRECTIONAL|ISOTROPIC",
            n);
     }},
    {"EchoTime",
     [](DcmDataset& d, int f, int n) {
       group(d, f, DCM_MREchoSequence).putAndInsertFloat64(DCM_EffectiveEchoTime, 2.3 * (n + 1));
     }},
    {"FlipAngle",
     [](DcmDataset& d, int f, int n) {
       word(group(d, f, DCM_MRTimingAndRelatedParametersSequence), DCM_FlipAngle, "5|15|30", n);
     }},
    {"RepetitionTime",
     [](DcmDataset& d, int f, int n) {
       word(group(d, f, DCM_MRTimingAndRelatedParametersSequence), DCM_RepetitionTime, "500|1000|2000", n);
     }},
    {"ContrastBolusAgentPhase",
     [](DcmDataset& d, int f, int n) {
       word(group(d, f, DCM_ContrastBolusUsageSequence), DCM_ContrastBolusAgentPhase,
            "PRE_CONTRAST|IMMEDIATE|POST_CONTRAST", n);
     }},
    {"SliceThickness",
     [](DcmDataset& d, int f, int n) {
       word(group(d, f, DCM_PixelMeasuresSequence), DCM_SliceThickness, "1|3|5", n);
       group(d, f, DCM_PixelMeasuresSequence).putAndInsertString(DCM_PixelSpacing, "0.5\\0.7");
     }},
    {"AttenuationCorrected",
     [](DcmDataset& d, int f, int n) {
       word(group(d, f, DCM_PETFrameCorrectionFactorsSequence), DCM_AttenuationCorrected, "NO|YES|B", n);
     }},
    {"StackID", [](DcmDataset& d, int f,
                   int n) { word(group(d, f, DCM_FrameContentSequence), DCM_StackID, "1|2|3", n); }},
    {"FrameLabel",
     [](DcmDataset& d, int f, int n) {
       word(group(d, f, DCM_FrameContentSequence), DCM_FrameLabel, "rest|stress|late", n);
     }},
    {"ScanOptions",  // for pictures converted to enhanced ones
     [](DcmDataset& d, int f, int n) {
       word(group(d, f, DcmTagKey(0x0020, 0x9171)), DCM_ScanOptions, "FS|PFF|SP", n);
     }},
};

void placeAt(DcmDataset& data, int frame, double z) {
  group(data, frame, DCM_PlanePositionSequence)
      .putAndInsertString(DCM_ImagePositionPatient, ("0\\0\\" + QByteArray::number(z)).constData());
}

void sharePlane(DcmDataset& data) {
  group(data, -1, DCM_PlaneOrientationSequence)
      .putAndInsertString(DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
  group(data, -1, DCM_PixelMeasuresSequence).putAndInsertString(DCM_PixelSpacing, "0.5\\0.7");
}

/// Returns an enhanced picture of `frames` frames, which `edit` fills in.
DicomPicture enhanced(int frames, const std::function<void(DcmDataset&)>& edit) {
  DicomPicture p;
  p.orientation = p.spacing = "";
  p.edit = [frames, edit](DcmDataset& data) {
    makeFrames(data, frames);
    data.findAndDeleteElement(DCM_ImagePositionPatient);
    sharePlane(data);
    edit(data);
  };
  return p;
}

void addSeeds() {
  QTest::addColumn<unsigned>("seed");
  const Seeds seeds = seedsOf(60, 1000);
  for (int n = seeds.first; n < seeds.behindLast(); ++n) QTest::addRow("seed %d", n) << unsigned(n);
}

}  // namespace

void TestSeriesFrames::framesOfOnePlaceArePure_data() { addSeeds(); }

void TestSeriesFrames::framesOfOnePlaceArePure() {
  QFETCH(unsigned, seed);
  std::mt19937 random(seed);
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
  const FrameAttribute& attribute = attributes[seed % std::size(attributes)];
  const int kinds = pick(2, 3), places = pick(1, 6);
  std::vector<int> order(std::size_t(kinds * places));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::shuffle(order, random);
  std::vector<int> missing;  // frames, for some seeds
  if (seed % 4 == 0 && places > 2) missing.push_back(pick(0, kinds * places - 1));
  std::erase_if(order, [&](int n) { return std::ranges::find(missing, n) != missing.end(); });
  const DicomFolder folder;
  folder.add("f", enhanced(int(order.size()), [&](DcmDataset& data) {
               for (int f = 0; f < int(order.size()); ++f) {
                 placeAt(data, f, 2 * (order[std::size_t(f)] / kinds));
                 attribute.write(data, f, order[std::size_t(f)] % kinds);
               }
             }));
  const Study study = folder.open();
  QVERIFY2(study.volumes.size() == std::size_t(kinds), attribute.keyword);
  for (const Series& s : study.volumes) {
    QCOMPARE(s.splitBy.empty() ? "" : s.splitBy[0].attribute, attribute.keyword);
    const auto loaded = loadSeries(s);
    QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
    std::set<int> found;
    for (const float value : firstOfEachSlice(*loaded->acquired))
      found.insert(order[std::size_t(value)] % kinds);
    QVERIFY2(found.size() == 1, attribute.keyword);
  }
}

void TestSeriesFrames::filesOfStacksArePure_data() { addSeeds(); }

// Files may have equal numbers, frames are in any order, positions may jitter between files, and some files
// may be shorter.
void TestSeriesFrames::filesOfStacksArePure() {
  QFETCH(unsigned, seed);
  std::mt19937 random(seed);
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
  const int files = pick(2, 5), places = pick(3, 6);
  const bool trembles = pick(0, 1), isNumbered = pick(0, 1), isShort = pick(0, 3) == 0;
  const DicomFolder folder;
  for (int file = 0; file < files; ++file) {
    const int count = isShort ? pick(3, places) : places;
    std::vector<int> order(std::size_t(count), 0);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::shuffle(order, random);
    const double off = trembles ? 0.05 * pick(-4, 4) : 0;
    DicomPicture p = enhanced(count, [&](DcmDataset& data) {
      for (int f = 0; f < count; ++f) placeAt(data, f, 2 * order[std::size_t(f)] + off);
      std::vector<Uint16> pixels;
      for (int f = 0; f < count; ++f) pixels.insert(pixels.end(), 12, Uint16(file));
      data.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
    });
    p.instance = isNumbered ? files - file : 1;
    folder.add(numbered("f", file), p);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(files));
  for (std::size_t n = 0; n < study.volumes.size(); ++n) {
    const auto loaded = loadSeries(study.volumes[n]);
    QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
    const std::vector<float> values = firstOfEachSlice(*loaded->acquired);
    QVERIFY(std::ranges::all_of(values, [&](float value) { return value == values[0]; }));
    QCOMPARE(int(values[0]), isNumbered ? files - 1 - int(n) : int(n));
    QVERIFY(!study.volumes[n].splitBy.empty());
  }
}

VOLUMEN_TEST(TestSeriesFrames);
#include "tst_series_frames.moc"
