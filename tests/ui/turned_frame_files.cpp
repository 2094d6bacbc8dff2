#include "tests/fixtures/small_volumes.h"
#include "tests/ui/turned_frames.h"

namespace volumen::tests {

namespace {

constexpr double ofGround = 100, ofMark = 1000;

// Turns a mammogram's file into a clip, which has no position in the patient.
bool makeClip(const QString& path, const std::vector<Uint16>& pixels, int frames) {
  DcmFileFormat file;
  const std::string name = path.toStdString();
  if (file.loadFile(name.c_str()).bad()) return false;
  DcmDataset& data = *file.getDataset();
  constexpr const char* ultrasound = "1.2.840.10008.5.1.4.1.1.3.1";
  data.putAndInsertString(DCM_SOPClassUID, ultrasound);
  file.getMetaInfo()->putAndInsertString(DCM_MediaStorageSOPClassUID, ultrasound);
  data.putAndInsertString(DCM_Modality, "US");
  for (const DcmTagKey& tag :
       {DCM_ImageLaterality, DCM_ViewPosition, DCM_PatientOrientation, DCM_ImagerPixelSpacing})
    data.findAndDeleteElement(tag);
  data.putAndInsertString(DCM_NumberOfFrames, QByteArray::number(frames).constData());
  data.putAndInsertString(DCM_RecommendedDisplayFrameRate, "20");
  data.putAndInsertUint16Array(DCM_PixelData, pixels.data(), static_cast<unsigned long>(pixels.size()));
  return file.saveFile(name.c_str(), EXS_LittleEndianExplicit).good();
}

}  // namespace

bool TurnedFrames::write() {
  const int kind = chance_.below(4);
  isClip_ = kind == 0, isStack_ = kind < 2;
  std::vector<Uint16> all;
  for (int n = 0; n < 4; ++n) {
    TwinPicture& picture = pictures_.emplace_back();
    picture.breast = breasts[n];
    Breast& breast = picture.breast;
    if (isStack_) breast.columns = 60, breast.rows = 80;
    if (isClip_) breast.rowsTo = "", picture.spacing = {1, 1};
    if (!isClip_ && chance_.oneIn(3)) picture.spacing = {0.1, 0.15};
    const glm::ivec2 size(breast.columns, breast.rows);
    std::vector<Uint16> pixels(std::size_t(size.x * size.y), Uint16(ofGround));
    for (const glm::dvec2 share :
         {glm::dvec2(0.2, 0.15), {0.75, 0.3}, {0.35, 0.6}, {0.85, 0.8}, {0.5, 0.45}}) {
      const glm::ivec2 mark(share * glm::dvec2(size) + 2.0 * n);
      picture.marks.push_back(mark);
      pixels[std::size_t(mark.y * size.x + mark.x)] = Uint16(ofMark);
    }
    picture.values =
        volumeOf<std::int16_t>({size, 1}, {picture.spacing.x, 0, 0, 0, picture.spacing.y, 0, 0, 0, 1},
                               [&](glm::dvec3 p) { return pixels[std::size_t(p.y * size.x + p.x)]; });
    all.insert(all.end(), pixels.begin(), pixels.end());
    if (!isClip_ && !writePicture(n, pixels)) return false;
  }
  const QString path = folder_.filePath(QStringLiteral("clip"));
  return !isClip_ ||
         (writeBreast(pictures_.front().breast, 1, path, BreastSeries::ofAll) && makeClip(path, all, 4));
}

bool TurnedFrames::writePicture(int n, const std::vector<Uint16>& pixels) {
  TwinPicture& picture = pictures_[std::size_t(n)];
  const QString path = folder_.filePath(QString::number(n));
  if (!writeBreast(picture.breast, n + 1, path, isStack_ ? BreastSeries::ofAll : BreastSeries::ofEach))
    return false;
  DcmFileFormat file;
  const std::string name = path.toStdString();
  if (file.loadFile(name.c_str()).bad()) return false;
  DcmDataset& data = *file.getDataset();
  data.putAndInsertUint16Array(DCM_PixelData, pixels.data(), static_cast<unsigned long>(pixels.size()));
  const QString spacing = QStringLiteral("%1\\%2").arg(picture.spacing.y).arg(picture.spacing.x);
  data.putAndInsertString(DCM_ImagerPixelSpacing, spacing.toLatin1().constData());
  if (file.saveFile(name.c_str(), EXS_LittleEndianExplicit).bad()) return false;
  const glm::dvec2 size(picture.breast.columns, picture.breast.rows);
  for (int state = 0; state < 2; ++state) {
    TwinState made{{0, 0}, size - 1.0, chance_.below(4), chance_.oneIn(2)};
    if (chance_.oneIn(2)) made.areaFrom = {5 + chance_.below(10), 3 + chance_.below(10)};
    if (chance_.oneIn(2)) made.areaTo -= glm::dvec2(chance_.below(15), chance_.below(20));
    picture.states.push_back(made);
    writeState(n, state, 10 + 2 * n + state);
  }
  return true;
}

void TurnedFrames::writeState(int picture, int state, int number) {
  const TwinState& s = pictures_[std::size_t(picture)].states[std::size_t(state)];
  DcmFileFormat file;
  DcmDataset& d = *file.getDataset();
  const auto put = [](DcmItem& in, const DcmTagKey& tag, const QString& value) {
    in.putAndInsertString(tag, value.toLatin1().constData());
  };
  const auto item = [](DcmItem& in, const DcmTagKey& tag) -> DcmItem& {
    DcmItem* made = nullptr;
    in.findOrCreateSequenceItem(tag, made, -2);
    return *made;
  };
  put(d, DCM_SOPClassUID, QStringLiteral("1.2.840.10008.5.1.4.1.1.11.1"));
  put(d, DCM_SOPInstanceUID, QStringLiteral("1.2.3.77.%1").arg(number));
  put(d, DCM_StudyInstanceUID, QStringLiteral("1.2.3.77"));
  put(d, DCM_SeriesInstanceUID, QStringLiteral("1.2.3.77.0.99"));
  put(d, DCM_Modality, QStringLiteral("PR"));
  put(d, DCM_PatientID, QStringLiteral("77"));
  put(d, DCM_PatientName, QStringLiteral("Doe^Jane"));
  put(d, DCM_ContentLabel, QStringLiteral("STATE%1").arg(state));
  DcmItem& named = item(item(d, DCM_ReferencedSeriesSequence), DCM_ReferencedImageSequence);
  put(named, DCM_ReferencedSOPClassUID, QStringLiteral("1.2.840.10008.5.1.4.1.1.1.2"));
  put(named, DCM_ReferencedSOPInstanceUID, QStringLiteral("1.2.3.77.%1").arg(picture + 1));
  DcmItem& shownBy = item(d, DCM_SoftcopyVOILUTSequence);
  put(shownBy, DCM_WindowCenter, QStringLiteral("400"));
  put(shownBy, DCM_WindowWidth, QStringLiteral("800"));
  put(d, DCM_PresentationLUTShape, QStringLiteral("IDENTITY"));
  d.putAndInsertUint16(DCM_ImageRotation, Uint16(90 * s.quarters));
  put(d, DCM_ImageHorizontalFlip, s.mirrored ? QStringLiteral("Y") : QStringLiteral("N"));
  DcmItem& area = item(d, DCM_DisplayedAreaSelectionSequence);
  for (const bool last : {false, true}) {
    const glm::dvec2 at = (last ? s.areaTo : s.areaFrom) + 1.0;
    const Sint32 corner[] = {Sint32(at.x), Sint32(at.y)};
    auto* element =
        new DcmSignedLong(last ? DCM_DisplayedAreaBottomRightHandCorner : DCM_DisplayedAreaTopLeftHandCorner);
    element->putSint32Array(corner, 2);
    area.insert(element);
  }
  put(area, DCM_PresentationSizeMode, QStringLiteral("SCALE TO FIT"));
  const std::string path = folder_.filePath(QStringLiteral("state%1").arg(number)).toStdString();
  if (file.saveFile(path.c_str(), EXS_LittleEndianExplicit).bad()) qFatal("cannot write a state");
}

// Shows the clip in four views.
void TurnedFrames::showClip() {
  const auto isOpen = [&] { return seriesIn(workspace(), workspace().focus) != nullptr; };
  if (!QTest::qWaitFor(isOpen, longest)) {
    fault_ = QStringLiteral("the clip is not opened");
    return;
  }
  const Series clip = *seriesIn(workspace(), workspace().focus);
  child<QAction>("layoutFour")->trigger();
  for (int n = 0; n < 4; ++n) session().showFrames(clip, firstComparedId + n);
  session().setFocus(firstComparedId);
}

}  // namespace volumen::tests
