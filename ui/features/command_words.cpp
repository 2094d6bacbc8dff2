#include "ui/features/command_words.h"

#include <QObject>
#include <map>

#include "ui/tools/tool.h"

namespace volumen {

namespace {

const std::map<QString, QString>& table() {
  static const std::map<QString, QString> words{
      {QStringLiteral("openFolder"), QObject::tr("load import CD DVD disc DICOM")},
      {QStringLiteral("openFile"), QObject::tr("load")},
      {QStringLiteral("importFolder"), QObject::tr("add archive PACS database")},
      {QStringLiteral("showBrowser"), QObject::tr("worklist patients archive database PACS")},
      {QStringLiteral("exportFiles"),
       QObject::tr(
           "DICOM SR RTSTRUCT SEG key object secondary capture presentation state save as share hand on CD")},
      {QStringLiteral("sendToArchive"), QObject::tr("PACS upload store export C-STORE STOW DICOM")},
      {QStringLiteral("receiveStudies"), QObject::tr("PACS listen listener Storage SCP C-STORE node")},
      {QStringLiteral("saveSession"), QObject::tr("save project workspace presentation state")},
      {QStringLiteral("hideNames"), QObject::tr("anonymise anonymize de-identify deidentify privacy GDPR")},
      {QStringLiteral("savePicture"), QObject::tr("screenshot export image PNG JPEG capture")},
      {QStringLiteral("copyPicture"), QObject::tr("screenshot clipboard capture")},
      {QStringLiteral("printPicture"), QObject::tr("printer paper film PDF")},
      {QStringLiteral("saveStack"), QObject::tr("export series images")},
      {QStringLiteral("saveFilm"),
       QObject::tr("video movie cine animation MP4 APNG GIF export turntable time points")},
      {QStringLiteral("keyImagePages"), QObject::tr("findings letter table print PDF film paper pages")},
      {QStringLiteral("snapshot"), QObject::tr("screenshot export image high resolution")},
      {QStringLiteral("snapshotDock"), QObject::tr("video movie film turntable rotation export resolution")},
      {QStringLiteral("measurementsDock"), QObject::tr("report results export CSV table ROI list")},
      {QStringLiteral("accuracyDock"), QObject::tr("high standard draft exact resolution error")},
      {QStringLiteral("exportSegments"), QObject::tr("STL OBJ PLY 3D print mesh surface model")},
      {QStringLiteral("importSegments"), QObject::tr("mask label map")},
      {QStringLiteral("playFrames"), QObject::tr("cine video movie loop")},
      {QStringLiteral("trueSize"), QObject::tr("calibrate calibration life size 1:1 mm monitor")},
      {QStringLiteral("ownPixels"), QObject::tr("1:1 100 % actual pixels")},
      {QStringLiteral("resetView"), QObject::tr("fit zoom whole home")},
      {QStringLiteral("layoutPlanes"), QObject::tr("MPR multiplanar reconstruction axial coronal sagittal")},
      {QStringLiteral("layoutTwo"), QObject::tr("compare side by side split tile")},
      {QStringLiteral("comparePrior"), QObject::tr("previous earlier old study follow-up")},
      {QStringLiteral("secondWindow"), QObject::tr("monitor screen")},
      {QStringLiteral("removeTable"), QObject::tr("bed couch cushion")},
      {QStringLiteral("clipDock"), QObject::tr("crop box cut")},
      {QStringLiteral("transferDock"), QObject::tr("transfer function volume rendering")},
      {QStringLiteral("keyImage"), QObject::tr("bookmark mark star favourite favorite")},
      {QStringLiteral("attributes"), QObject::tr("tags header metadata")},
      {QStringLiteral("preferences"), QObject::tr("settings options configuration archive PACS")},
      {QStringLiteral("lightTheme"), QObject::tr("dark mode colours")},
      {QStringLiteral("documentation"), QObject::tr("help manual")},
      {QStringLiteral("shortcuts"), QObject::tr("help keyboard hotkeys")}};
  return words;
}

}  // namespace

QString otherWordsFor(const QString& name) {
  for (const Tool& tool : tools())
    if (name == QLatin1String(tool.name) + QStringLiteral("Tool")) return tool.otherWords;
  const auto found = table().find(name);
  return found == table().end() ? QString() : found->second;
}

}  // namespace volumen
