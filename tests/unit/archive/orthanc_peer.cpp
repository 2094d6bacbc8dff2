#include "tests/unit/archive/orthanc_peer.h"

#include <QFile>
#include <QProcessEnvironment>
#include <QStandardPaths>

#include "tests/unit/archive/peer_process.h"

namespace volumen::tests {

namespace {

constexpr const char* plugins = "/usr/share/orthanc/plugins";
// Without a default encoding it answers in Latin 1.
constexpr const char* orthancConfiguration =
    R"({ "StorageDirectory": "%1", "IndexDirectory": "%1", "HttpPort": %2,
  "RemoteAccessAllowed": false, "AuthenticationEnabled": true, "RegisteredUsers": {"alice": "secret"},
  "DicomAet": "ORTHANC", "DicomPort": %3, "DicomCheckCalledAet": false, "DefaultEncoding": "Utf8",
  "DicomAlwaysAllowEcho": true, "DicomAlwaysAllowStore": true, "DicomAlwaysAllowFind": true,
  "DicomAlwaysAllowGet": true, "UnknownSopClassAccepted": true,
  "Plugins": ["%4"], "DicomWeb": {"Enable": true, "Root": "/dicom-web/"} })";

}  // namespace

bool OrthancPeer::isInstalled() {
  return !QStandardPaths::findExecutable(QStringLiteral("Orthanc")).isEmpty() &&
         QFile::exists(QLatin1String(plugins) + QStringLiteral("/libOrthancDicomWeb.so"));
}

OrthancPeer::OrthancPeer() : port_(freePort()), webPort_(freePort()) {}

OrthancPeer::~OrthancPeer() {
  process_.kill();
  process_.waitForFinished();
}

bool OrthancPeer::start() {
  const QString path = folder_.filePath(QStringLiteral("orthanc.json"));
  QFile file(path);
  if (!file.open(QIODevice::WriteOnly)) return false;
  file.write(QString::fromLatin1(orthancConfiguration)
                 .arg(folder_.filePath(QStringLiteral("db")))
                 .arg(webPort_)
                 .arg(port_)
                 .arg(QLatin1String(plugins))
                 .toUtf8());
  file.close();
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("TCP_NODELAY"), QStringLiteral("1"));
  process_.setProcessEnvironment(environment);
  process_.setStandardOutputFile(QProcess::nullDevice());
  process_.setStandardErrorFile(QProcess::nullDevice());
  process_.start(QStringLiteral("Orthanc"), {path});
  return listensAt(port_) && listensAt(webPort_);
}

void OrthancPeer::add(const QStringList& files) {
  QProcess store;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("TCP_NODELAY"), QStringLiteral("1"));
  store.setProcessEnvironment(environment);
  store.setStandardOutputFile(QProcess::nullDevice());
  store.setStandardErrorFile(QProcess::nullDevice());
  store.start(QStringLiteral("dcmsend"), QStringList{QStringLiteral("-aec"), QStringLiteral("ORTHANC"),
                                                     QStringLiteral("127.0.0.1"), QString::number(port_)} +
                                             files);
  store.waitForFinished(-1);
}

}  // namespace volumen::tests
