#pragma once

#include <QProcess>
#include <QTemporaryDir>

namespace volumen::tests {

/// An archive on this machine: Orthanc, by DIMSE (AE title ORTHANC) and by DICOMweb (user alice, password
/// "secret").
class OrthancPeer {
 public:
  /// Returns whether it and its DICOMweb plugin are installed.
  static bool isInstalled();
  OrthancPeer();
  ~OrthancPeer();

  /// Starts it. Returns whether it listens within a few seconds.
  bool start();
  /// Stores files in it by C-STORE.
  void add(const QStringList& files);
  int port() const { return port_; }
  QString url() const { return QStringLiteral("http://127.0.0.1:%1/dicom-web").arg(webPort_); }

 private:
  QTemporaryDir folder_;
  QProcess process_;
  const int port_, webPort_;
};

}  // namespace volumen::tests
