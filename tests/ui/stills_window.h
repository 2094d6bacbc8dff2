#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QTemporaryDir>
#include <algorithm>
#include <vector>

#include "tests/ui/journey.h"
#include "ui/workspace/workspace.h"

namespace volumen::tests {

/// A picture with one value in all pixels.
struct Still {
  int columns, rows;
  double mm;  // pixel spacing
  const char *photometric, *side, *view;
  int centre, width;
  int value;
  double grey;  // on screen: LINEAR of PS3.3 C.11.2.1.2.1, MONOCHROME1 inverted; the value if coloured
  const char* window;

  bool isColour() const { return width == 0; }
};

inline constexpr Still stills[] = {
    {60, 80, 0.1, "MONOCHROME2", "R", "PA", 400, 800, 300, 255 * (-99.5 / 799 + 0.5), "W 800 L 400"},
    {90, 50, 0.2, "MONOCHROME1", "L", "LL", 150, 200, 180, 255 * (0.5 - 30.5 / 199), "W 200 L 150"},
    {60, 80, 0.4, "MONOCHROME2", "L", "AP", 1000, 2000, 1500, 255 * (500.5 / 1999 + 0.5), "W 2000 L 1000"},
    {40, 44, 0.1, "RGB", "", "", 0, 0, 120, 120, ""}};
inline constexpr int stillCount = 4;

/// Writes the still with this number, from 1.
inline bool writeStill(int number, const QString& path) {
  const Still& still = stills[number - 1];
  DcmFileFormat file;
  DcmDataset& d = *file.getDataset();
  const auto text = [&](const DcmTagKey& tag, const QString& value) {
    d.putAndInsertString(tag, value.toLatin1().constData());
  };
  text(DCM_SOPClassUID, QStringLiteral("1.2.840.10008.5.1.4.1.1.1.1"));
  text(DCM_SOPInstanceUID, QStringLiteral("1.2.3.4.%1").arg(number));
  text(DCM_StudyInstanceUID, QStringLiteral("1.2.3.4"));
  text(DCM_SeriesInstanceUID, QStringLiteral("1.2.3.4.0"));
  text(DCM_SeriesNumber, QStringLiteral("1"));
  text(DCM_Modality, QStringLiteral("DX"));
  text(DCM_PatientID, QStringLiteral("7"));
  text(DCM_PatientName, QStringLiteral("Doe^Jane"));
  text(DCM_StudyDate, QStringLiteral("20260301"));
  text(DCM_InstanceNumber, QString::number(number));
  if (still.side[0]) text(DCM_ImageLaterality, QLatin1String(still.side));
  if (still.view[0]) text(DCM_ViewPosition, QLatin1String(still.view));
  text(DCM_ImagerPixelSpacing, QStringLiteral("%1\\%1").arg(still.mm));
  text(DCM_PhotometricInterpretation, QLatin1String(still.photometric));
  const int bits = still.isColour() ? 8 : 16, samples = still.isColour() ? 3 : 1;
  d.putAndInsertUint16(DCM_SamplesPerPixel, Uint16(samples));
  if (still.isColour()) d.putAndInsertUint16(DCM_PlanarConfiguration, 0);
  d.putAndInsertUint16(DCM_Rows, Uint16(still.rows));
  d.putAndInsertUint16(DCM_Columns, Uint16(still.columns));
  d.putAndInsertUint16(DCM_BitsAllocated, Uint16(bits));
  d.putAndInsertUint16(DCM_BitsStored, Uint16(bits));
  d.putAndInsertUint16(DCM_HighBit, Uint16(bits - 1));
  d.putAndInsertUint16(DCM_PixelRepresentation, 0);
  const auto count = std::size_t(still.columns * still.rows * samples);
  if (still.isColour()) {
    const std::vector<Uint8> pixels(count, Uint8(still.value));
    d.putAndInsertUint8Array(DCM_PixelData, pixels.data(), pixels.size());
  } else {
    text(DCM_WindowCenter, QString::number(still.centre));
    text(DCM_WindowWidth, QString::number(still.width));
    const std::vector<Uint16> pixels(count, Uint16(still.value));
    d.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
  }
  return file.saveFile(path.toLocal8Bit().constData(), EXS_LittleEndianExplicit).good();
}

/// Gives one half of the pixels one value and the other half another, without a window.
inline bool makeTwoValues(const QString& path, Uint16 low, Uint16 high) {
  DcmFileFormat file;
  const std::string name = path.toStdString();
  if (file.loadFile(name.c_str()).bad()) return false;
  DcmDataset& d = *file.getDataset();
  Uint16 columns = 0, rows = 0;
  d.findAndGetUint16(DCM_Columns, columns);
  d.findAndGetUint16(DCM_Rows, rows);
  std::vector<Uint16> pixels(std::size_t(columns) * rows, low);
  std::fill_n(pixels.begin(), pixels.size() / 2, high);
  d.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
  for (const DcmTagKey& tag : {DCM_WindowCenter, DCM_WindowWidth}) d.findAndDeleteElement(tag);
  return file.saveFile(name.c_str(), EXS_LittleEndianExplicit).good();
}

/// The files are ordered differently by name than by number.
struct Stills {
  QTemporaryDir folder;
  QString path(int number) const { return folder.filePath(QStringLiteral("%1.dcm").arg(9 - number)); }
  bool write() const {
    for (int number = 1; number <= stillCount; ++number)
      if (!writeStill(number, path(number))) return false;
    return true;
  }
};

/// A window that shows a folder of pictures in one view.
struct PicturesWindow : Journey {
  explicit PicturesWindow(const QString& path) {
    window.resize(1200, 800);
    if (!path.isEmpty()) window.open({path});
  }

  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  FrameView* view() { return window.views()->viewAs<FrameView>(axialViewId); }
  int frame() { return flatLookOf(workspace().view(axialViewId)).frame; }
  int steps() { return session().undoStack().index(); }
  void act(const char* action) { child<QAction>(action)->trigger(); }

  bool shows(int frame) {
    return QTest::qWaitFor(
        [&] {
          const LoadedFramePtr shown = view() ? frameIn(view()) : nullptr;
          return shown && view()->isVisible() && shown->key.series == view()->state().series &&
                 shown->key.index == frame && !view()->picture().isNull();
        },
        longest);
  }
};

struct WrittenStills {
  Stills data;
  const bool isWritten = data.write();
};

struct StillsWindow : WrittenStills, PicturesWindow {
  StillsWindow() : PicturesWindow(data.folder.path()) {}

  bool isOpen() {
    if (!isWritten || !showsStill(0)) return false;
    view()->setFocus();
    return true;
  }
  /// Returns whether a still is shown with its grey, which no other has.
  bool showsStill(int n) {
    const auto isGrey = [&] {
      const QImage& picture = view()->picture();
      const QRgb middle = picture.pixel(picture.width() / 2, picture.height() / 2);
      // A tolerance of 1/255 for rounding and the window's table.
      return std::abs(qRed(middle) - stills[n].grey) <= 1 && std::abs(qBlue(middle) - stills[n].grey) <= 1;
    };
    return shows(n) && QTest::qWaitFor(isGrey, longest);
  }
  const Series& stack() { return *seriesIn(workspace(), axialViewId); }
};

}  // namespace volumen::tests
