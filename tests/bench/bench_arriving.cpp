// Prints the time from the double click on a study of an archive on this machine (dcmqrscp, Orthanc by DIMSE
// and DICOMweb) to its first slice and to the full 3D picture, for the chest CT of 138 slices. Asserts only
// that they appear.
#include <QDate>
#include <QElapsedTimer>
#include <algorithm>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/archives_window.h"
#include "tests/ui/watchdog.h"
#include "tests/unit/archive/orthanc_peer.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/archive/web_peer.h"
#include "tests/unit/suite.h"
#include "ui/views/first_image.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct ArrivingWindow : ArchivesWindow {
  using ArchivesWindow::ArchivesWindow;

  bool showsSlice() {
    if (child<FirstImage>("firstImage")->isVisible()) return true;
    for (View* view : window.views()->viewsSeen())
      if (auto* flat = qobject_cast<FlatView*>(view); flat && flat->shown() && !flat->picture().isNull())
        return true;
    return false;
  }
};

// Answers a search with up to 5,000 studies of today, from an offset on.
QByteArray studiesFrom(const HttpRequest& request) {
  constexpr int all = 5000, page = 200;
  const qsizetype at = request.query.indexOf("offset=") + 7;
  const int first = request.query.mid(at, request.query.indexOf('&', at) - at).toInt();
  const QByteArray today = QDate::currentDate().toString(QStringLiteral("yyyyMMdd")).toLatin1();
  QByteArray found;
  for (int n = first; n < std::min(all, first + page); ++n) {
    const QByteArray number = QByteArray::number(n);
    found += (found.isEmpty() ? "" : ",") + QByteArray(R"({"0020000D": {"Value": ["1.2.9.)") + number +
             R"("]}, "00100010": {"Value": ["P)" + number + R"("]}, "00080020": {"Value": [")" + today +
             R"("]}, "00080061": {"Value": ["CT"]}})";
  }
  return httpAnswer("200 OK", "application/dicom+json", '[' + found + ']');
}

}  // namespace

class BenchArriving : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void fromTheClickToThePicture_data();
  void fromTheClickToThePicture();
  void rowsOfAnArchive();
};

void BenchArriving::fromTheClickToThePicture_data() {
  QTest::addColumn<QString>("peer");
  for (const char* peer : {"dcmqrscp", "Orthanc, DIMSE", "Orthanc, DICOMweb"})
    QTest::newRow(peer) << QString::fromLatin1(peer);
}

void BenchArriving::fromTheClickToThePicture() {
  QFETCH(QString, peer);
  const std::string path = dataPath("ct-chest-lidc0314-138");
  NEED_DATA(path);
  if (!QrPeer::isInstalled() || !OrthancPeer::isInstalled()) QSKIP("dcmtk or orthanc is not installed");
  const QStringList files = dicomFilesBelow(QString::fromStdString(path));
  QrPeer dcmqrscp;
  OrthancPeer orthanc;
  Archive archive = ListedArchives::archiveAt(dcmqrscp.port());
  if (peer == QLatin1String("dcmqrscp")) {
    dcmqrscp.add(files);
    QVERIFY(dcmqrscp.start());
  } else {
    QVERIFY(orthanc.start());
    orthanc.add(files);
    archive.port = orthanc.port(), archive.calledAe = "ORTHANC";
  }
  if (peer.endsWith(QLatin1String("DICOMweb"))) {
    archive.kind = ArchiveKind::dicomweb;
    archive.url = orthanc.url().toStdString(), archive.user = "alice",
    archive.passwordCommand = "echo secret";
  }
  const ListedArchives list(Archives{{archive}});
  const Studies studies;
  ArrivingWindow w(studies.services());
  openAlone(false);
  w.child<QAction>("showBrowser")->trigger();
  QVERIFY(w.choose("main"));
  w.searchFor("LIDC");
  QVERIFY(w.shows(w.patients()) && QTest::qWaitFor([&] { return !w.patients().isEmpty(); }, longest));
  QVERIFY(QTest::qWaitFor([&] { return w.window.jobs().rows().empty(); }, longest));
  QElapsedTimer clock;
  w.settled.clear();
  w.doubleClick(w.tree()->model()->index(0, 0));
  clock.start();
  QVERIFY(QTest::qWaitFor([&] { return w.showsSlice(); }, longest));
  const qint64 slice = clock.elapsed();
  QVERIFY(
      QTest::qWaitFor([&] { return w.window.view()->hasItsPicture() && w.settled.count() > 0; }, longest));
  qInfo("%s: first slice after %lld ms, 3D after %lld ms", qPrintable(peer), slice, clock.elapsed());
}

void BenchArriving::rowsOfAnArchive() {
  HttpPeer peer(studiesFrom);
  Archive archive;
  archive.name = "main", archive.kind = ArchiveKind::dicomweb, archive.url = peer.url().toStdString();
  const ListedArchives list(Archives{{archive}});
  const Studies studies;
  ArrivingWindow w(studies.services());
  w.child<QAction>("showBrowser")->trigger();
  auto* watched = dynamic_cast<WatchedApplication*>(QCoreApplication::instance());
  QVERIFY(watched);
  QCoreApplication::processEvents();
  watched->takeMostMs();
  QElapsedTimer clock;
  clock.start();
  QVERIFY(w.choose("main"));
  const auto rows = [&] { return w.tree()->model()->rowCount(); };
  QVERIFY(QTest::qWaitFor([&] { return rows() > 0; }, longest));
  const qint64 first = clock.elapsed();
  QVERIFY(QTest::qWaitFor([&] { return rows() >= 5000; }, longest));
  qInfo(
      "5,000 studies: first rows after %lld ms, all after %lld ms; longest event of the window %.0f ms of "
      "CPU",
      first, clock.elapsed(), watched->takeMostMs());
}

VOLUMEN_TEST(BenchArriving);
#include "bench_arriving.moc"
