#pragma once

#include <QThread>
#include <atomic>

#include "io/archive/archives.h"
#include "io/open.h"
#include "tests/fixtures/program.h"
#include "tests/ui/browser_window.h"
#include "tests/unit/archive/web_peer.h"

namespace volumen::tests {

/// An archive ("held", DICOMweb) with the study "Head" of two series: "Bone", and the smaller "Soft tissue",
/// which it holds back until it is told to send it.
class HeldStudy {
 public:
  /// `studies` are written. The archive calls its series by this modality.
  explicit HeldStudy(const Studies& studies, const char* modality = "CT") : modality_(modality) {
    std::vector<std::string> paths;
    for (const char* folder : {"/doe/bone", "/doe/soft"})
      for (const QFileInfo& file : QDir(studies.data + QLatin1String(folder)).entryInfoList(QDir::Files))
        paths.push_back(file.filePath().toStdString());
    const Result<Study> study = openFiles(paths);
    if (!study) return;
    for (const Series& one : study->volumes) series_.push_back(one);
  }
  ~HeldStudy() { sendRest(); }

  Archive archive() const {
    Archive archive;
    archive.name = "held", archive.kind = ArchiveKind::dicomweb, archive.url = peer_.url().toStdString();
    return archive;
  }
  bool isReady() const { return series_.size() == 2; }
  /// Returns whether it was asked for the series that it holds back.
  bool isHolding() const { return isHolding_; }
  /// Sends what it holds back, or ends the line in its place.
  void sendRest() { rest_ = Rest::sent; }
  void hangUp() { rest_ = Rest::lost; }
  /// Returns the number of images of a series.
  int imagesOf(const char* description) const {
    for (const Series& one : series_)
      if (one.description == description) return int(one.files.size());
    return 0;
  }
  /// Returns how often images of "Bone" were asked for.
  int timesAskedForBone() const { return timesAskedForBone_; }

 private:
  enum class Rest { held, sent, lost };

  static QByteArray text(const char* tag, const std::string& value) {
    return '"' + QByteArray(tag) + R"(": {"Value": [")" + QByteArray::fromStdString(value) + R"("]})";
  }
  static QByteArray list(const QByteArrayList& answers) { return jsonAnswer('[' + answers.join(',') + ']'); }

  QByteArray seriesList() const {
    QByteArrayList all;
    for (const Series& one : series_)
      all << '{' + text("0020000E", one.seriesUid) + ',' + text("00080060", modality_) + ',' +
                 text("0008103E", one.description) + '}';
    return list(all);
  }
  QByteArray answerTo(const HttpRequest& request) {
    if (isListing(request) && !request.query.contains("offset=0")) return list({});
    if (request.path.endsWith("/studies"))
      return list({'{' + text("0020000D", series_[0].studyUid) + ',' + text("00100010", "Doe^Jane") + ',' +
                   text("00100020", "A111") + ',' + text("00081030", "Head") + ',' +
                   text("00080061", modality_) + '}'});
    if (request.path.endsWith("/series")) return seriesList();
    for (const Series& one : series_)
      if (request.path.contains("/series/" + QByteArray::fromStdString(one.seriesUid)))
        return request.path.endsWith("/instances") ? instancesOf(one) : imagesOf(one);
    return list({});
  }
  static QByteArray instancesOf(const Series& series) {
    QByteArrayList all;
    for (const std::string& uid : series.sopInstanceUids) all << '{' + text("00080018", uid) + '}';
    return list(all);
  }
  QByteArray imagesOf(const Series& series) {
    if (series.description == "Bone") ++timesAskedForBone_;
    if (series.description != "Bone") {
      isHolding_ = true;
      while (rest_ == Rest::held) QThread::msleep(10);
      if (rest_ == Rest::lost) return {};
    }
    QList<QByteArray> files;
    for (const std::string& path : series.files) files << contentsOf(QString::fromStdString(path));
    return partsOf(files);
  }

  const std::string modality_;
  std::vector<Series> series_;
  std::atomic<Rest> rest_ = Rest::held;
  std::atomic<bool> isHolding_ = false;
  std::atomic<int> timesAskedForBone_ = 0;
  HttpPeer peer_{[this](const HttpRequest& request) { return answerTo(request); }};
};

}  // namespace volumen::tests
